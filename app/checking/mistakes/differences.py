"""How a fitted camera differs from the one that was asked for, parameter by parameter, in words.

The same rays can be told in two ways: another basis with the viewport that was asked for, or the
same basis with another viewport and distance. What needs fewer words is told. What is said must
hold for every camera that was tried: "your d is 1", not "your d is 0.5 d" if that is so of one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.checking.mistakes.fitted import AffineRays
from renderer.camera import Camera, Size

Floats = NDArray[np.float64]

NUMBERS_WEIGH = 3  # of what can only be told in one camera's numbers; what has a name weighs 1
OPPOSITE = {
    "u": "your u points to the left",
    "v": "your v points down",
    "w": "your w points forwards",
}
PIXELS = {0.5: "half a pixel", 1.0: "one pixel"}


@dataclass(frozen=True, eq=False)
class Fit:
    """The rays of one camera that was asked for, and what they are affine to. target, up: what
    the task gave in place of a basis, or None."""

    asked: Camera
    size: Size
    rays: AffineRays
    target: ArrayLike | None = None
    up: ArrayLike | None = None


@dataclass(frozen=True)
class Difference:
    """sayings: all that is true of one parameter, in general words; the most telling first.
    numbers: the same in this camera's numbers."""

    topic: str
    sayings: tuple[str, ...]
    numbers: str


Told = tuple[Difference, ...]


def told_differences(fits: Sequence[Fit]) -> tuple[str, ...]:
    """What is different in all of these cameras; empty where nothing is."""
    if any(fit.rays.is_parallel != fit.asked.is_parallel for fit in fits):
        kind = "parallel" if fits[0].rays.is_parallel else "in perspective"
        return (f"your rays are {kind}",)
    ways = [_common([_least(list(_as_basis(fit))) for fit in fits])]
    viewports = [_least(list(_as_viewport(fit))) for fit in fits]
    if all(told is not None for told in viewports):
        ways.append(_common(viewports))
    _, sentences = min(ways, key=lambda way: way[0])
    return sentences


def _common(told: Sequence[Told | None]) -> tuple[int, tuple[str, ...]]:
    """What holds for all cameras, a sentence a topic, and how much that weighs."""
    of_topic: dict[str, list[Difference]] = {}
    for differences in told:
        for difference in differences or ():
            of_topic.setdefault(difference.topic, []).append(difference)
    weight, sentences = 0, []
    for found in of_topic.values():
        shared = [
            saying
            for saying in found[0].sayings
            if all(saying in other.sayings for other in found[1:])
        ]
        weight += 1 if shared else NUMBERS_WEIGH
        sentences.append(shared[0] if shared else found[0].numbers)
    return weight, tuple(sentences)


def _least(ways: Sequence[Told]) -> Told | None:
    """Of one camera told with several lengths of its directions: what needs fewest words."""
    return min(
        ways,
        key=lambda told: sum(1 if one.sayings else NUMBERS_WEIGH for one in told),
        default=None,
    )


def _factors(fit: Fit, lengths: Sequence[tuple[float, float]]) -> list[float]:
    """By what the directions may be multiplied: their own lengths, if they kept them, or what
    makes one of these lengths, (is, should be), right."""
    own = [1.0] if fit.rays.is_parallel or fit.rays.keeps_lengths else []
    if fit.rays.is_parallel:
        return own
    return own + [wanted / found for found, wanted in lengths if found > 0 and wanted > 0]


def _closeness(fit: Fit) -> float:
    """What is equal, relative to the viewport's size: the rays' own error, as it shows there."""
    rays, size = fit.rays, fit.size
    extent = min(
        float(np.linalg.norm(rays.column)) * size[0], float(np.linalg.norm(rays.row)) * size[1]
    )
    largest = rays.scale if rays.is_parallel else float(np.linalg.norm(rays.at))
    return 1e-9 + 16 * rays.error * max(1.0, largest / max(extent, 1e-300))


def _is_close(a: ArrayLike, b: ArrayLike, relative: float, least: float = 0.0) -> bool:
    """Whether two vectors or numbers are the same, relative to the larger one or to `least`."""
    size = max(float(np.linalg.norm(a)), float(np.linalg.norm(b)), least)
    return float(np.linalg.norm(np.subtract(a, b))) <= relative * size


