"""A fitted camera described as another eye and basis, with the required viewport."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.difference import (
    OPPOSITE,
    Difference,
    Fit,
    Told,
    causes,
    closeness,
    factors,
    in_words,
    is_close,
    number,
    text,
)

Floats = NDArray[np.float64]


def as_basis(fit: Fit) -> Iterator[Told]:
    asked = fit.asked
    eye, *found = fit.rays.frame(asked, fit.size)
    wanted = [np.asarray(vector) for vector in (asked.u, asked.v, asked.w)]
    if asked.is_parallel:
        found[2] = found[2] * float(np.linalg.norm(wanted[2]))
    sizes = [float(np.linalg.norm(vector)) for vector in found]
    lengths = list(zip(sizes, (float(np.linalg.norm(v)) for v in wanted), strict=True))
    for factor in factors(fit, lengths):
        scaled = [vector * (1.0 if asked.is_parallel else factor) for vector in found]
        yield (
            *eye_differences(fit, eye),
            *start_differences(fit),
            *vector_differences(fit, scaled),
        )


def vector_differences(fit: Fit, found: list[Floats]) -> Told:
    asked, close = fit.asked, closeness(fit)
    basis = asked.basis
    made = np.column_stack(found)
    wholes = (
        (basis.T, "your basis is transposed: rows for columns"),
        (np.linalg.inv(basis), "your basis leads from the world to the camera"),
        (np.eye(3), "your basis is that of the world"),
    )
    if not is_close(made, basis, close):
        for whole, saying in wholes:
            if asked.is_parallel:  # the direction's length does not matter
                whole = whole * [1, 1, np.linalg.norm(asked.w) / np.linalg.norm(whole[:, 2])]
            if is_close(made, whole, close):
                return (in_words("basis", saying),)
    return tuple(
        Difference(
            name,
            tuple(dict.fromkeys(_vector_sayings(fit, name, vector, wanted, close))),
            _vector_numbers(fit, name, vector, wanted, close),
        )
        for name, vector, wanted in zip("uvw", found, basis.T, strict=True)
        if not is_close(vector, wanted, close)
    )


def _vector_numbers(fit: Fit, name: str, vector: Floats, wanted: Floats, close: float) -> str:
    """Return the difference in numbers. If only the length of w differs, describe it as the
    distance.
    """
    factor = float(vector @ wanted / (wanted @ wanted))
    if name != "w" or not (factor > close and is_close(vector, factor * wanted, close)):
        return f"your {name} is {text(vector)}, not {text(wanted)}"
    d = fit.asked.distance
    told = f"your d is {number(factor * d)}, not {number(d)}"
    return ", ".join([told, *causes(fit, 1 / factor, close)])


def _vector_sayings(
    fit: Fit, name: str, vector: Floats, wanted: Floats, close: float
) -> Iterator[str]:
    asked = fit.asked
    if is_close(vector, -wanted, close):
        yield OPPOSITE[name]
    factor = float(vector @ wanted / (wanted @ wanted))
    if is_close(vector, factor * wanted, close) and abs(factor) > close:
        if name == "w" and factor > 0:
            yield from (f"your view is {cause}" for cause in causes(fit, 1 / factor, close))
            yield f"your d is {number(factor)} d"
            if abs(factor * asked.distance - 1) <= close:
                yield "your d is 1"
        if abs(float(np.linalg.norm(vector)) - 1) <= close and factor > 0:
            yield f"your {name} has length 1"
        yield f"your {name} is {number(factor)} {name}"
    if name == "w" and not asked.is_parallel:
        added = np.asarray(asked.eye) / asked.distance
        if added.any():
            if is_close(vector, wanted - added, close):
                yield "your direction has the eye added to it"
            if is_close(vector, wanted + added, close):
                yield "your direction has the eye subtracted from it"
    known = {"u": asked.u, "v": asked.v, "w": asked.w, "e": asked.eye}
    known |= {"the world's x": (1, 0, 0), "the world's y": (0, 1, 0), "the world's z": (0, 0, 1)}
    if fit.target is not None:
        known["the target"] = tuple(np.ravel(fit.target))
    if fit.up is not None:
        known["up"] = tuple(np.ravel(fit.up))
    for other, value in known.items():
        length = float(np.linalg.norm(value))
        if other == name or length == 0:
            continue
        for sign in (1, -1):
            for size, how in ((1.0, ""), (length, ", normalised")):
                if is_close(vector, sign * np.asarray(value) / size, close):
                    yield f"your {name} is {'-' if sign < 0 else ''}{other}{how}"
            if asked.is_parallel and name == "w":
                along = sign * float(np.linalg.norm(wanted)) * np.asarray(value) / length
                if is_close(vector, along, close):
                    yield f"your w is {'-' if sign < 0 else ''}{other}"


def eye_differences(fit: Fit, eye: Floats) -> Iterator[Difference]:
    asked = fit.asked
    wanted, w = np.asarray(asked.eye), np.asarray(asked.w)
    close = closeness(fit) + 16 * fit.rays.error
    extent = asked.viewport[1] - asked.viewport[0]
    least = float(np.linalg.norm(wanted)) + extent * float(np.linalg.norm(asked.u))
    if is_close(eye, wanted, close, least):
        return
    known = {
        "the world's origin": np.zeros(3),
        "e + d w": wanted + asked.distance * w,
        "e - d w": wanted - asked.distance * w,
        "e + w": wanted + w,
        "e - w": wanted - w,
    }
    if fit.target is not None:
        known["the target"] = np.ravel(np.asarray(fit.target, float))
    sayings = [
        f"your eye is {name}" for name, value in known.items() if is_close(eye, value, close, least)
    ]
    length = float(wanted @ wanted)
    factor = round(float(eye @ wanted) / length, 9) if length else 0.0
    if factor and is_close(eye, factor * wanted, close, least):
        sayings.append(f"your eye is {'-' if factor == -1 else number(factor) + ' '}e")
    sayings.append(f"your eye is e + {text(eye - wanted)}")
    yield Difference("eye", tuple(sayings), f"your eye is {text(eye)}, not {text(wanted)}")


def start_differences(fit: Fit) -> Iterator[Difference]:
    if not fit.rays.starts_there:
        yield in_words("starts", "your rays do not start at their eye, but further on")
