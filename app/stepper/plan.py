"""The layout of one algorithm in the loop stepper: code, canvases and numbers.

Pure. Of a few arrangements, take the one in which the code has the wanted size and as much as
possible of the rest can be read. Lengths are ImGui's pixels.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from app.widgets.code import LINE, code_size_px

Size = tuple[float, float]  # (width, height)

USUAL_EM = 1.25  # of the code; if more is wanted, the rest shrinks
NUMBERS_EM = 11.6  # the width of the first column of numbers, the counters
NEXT_EM = 9.0  # and of the other columns, with names of a letter or two
TEXTS_EM = 17.0  # of a line of text below the columns
SHORT, LONG, ROW_EM = 9, 4, 1.18  # how many numbers, and texts, at least; the height of one
BETWEEN_EM = 0.7  # numbers and texts
WANTED_CANVAS = 0.5  # of the room's height
LEAST_CANVAS = 0.22  # below that it shows too little
WEIGHTS = (3.0, 4.0, 2.4)  # code, canvas, numbers
UNREAD = 12.0  # weight of each one's shortfall from being legible
YIELDS = 0.8  # where larger code is wanted: the power at which numbers are, too
NEARLY = 0.95  # of the surrounding type: code of that size is not below its numbers
ENOUGH = 1.3  # of the numbers' type, in parts of what is legible
GROWS = 0.1  # of legible code: the power of the type, the rest of which has less room
WANTED = 1.35  # of the code, in parts of what is legible, at the usual size of type
SMALLER = 1.6  # how much smaller than the canvas the depth buffer may be
GAP_EM = 0.6
# With the same code in Julia: rooms so much wider than high have all beside one another; the least
# and the largest of the code's type, where the width allows.
ALL_BESIDE, LEGIBLE_EM, LARGEST_EM = 1.9, 0.85, 1.6


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
    """code_px, numbers_px: their type sizes. columns: of the numbers. depth: of the depth buffer,
    if it is apart from the canvas.
    """

    code: Place
    canvases: Place
    numbers: Place
    code_px: float
    numbers_px: float
    columns: int
    depth: Place | None = None


@dataclass(frozen=True)
class Need:
    """The things to be laid out.

    longest: letters of the code's longest line; lines: of the code. canvas: its pixels, (width,
    height). em_px: the surrounding type size; wanted_px: of the code; legible_px: of code and
    numbers, the least that can be read; least_px: of the code, below which only a part of it is
    shown. short, long: how many numbers and texts there are.
    """

    longest: int
    lines: int
    canvas: tuple[int, int]
    has_depth: bool
    em_px: float
    wanted_px: float
    legible_px: float
    least_px: float
    short: int = SHORT
    long: int = LONG


@functools.lru_cache(256)
def plan(room: Size, need: Need) -> StepperPlan:
    """Return the best arrangement."""
    return max(_plans(room, need), key=lambda one: _worth(one, room, need))


def plan_of_two(room: Size, need: Need, set_px: float) -> StepperPlan:
    """Lay out code that is also shown in Julia, and needs twice the room.

    The code has all of the width, unless that is much more than the height.
    set_px: the size of the window's type.
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
    least = max(need.least_px, LEGIBLE_EM * set_px)
    all_px = code.height / (LINE * need.lines)
    most = min(LARGEST_EM * set_px, max(least, all_px))
    made = _with(code, code_size_px(" " * need.longest, code.width, most), canvases, numbers, need)
    return replace(made, numbers_px=max(made.numbers_px, need.least_px))  # then scrolled


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
        for code_px, tall in _sizes((left, height), need):
            code, rest = Place(0, 0, left, tall), height - tall - gap
            below, beside = Place(0, tall + gap, left, rest), Place(left + gap, 0, right, height)
            yield _with(code, code_px, below, beside, need)
            yield _with(code, code_px, beside, below, need)
            for part in (0.36, 0.48, 0.6):
                split = part * height
                upper = Place(left + gap, 0, right, split)
                lower = Place(left + gap, split + gap, right, height - split - gap)
                yield _with(Place(0, 0, left, tall), code_px, upper, lower, need)
                if need.has_depth:  # which is below the code then
                    yield replace(_with(code, code_px, lower, upper, need), depth=below)
                middle = Place(left + gap, 0, part * right, height)
                last = Place(left + 2 * gap + part * right, 0, (1 - part) * right - gap, height)
                yield _with(code, code_px, middle, last, need)
    for code_px, tall in _sizes(room, need):
        code, top, rest = Place(0, 0, width, tall), tall + gap, height - tall - gap
        for part in (0.4, 0.5, 0.6):
            canvases = Place(0, top, part * width, rest)
            numbers = Place(part * width + gap, top, (1 - part) * width - gap, rest)
            yield _with(code, code_px, canvases, numbers, need)
        for part in (0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65):  # each over all of the width
            canvases = Place(0, top, width, part * rest)
            numbers = Place(0, top + part * rest + gap, width, (1 - part) * rest - gap)
            yield _with(code, code_px, canvases, numbers, need)