# Another basis.


def _as_basis(fit: Fit) -> Iterator[Told]:
    asked = fit.asked
    eye, *found = fit.rays.frame(asked, fit.size)
    wanted = [np.asarray(vector) for vector in (asked.u, asked.v, asked.w)]
    if asked.is_parallel:
        found[2] = found[2] * float(np.linalg.norm(wanted[2]))
    sizes = [float(np.linalg.norm(vector)) for vector in found]
    lengths = list(zip(sizes, (float(np.linalg.norm(v)) for v in wanted), strict=True))
    for factor in _factors(fit, lengths):
        scaled = [vector * (1.0 if asked.is_parallel else factor) for vector in found]
        yield (*_eyes(fit, eye), *_starts(fit), *_vectors(fit, scaled))


def _vectors(fit: Fit, found: list[Floats]) -> Told:
    asked, close = fit.asked, _closeness(fit)
    basis = asked.basis
    made = np.column_stack(found)
    wholes = (
        (basis.T, "your basis is transposed: rows for columns"),
        (np.linalg.inv(basis), "your basis leads from the world to the camera"),
        (np.eye(3), "your basis is that of the world"),
    )
    if not _is_close(made, basis, close):
        for whole, saying in wholes:
            if asked.is_parallel:  # of parallel rays, the direction's length does not show
                whole = whole * [1, 1, np.linalg.norm(asked.w) / np.linalg.norm(whole[:, 2])]
            if _is_close(made, whole, close):
                return (Difference("basis", (saying,), saying),)
    differences = []
    for name, vector, wanted in zip("uvw", found, basis.T, strict=True):
        if not _is_close(vector, wanted, close):
            sayings = tuple(dict.fromkeys(_vector_sayings(fit, name, vector, wanted, close)))
            numbers = _vector_numbers(fit, name, vector, wanted, close)
            differences.append(Difference(name, sayings, numbers))
    return tuple(differences)


def _vector_numbers(fit: Fit, name: str, vector: Floats, wanted: Floats, close: float) -> str:
    """Of a w that is only longer or shorter: the distance."""
    factor = float(vector @ wanted / (wanted @ wanted))
    if name != "w" or not (factor > close and _is_close(vector, factor * wanted, close)):
        return f"your {name} is {_text(vector)}, not {_text(wanted)}"
    d = fit.asked.distance
    return ", ".join(
        [f"your d is {_number(factor * d)}, not {_number(d)}", *_causes(fit, 1 / factor, close)]
    )


def _causes(fit: Fit, factor: float, close: float) -> Iterator[str]:
    """What is done to an angle of view that makes the viewport larger by this factor."""
    left, right, bottom, top = fit.asked.viewport
    for half in dict.fromkeys(((top - bottom) / 2, (right - left) / 2)):
        angle = math.atan2(half, fit.asked.distance)  # of the half
        made = {
            "an angle in radians were in degrees": math.tan(math.radians(angle)),
            "an angle in degrees were in radians": math.tan(math.degrees(angle)),
            "the whole angle were half of it": math.tan(2 * angle),
            "half the angle were the whole": math.tan(angle / 2),
            "the tangent were left out": angle,
            "the tangent were upside down": 1 / math.tan(angle),
        }
        for cause, wrong in made.items():
            wanted = wrong / math.tan(angle)
            if wanted > 0 and abs(wanted - 1) > close and abs(factor - wanted) <= close * wanted:
                yield f"as if {cause}"


