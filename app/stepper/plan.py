"""The two layouts of one algorithm in the loop stepper: code, canvases and numbers. Pure.

Lengths are ImGui's pixels.
"""

from __future__ import annotations

from dataclasses import dataclass

Size = tuple[float, float]  # (width, height)

WIDE = 2.25  # width / height from which canvases and numbers are beside the code, not below it
NUMBERS_EM = 11.6  # the width of the first column of numbers, the counters
NEXT_EM = 9.0  # and of the other columns, with names of a letter or two
LEAST_EM = 9.0  # the least width of the numbers: a name, a number and "from 1" in one line
GAP_EM = 0.6


@dataclass(frozen=True)
class Place:
    """A part of the room, from its upper left corner."""

    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True)
class StepperPlan:
    """columns: of the numbers."""

    code: Place
    canvases: Place
    numbers: Place
    columns: int


def code_width(room: Size) -> float:
    """Return the width of the code."""
    return 0.66 * room[0] if _is_wide(room) else room[0]


def plan(room: Size, code_px: float, em_px: float) -> StepperPlan:
    """Return the layout for a room. code_px: the height of all lines. em_px: the type's size."""
    (width, height), gap = room, GAP_EM * em_px
    if _is_wide(room):
        left = _left(code_width(room), room, em_px)
        code = Place(0, 0, left, height)
        canvases = Place(left + gap, 0, width - left - gap, 0.5 * height)
        top = 0.5 * height + gap
        numbers = Place(left + gap, top, width - left - gap, height - top)
    else:
        code = Place(0, 0, width, min(code_px, 0.55 * height))
        top, left = code.height + gap, _left(0.5 * width, room, em_px)
        canvases = Place(0, top, left, height - top)
        numbers = Place(left + gap, top, width - left - gap, height - top)
    columns = 1 + int((numbers.width / em_px - NUMBERS_EM) / NEXT_EM)
    return StepperPlan(code, canvases, numbers, min(max(1, columns), 3))


def canvases_in(
    room: Size, canvas: tuple[int, int], has_depth: bool, label: float, gap: Size
) -> tuple[Size, bool]:
    """Return the size of the canvas, which is the depth buffer's too, and whether they are side by
    side.

    canvas: its pixels, (width, height). label: the height of the line above them.
    """
    height = max(20.0, room[1] - label)
    if not has_depth:
        return (room[0], height), False
    half = 0.5 * (room[0] - gap[0]), height
    each = room[0], max(20.0, 0.5 * (height - label - gap[1]))
    choices = ((each, False), (half, True))
    return max(choices, key=lambda one: min(one[0][0] / canvas[0], one[0][1] / canvas[1]))


def _left(wanted: float, room: Size, em_px: float) -> float:
    """Return the width of what is beside the numbers: less than wanted, if those need it."""
    return min(wanted, max(0.3 * room[0], room[0] - (GAP_EM + LEAST_EM) * em_px))


def _is_wide(room: Size) -> bool:
    return room[0] > WIDE * room[1]
