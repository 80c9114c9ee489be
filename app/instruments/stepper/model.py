"""The loop stepper: the state of a teaching renderer at any step of its run, and ways to move on.

A moment is assembled from a recording. Pixels are (row, column), 0-based.
"""

from __future__ import annotations

import math
from array import array
from bisect import bisect_right
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.checks import Floats

from .loop_parts import Hit, Object, ViewingRay
from .raster_parts import Corner, Triangle
from .recording import Recording

SHOWN = ("object", "triangle", "a", "b", "c", "rows", "columns", "i", "j", "q", "x", "y", "ray",
         "hit", "closest", "ea", "eb", "ec", "z", "t")  # fmt: skip
Wish = Literal["", "back", "step", "pixel", "object"]


class Variable(NamedTuple):
    """A variable. changed: True if the line that has just run set it."""

    name: str
    value: Any
    changed: bool


@dataclass(frozen=True, eq=False)
class Moment:
    """The state before a step's line runs.

    line: the line's number in the source. pixel, ray, box (rows, columns), triangle and corners
    (the triangle's, in the image): None outside the loop that sets them.
    canvas: linear light (height, width, 3), NaN where unset.
    t: the ray parameter of the pixel's closest hit so far; infinite if there is none.
    """

    step: int
    line: int
    variables: tuple[Variable, ...]
    pixel: Pixel | None
    ray: ViewingRay | None
    box: tuple[range, range] | None
    triangle: Triangle | None
    corners: tuple[Corner, ...] | None
    canvas: Floats
    t: float


def moment_at(recording: Recording, step: int) -> Moment:
    """Return the moment before a step. Steps outside 0 to len(recording) - 1 are clamped."""
    step = max(0, min(step, len(recording) - 1))
    line = recording.lines[step]
    since: dict[str, int] = {}
    now: dict[str, Any] = {}
    for name, (steps, values) in recording.changes.items():
        if count := bisect_right(steps, step):
            since[name], now[name] = steps[count - 1], values[count - 1]

    def fresh(name: str, body: range, turns: array[int]) -> Any:
        """Return a variable that was set in the current turn of a loop, or None."""
        begun = bisect_right(turns, step)
        is_fresh = line in body and name in since and since[name] >= turns[begun - 1]
        return now[name] if is_fresh else None

    in_pixel = recording.source.pixels, recording.pixel_steps
    in_object = recording.source.objects, recording.object_steps
    closest, rows = fresh("closest", *in_pixel), fresh("rows", *in_object)
    return Moment(
        step=step,
        line=line,
        variables=tuple(
            Variable(name, now[name], since[name] == step) for name in SHOWN if name in now
        ),
        pixel=(now["i"], now["j"]) if line in recording.source.pixels else None,
        ray=fresh("ray", *in_pixel),
        box=None if rows is None else (rows, now["columns"]),
        triangle=now.get("triangle") if line in recording.source.objects else None,
        corners=None if fresh("c", *in_object) is None else (now["a"], now["b"], now["c"]),
        canvas=_canvas(recording, step, now),
        t=math.inf if closest is None else closest.t,
    )


def after(recording: Recording, step: int, wish: Wish) -> int:
    """Return the step after a wish."""
    last = len(recording) - 1
    step = min(step, last)
    if wish in ("pixel", "object"):
        turns = recording.pixel_steps if wish == "pixel" else recording.object_steps
        at = bisect_right(turns, step)
        return turns[at] if at < len(turns) else last
    return max(step - 1, 0) if wish == "back" else min(step + 1, last)


def _canvas(recording: Recording, step: int, now: dict[str, Any]) -> Floats:
    """Return the canvas before a step."""
    width, height = recording.size
    if (buffer := now.get("canvas")) is None:
        return np.full((height, width, 3), math.nan)
    array: Floats = buffer.empty.copy()
    if count := bisect_right(recording.writes, step):
        rows, columns, values = zip(*buffer.log[:count], strict=True)
        array[rows, columns] = values  # the last of several writes to a pixel stays
    return array


def describe(value: Any, first: int = 0) -> str:
    """Return a variable's value in a few characters. first: the number of the first row and column,
    for variables that count them.
    """
    if isinstance(value, range):
        return f"{value.start + first} to {value.stop - 1 + first}" if value else "none"
    if isinstance(value, int):
        return f"{value + first}"
    if isinstance(value, Object):
        return value.name
    if isinstance(value, Triangle):
        part = "" if value.is_whole else ", clipped"
        return f"{value.object.name}, number {value.primitive}{part}"
    if isinstance(value, Corner):
        return f"({value.x:.2f}, {value.y:.2f}), z = {number(value.z, fixed=True)}"
    if isinstance(value, tuple) and len(value) == 2:
        return f"({value[0]:g}, {value[1]:g})"
    if isinstance(value, ViewingRay):
        origin, direction = text_tuple(value.origin, True), text_tuple(value.direction, True)
        return f"{origin} + t {direction}"
    if isinstance(value, Hit):
        if value.object is None:
            return "miss, t = inf"
        return f"t = {number(value.t, fixed=True)}, {value.object.name}"
    return number(value, fixed=True) if isinstance(value, float) else str(value)
