"""The layout of one algorithm in the loop stepper: code, canvases and numbers.

Pure. All type has one size: of a few arrangements, take the one that shows most of the code, of the
canvas, and of the numbers. Lengths are ImGui's pixels.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from app.widgets.code import LINE, letters_in, row_count

Size = tuple[float, float]  # (width, height)

LEAST_CODE_EM = 7.0  # the width of the shortest rows of code
NUMBERS_EM = 11.6  # the width of the first column of numbers, the counters
NEXT_EM = 9.0  # and of the other columns, with names of a letter or two
ROW_EM = 1.3  # the height of a number
BETWEEN_EM = 0.7  # numbers and texts
WANTED_CANVAS = 0.5  # of the room's height
WEIGHTS = (3.0, 2.0, 1.5)  # code, canvas, numbers
GAP_EM = 0.6
ALL_BESIDE = 1.9  # with the same code in Julia: width / height from which all is side by side


@dataclass(frozen=True)
class Place:
    """A part of the room, from its upper left corner."""

    left: float
    top: float
    width: float
    height: float

    @property
    def size(self) -> Size:
        return self.width, self.height


@dataclass(frozen=True)
class StepperPlan:
    """columns: of the numbers. depth: of the depth buffer, if it is apart from the canvas."""

    code: Place
    canvases: Place
    numbers: Place
    columns: int
    depth: Place | None = None


@dataclass(frozen=True)
class Need:
    """The things to be laid out.

    lines: of the code. canvas: its pixels, (width, height). em_px: the type's size. short, long:
    how many numbers, and texts that take a line, there are.
    """

    lines: tuple[str, ...]
    canvas: tuple[int, int]
    has_depth: bool
    em_px: float
    short: int
    long: int


@functools.lru_cache(256)
def plan(room: Size, need: Need) -> StepperPlan:
    """Return the best arrangement."""
    return max(_plans(room, need), key=lambda one: _worth(one, room, need))


def plan_of_two(room: Size, need: Need) -> StepperPlan:
    """Lay out code that is also shown in Julia, and needs twice the room.

    The code has all of the width, unless that is much more than the height.
    """
    width, height = room
    if width > ALL_BESIDE * height:
        code = Place(0, 0, 0.46 * width, height)
        canvases = Place(0.48 * width, 0, 0.26 * width, height)
        numbers = Place(0.755 * width, 0, 0.245 * width, height)
    else:
        top = 0.58 * height + GAP_EM * need.em_px
        code = Place(0, 0, width, 0.58 * height)
        canvases = Place(0, top, 0.52 * width, height - top)
        numbers = Place(0.54 * width, top, 0.46 * width, height - top)
    return _with(code, canvases, numbers, need)


def canvases_in(
    room: Size, canvas: tuple[int, int], has_depth: bool, label: float, gap: Size
) -> tuple[Size, Size, bool]:
    """Return the rooms of the canvas and the depth buffer, and whether they are side by side.

    label: the height of the line above them.
    """
    height = max(20.0, room[1] - label)
    whole = room[0], height
    if not has_depth:
        return whole, whole, False
    half = 0.5 * (room[0] - gap[0]), height
    each = room[0], max(20.0, 0.5 * (height - label - gap[1]))
    choices = ((each, each, False), (half, half, True))
    return max(choices, key=lambda one: min(one[0][0] / canvas[0], one[0][1] / canvas[1]))


def _plans(room: Size, need: Need) -> Iterator[StepperPlan]:
    width, height = room
    gap = GAP_EM * need.em_px
    for percent in range(36, 85, 4):
        left = percent / 100 * width
        right = width - left - gap
        if left < LEAST_CODE_EM * need.em_px:
            continue
        for tall in _heights((left, height), need):
            code, rest = Place(0, 0, left, tall), height - tall - gap
            below, beside = Place(0, tall + gap, left, rest), Place(left + gap, 0, right, height)
            yield _with(code, below, beside, need)
            yield _with(code, beside, below, need)
            for part in (0.36, 0.48, 0.6):
                split = part * height
                upper = Place(left + gap, 0, right, split)
                lower = Place(left + gap, split + gap, right, height - split - gap)
                yield _with(code, upper, lower, need)
                if need.has_depth:  # which is below the code then
                    yield replace(_with(code, lower, upper, need), depth=below)
                middle = Place(left + gap, 0, part * right, height)
                last = Place(left + 2 * gap + part * right, 0, (1 - part) * right - gap, height)
                yield _with(code, middle, last, need)
    for tall in _heights(room, need):
        code, top, rest = Place(0, 0, width, tall), tall + gap, height - tall - gap
        for part in (0.4, 0.5, 0.6):
            canvases = Place(0, top, part * width, rest)
            numbers = Place(part * width + gap, top, (1 - part) * width - gap, rest)
            yield _with(code, canvases, numbers, need)
            canvases = Place(0, top, width, part * rest)
            numbers = Place(0, top + part * rest + gap, width, (1 - part) * rest - gap)
            yield _with(code, canvases, numbers, need)


def _heights(room: Size, need: Need) -> Iterator[float]:
    """Yield heights of the code: of all of its rows, or of as many whole ones as a part holds."""
    row = LINE * need.em_px
    for part in (1.0, 0.8, 0.65, 0.5, 0.4, 0.3):
        most = max(1, int(part * room[1] / row))
        yield min(_rows(room[0], need), most) * row + 0.5


def _rows(width: float, need: Need) -> int:
    return row_count(need.lines, letters_in(width, need.em_px))


def _with(code: Place, canvases: Place, numbers: Place, need: Need) -> StepperPlan:
    columns = 1 + int((numbers.width / need.em_px - NUMBERS_EM) / NEXT_EM)
    return StepperPlan(code, canvases, numbers, min(max(1, columns), 3))


def _worth(made: StepperPlan, room: Size, need: Need) -> float:
    row, wide = LINE * need.em_px, made.numbers.width / need.em_px
    listed = -(-need.short // made.columns) + need.long * (1 if wide > 2 * NUMBERS_EM else 2)
    numbers = (listed * ROW_EM + BETWEEN_EM) * need.em_px
    parts = (
        made.code.height / (row * _rows(made.code.width, need)),
        _canvas_px(made, need) / (WANTED_CANVAS * room[1]),
        made.numbers.height / numbers * min(1.0, wide / NUMBERS_EM) ** 2,
    )
    # Logarithms: what is small costs more than what is large gains.
    return sum(w * math.log(min(max(p, 1e-3), 1.0)) for w, p in zip(WEIGHTS, parts, strict=True))


def _canvas_px(made: StepperPlan, need: Need) -> float:
    """Return the height of the canvas, or of the depth buffer where it is the smaller one."""
    em, shape = need.em_px, need.canvas[1] / need.canvas[0]
    label, gap = 1.3 * em, (0.4 * em, 0.3 * em)
    together = need.has_depth and made.depth is None
    first, _, _ = canvases_in(made.canvases.size, need.canvas, together, label, gap)
    high = min(first[1], shape * first[0])
    if made.depth is None:
        return high
    return min(high, made.depth.height - label, shape * made.depth.width)