def _vector_sayings(
    fit: Fit, name: str, vector: Floats, wanted: Floats, close: float
) -> Iterator[str]:
    asked = fit.asked
    if _is_close(vector, -wanted, close):
        yield OPPOSITE[name]
    factor = float(vector @ wanted / (wanted @ wanted))
    if _is_close(vector, factor * wanted, close) and abs(factor) > close:
        if name == "w" and factor > 0:
            yield from (f"your view is {cause}" for cause in _causes(fit, 1 / factor, close))
            yield f"your d is {_number(factor)} d"
            if abs(factor * asked.distance - 1) <= close:
                yield "your d is 1"
        if abs(float(np.linalg.norm(vector)) - 1) <= close and factor > 0:
            yield f"your {name} has length 1"
        yield f"your {name} is {_number(factor)} {name}"
    if name == "w" and not asked.is_parallel:
        added = np.asarray(asked.eye) / asked.distance
        if added.any():
            if _is_close(vector, wanted - added, close):
                yield "your direction has the eye added to it"
            if _is_close(vector, wanted + added, close):
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
                if _is_close(vector, sign * np.asarray(value) / size, close):
                    yield f"your {name} is {'-' if sign < 0 else ''}{other}{how}"
            if asked.is_parallel and name == "w":
                along = sign * float(np.linalg.norm(wanted)) * np.asarray(value) / length
                if _is_close(vector, along, close):
                    yield f"your w is {'-' if sign < 0 else ''}{other}"


def _eyes(fit: Fit, eye: Floats) -> Iterator[Difference]:
    asked = fit.asked
    wanted, w = np.asarray(asked.eye), np.asarray(asked.w)
    close = _closeness(fit) + 16 * fit.rays.error
    extent = asked.viewport[1] - asked.viewport[0]
    least = float(np.linalg.norm(wanted)) + extent * float(np.linalg.norm(asked.u))
    if _is_close(eye, wanted, close, least):
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
        f"your eye is {name}"
        for name, value in known.items()
        if _is_close(eye, value, close, least)
    ]
    length = float(wanted @ wanted)
    factor = round(float(eye @ wanted) / length, 9) if length else 0.0
    if factor and _is_close(eye, factor * wanted, close, least):
        sayings.append(f"your eye is {'-' if factor == -1 else _number(factor) + ' '}e")
    sayings.append(f"your eye is e + {_text(eye - wanted)}")
    yield Difference("eye", tuple(sayings), f"your eye is {_text(eye)}, not {_text(wanted)}")


def _starts(fit: Fit) -> Iterator[Difference]:
    if not fit.rays.starts_there:
        saying = "your rays do not start at their eye, but further on"
        yield Difference("starts", (saying,), saying)


# Another viewport.


def _as_viewport(fit: Fit) -> Iterator[Told]:
    """None where its u and v have another direction."""
    asked, rays, close = fit.asked, fit.rays, _closeness(fit)
    to_basis = np.linalg.inv(asked.basis)
    start = rays.at - asked.eye if rays.is_parallel else rays.at
    at, row, column = (to_basis @ part for part in (start, rays.row, rays.column))
    if abs(column[0]) * abs(row[1]) == 0:
        return
    if np.abs(row[[0, 2]]).max() > close * abs(row[1]):
        return
    if np.abs(column[1:]).max() > close * abs(column[0]):
        return
    left, right, bottom, top = asked.viewport
    width, height = fit.size
    lengths = [
        (float(column[0]) * width, right - left),
        (-float(row[1]) * height, top - bottom),
        (-float(at[2]), asked.distance),
    ]
    for factor in _factors(fit, lengths):
        x0 = factor * (at[0] - column[0] / 2)
        y1 = factor * (at[1] - row[1] / 2)
        edges = (x0, x0 + factor * column[0] * width, y1 + factor * row[1] * height, y1)
        told = list(_starts(fit))
        if rays.is_parallel:
            turned = rays.fixed * -float(np.linalg.norm(asked.w))
            told += _vectors(fit, [np.asarray(asked.u), np.asarray(asked.v), turned])
            told += _eyes(fit, asked.eye + at[2] * np.asarray(asked.w))
        else:
            told += _eyes(fit, rays.fixed)
            told += _distances(fit, -factor * float(at[2]), close)
        yield (*told, *_viewports(fit, [float(edge) for edge in edges], close))


def _distances(fit: Fit, distance: float, close: float) -> Iterator[Difference]:
    wanted = fit.asked.distance
    if _is_close(distance, wanted, close):
        return
    sayings = []
    if _is_close(distance, -wanted, close):
        sayings.append(OPPOSITE["w"])
    if _is_close(distance, 1.0, close):
        sayings.append("your d is 1")
    if abs(distance) > close:
        sayings.append(f"your d is {_number(distance / wanted)} d")
    sayings.append(f"your d is {_number(distance)}")
    yield Difference("d", tuple(sayings), f"your d is {_number(distance)}, not {_number(wanted)}")


