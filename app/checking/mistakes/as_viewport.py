"""A fitted camera described as another viewport and distance, with the required basis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from app.checking.mistakes.as_basis import eye_differences, start_differences, vector_differences
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

PIXELS = {0.5: "half a pixel", 1.0: "one pixel"}


def as_viewport(fit: Fit) -> Iterator[Told]:
    """Yield the differences for each possible length of the directions. Yield nothing if u and v
    have other directions than required.
    """
    asked, rays, close = fit.asked, fit.rays, closeness(fit)
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
    for factor in factors(fit, lengths):
        x0 = factor * (at[0] - column[0] / 2)
        y1 = factor * (at[1] - row[1] / 2)
        edges = (x0, x0 + factor * column[0] * width, y1 + factor * row[1] * height, y1)
        told = list(start_differences(fit))
        if rays.is_parallel:
            turned = rays.fixed * -float(np.linalg.norm(asked.w))
            told += vector_differences(fit, [np.asarray(asked.u), np.asarray(asked.v), turned])
            told += eye_differences(fit, asked.eye + at[2] * np.asarray(asked.w))
        else:
            told += eye_differences(fit, rays.fixed)
            told += _distances(fit, -factor * float(at[2]), close)
        yield (*told, *_viewports(fit, [float(edge) for edge in edges], close))


def _distances(fit: Fit, distance: float, close: float) -> Iterator[Difference]:
    wanted = fit.asked.distance
    if is_close(distance, wanted, close):
        return
    sayings = []
    if is_close(distance, -wanted, close):
        sayings.append(OPPOSITE["w"])
    if is_close(distance, 1.0, close):
        sayings.append("your d is 1")
    if abs(distance) > close:
        sayings.append(f"your d is {number(distance / wanted)} d")
    sayings.append(f"your d is {number(distance)}")
    yield Difference("d", tuple(sayings), f"your d is {number(distance)}, not {number(wanted)}")


def _viewports(fit: Fit, edges: list[float], close: float) -> Iterator[Difference]:
    """Yield the differences of each axis: its direction, its size, and its middle."""
    left, right, bottom, top = fit.asked.viewport
    axes = (
        ("u", "wide", edges[:2], (left, right), fit.size[0], ("left", "right")),
        ("v", "high", edges[2:], (bottom, top), fit.size[1], ("down", "up")),
    )
    shifts, sizes, senses = [], [], []
    for axis, how, (low, high), asked, count, names in axes:
        extent = asked[1] - asked[0]
        turned = "columns count leftwards" if axis == "u" else "rows count upwards"
        if is_close((low, high), asked[::-1], close, extent):
            yield in_words(how, f"your {turned}")
            continue
        if high < low:
            senses.append(in_words(f"{how} sense", OPPOSITE[axis]))
            low, high = high, low
        factor = (high - low) / extent
        if abs(factor - 1) > close:
            sizes.append((how, factor, (low, high), asked))
        shift = (low + high - sum(asked)) / 2
        if abs(shift) > close * extent:
            pixels = shift / extent * count
            central = abs(low + high) <= close * extent
            shifts.append((pixels, names[pixels > 0], names, central, (low, high)))
    if len(sizes) == 2 and is_close(sizes[0][1], sizes[1][1], close):
        factor = sizes[0][1]
        if len(senses) == 2 and any(causes(fit, -factor, close)):
            factor, senses = -factor, []  # tangent of an angle above 90 degrees
        sizes = [("large", factor, *sizes[0][2:])]
    yield from senses
    for how, factor, found, asked in sizes:
        numbers = f"your viewport is {text(np.array(found))} {how}, not {text(np.array(asked))}"
        numbers = ", ".join([numbers, *causes(fit, factor, close)])
        yield Difference(f"size {how}", tuple(_size_sayings(fit, how, factor, close)), numbers)
    yield from _shifts(shifts, close)


def _size_sayings(fit: Fit, how: str, factor: float, close: float) -> Iterator[str]:
    width, height = fit.size
    d = fit.asked.distance
    yield from (f"your viewport is as {how} {cause}" for cause in causes(fit, factor, close))
    known = {"W/H": width / height, "H/W": height / width, "d": d, "1/d": 1 / d}
    for name, count in (("W", width), ("H", height)):
        if count > 1:
            known[f"{name}/({name} - 1)"] = count / (count - 1)
    for name, value in known.items():
        if abs(factor - value) <= close * value:
            yield f"your viewport is {name} times as {how}"
    yield f"your viewport is {number(factor)} times as {how}"


Shift = tuple[float, str, tuple[str, str], bool, tuple[float, float]]


def _shifts(shifts: Sequence[Shift], close: float) -> Iterator[Difference]:
    if len(shifts) == 2 and abs(abs(shifts[0][0]) - abs(shifts[1][0])) <= 1e-6:
        pixels = abs(shifts[0][0])
        where = f"to the {shifts[0][1]} and {shifts[1][1]}"
        yield in_words("shift", f"your viewport is shifted by {_pixels(pixels)} {where}")
        return
    for pixels, side, names, central, (low, high) in shifts:
        where = f"to the {side}" if "left" in names else side
        sayings = [f"your viewport is shifted by {_pixels(abs(pixels))} {where}"]
        if central:
            axis = "across" if "left" in names else "in height"
            sayings.append(f"your viewport has 0 in its middle, {axis}")
        if low == 0:
            sayings.append("your viewport begins at 0")
        edges = text(np.array([low, high]))
        numbers = f"your viewport reaches over {edges} {'across' if 'left' in names else 'upwards'}"
        yield Difference(f"shift {names[0]}", tuple(sayings), numbers)


def _pixels(count: float) -> str:
    for value, words in PIXELS.items():
        if abs(count - value) <= 1e-4:
            return words
    return f"{number(count)} pixels"