def _sizes(room: Size, need: Need) -> Iterator[tuple[float, float]]:
    """Yield sizes of the code in a room, and the height of the whole lines that fit."""
    most = code_size_px(" " * need.longest, room[0], 1.35 * need.wanted_px)
    all_px = (room[1] - 1) / (LINE * need.lines)
    for part in (1.0, 0.92, 0.84, 0.76, 0.66, 0.56):
        size = min(most, max(all_px, need.least_px)) * part
        if size >= min(most, need.least_px):
            lines = min(need.lines, max(1, int(room[1] / (LINE * size))))
            yield size, lines * LINE * size + 0.5


def _with(code: Place, code_px: float, canvases: Place, numbers: Place, need: Need) -> StepperPlan:
    size, columns = max(_lettered(numbers.size, count, need) for count in (1, 2, 3))
    most = code_px if code_px > NEARLY * need.em_px else need.em_px  # the code is read first
    return StepperPlan(code, canvases, numbers, code_px, min(size, most), columns)


def _lettered(room: Size, columns: int, need: Need) -> tuple[float, int]:
    """Return the size at which the numbers fit in these columns, and the number of lines for the
    texts below them.
    """
    rows = -(-need.short // columns) + need.long
    wide = NUMBERS_EM + (columns - 1) * NEXT_EM
    sizes = (
        min(room[0] / max(wide, TEXTS_EM), room[1] / (rows * ROW_EM + BETWEEN_EM)),
        min(room[0] / wide, room[1] / ((rows + need.long) * ROW_EM + BETWEEN_EM)),
    )
    return min(max(sizes), 2 * need.em_px), columns


def _worth(made: StepperPlan, room: Size, need: Need) -> float:
    high = _canvas_px(made, need) / room[1]
    shown = min(1.0, made.code.height / (LINE * made.code_px * need.lines))
    more = max(1.0, need.wanted_px / (USUAL_EM * need.em_px))
    grown = need.wanted_px / (WANTED * need.legible_px)
    enough_px = min(0.75 * need.wanted_px, ENOUGH * need.legible_px)
    parts = (
        min(made.code_px / need.wanted_px, 1.0) * shown**2,
        min(high / WANTED_CANVAS, 1.0),
        min(made.numbers_px / enough_px, 1.0),
        min(made.code_px / (max(1.0, grown) ** GROWS * need.legible_px), 1.0),
        min(high / LEAST_CANVAS, 1.0),
        min(made.numbers_px / need.legible_px, 1.0),
    )
    # Logarithms: small sizes cost more than large ones gain.
    unread = UNREAD * more, 0.5 * UNREAD, UNREAD * more**YIELDS
    weights = (WEIGHTS[0] * more**2, *WEIGHTS[1:], *unread)
    return sum(w * math.log(max(part, 1e-3)) for w, part in zip(weights, parts, strict=True))


def _canvas_px(made: StepperPlan, need: Need) -> float:
    """Return the height of the canvas. A depth buffer that is much smaller counts as less small."""
    em, shape = need.em_px, need.canvas[1] / need.canvas[0]
    label, gap = 1.3 * em, (0.4 * em, 0.3 * em)
    together = need.has_depth and made.depth is None
    first, _, _ = canvases_in(made.canvases.size, need.canvas, together, label, gap)
    high = min(first[1], shape * first[0])
    if made.depth is None:
        return high
    return min(high, SMALLER * min(made.depth.height - label, shape * made.depth.width))