def _viewports(fit: Fit, edges: list[float], close: float) -> Iterator[Difference]:
    """Of each axis: its sense, its size, and where its middle is."""
    left, right, bottom, top = fit.asked.viewport
    axes = (
        ("wide", edges[0], edges[1], left, right, fit.size[0], ("left", "right")),
        ("high", edges[2], edges[3], bottom, top, fit.size[1], ("down", "up")),
    )
    shifts, sizes = [], []
    for how, low, high, low_asked, high_asked, count, names in axes:
        extent = high_asked - low_asked
        if _is_close((low, high), (high_asked, low_asked), close, extent):
            saying = f"your {'columns count leftwards' if how == 'wide' else 'rows count upwards'}"
            yield Difference(how, (saying,), saying)
            continue
        if high < low:
            saying = OPPOSITE["u" if how == "wide" else "v"]
            yield Difference(f"{how} sense", (saying,), saying)
            low, high = high, low
        factor = (high - low) / extent
        if abs(factor - 1) > close:
            sizes.append((how, factor, (low, high), (low_asked, high_asked)))
        shift = (low + high - low_asked - high_asked) / 2
        if abs(shift) > close * extent:
            pixels = shift / extent * count
            central = abs(low + high) <= close * extent
            shifts.append((pixels, names[pixels > 0], names, central, (low, high)))
    if len(sizes) == 2 and _is_close(sizes[0][1], sizes[1][1], close):
        sizes = [("large", sizes[0][1], *sizes[0][2:])]
    for how, factor, found, asked in sizes:
        numbers = f"your viewport is {_text(np.array(found))} {how}, not {_text(np.array(asked))}"
        numbers = ", ".join([numbers, *_causes(fit, factor, close)])
        yield Difference(f"size {how}", tuple(_size_sayings(fit, how, factor, close)), numbers)
    yield from _shifts(shifts, close)


def _size_sayings(fit: Fit, how: str, factor: float, close: float) -> Iterator[str]:
    width, height = fit.size
    d = fit.asked.distance
    yield from (f"your viewport is as {how} {cause}" for cause in _causes(fit, factor, close))
    known = {"W/H": width / height, "H/W": height / width, "d": d, "1/d": 1 / d}
    for name, count in (("W", width), ("H", height)):
        if count > 1:
            known[f"{name}/({name} - 1)"] = count / (count - 1)
    for name, value in known.items():
        if abs(factor - value) <= close * value:
            yield f"your viewport is {name} times as {how}"
    yield f"your viewport is {_number(factor)} times as {how}"


Shift = tuple[float, str, tuple[str, str], bool, tuple[float, float]]


def _shifts(shifts: Sequence[Shift], close: float) -> Iterator[Difference]:
    if len(shifts) == 2 and abs(abs(shifts[0][0]) - abs(shifts[1][0])) <= 1e-6:
        pixels = abs(shifts[0][0])
        where = f"to the {shifts[0][1]} and {shifts[1][1]}"
        saying = f"your viewport is shifted by {_pixels(pixels)} {where}"
        yield Difference("shift", (saying,), saying)
        return
    for pixels, side, names, central, (low, high) in shifts:
        where = f"to the {side}" if "left" in names else side
        sayings = [f"your viewport is shifted by {_pixels(abs(pixels))} {where}"]
        if central:
            axis = "across" if "left" in names else "in height"
            sayings.append(f"your viewport has 0 in its middle, {axis}")
        if low == 0:
            sayings.append("your viewport begins at 0")
        edges = _text(np.array([low, high]))
        numbers = f"your viewport reaches over {edges} {'across' if 'left' in names else 'upwards'}"
        yield Difference(f"shift {names[0]}", tuple(sayings), numbers)


def _pixels(count: float) -> str:
    for value, text in PIXELS.items():
        if abs(count - value) <= 1e-4:
            return text
    return f"{_number(count)} pixels"


def _number(value: float) -> str:
    rounded = f"{value:.4g}"
    return "0" if rounded == "-0" else rounded


def _text(vector: Floats) -> str:
    size = float(np.abs(vector).max())
    return "(" + ", ".join(_number(0.0 if abs(x) < 1e-9 * size else x) for x in vector) + ")"
