"""The loop stepper: the state of a teaching renderer at any step of its run, and ways to move on.

A moment is assembled from a recording. Pixels are (row, column), 0-based.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from lucida.app.instruments.stepper.loop_parts import Hit, Object, ViewingRay
from lucida.app.instruments.stepper.raster_parts import WHOLE, Corner, Triangle
from lucida.app.instruments.stepper.recording import Recording
from lucida.app.ui.explaining.columns import Column
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.checks import Floats

SHOWN = ("object", "triangle", "a", "b", "c", "rows", "columns", "i", "j", "q", "x", "y", "ray",
         "hit", "closest", "ea", "eb", "ec", "z", "t")  # fmt: skip
EDGES = ("ea", "eb", "ec")
NEVER: tuple[Column, list[Any]] = Column("i4"), []  # a variable that was not set yet


@dataclass(frozen=True)
class Variable:
    """A variable's name and value as text.

    changed: set by the line that has just run.
    note: the meaning of the value, for an edge
    function: the side of the edge that the pixel is on.
    """

    name: str
    text: str
    changed: bool
    note: str = ""
    value: Any = None


@dataclass(frozen=True, eq=False)
class Moment:
    """The state before a step's line runs.

    line: its number in the source. pixel, object (its number), ray, box (rows, columns), triangle
    and corners (its own, in the image): None outside the loop that sets them.
    canvas: linear light (height, width, 3), NaN where unset.
    depth: (height, width), None in image order.
    t: of the closest hit so far of the pixel's ray; infinite for none.
    """

    step: int
    line: int
    variables: tuple[Variable, ...]
    pixel: tuple[int, int] | None
    object: int | None
    ray: ViewingRay | None
    box: tuple[range, range] | None
    triangle: Triangle | None
    corners: tuple[Corner, ...] | None
    canvas: Floats
    depth: Floats | None
    t: float
    finished: bool


def moment_at(recording: Recording, step: int) -> Moment:
    """Return the moment before a step. Steps outside 0 to len(recording) - 1 are clamped.

    Must not be called before there is a step.
    """
    step = max(0, min(step, len(recording) - 1))
    source = recording.source
    line = int(recording.lines[step])
    now = {name: _since(recording, name, step)[1] for name in recording.values}
    in_pixel, in_object = source.pixels.runs(line), source.objects.runs(line)
    pixel = (now["i"], now["j"]) if in_pixel else None
    triangle: Triangle | None = now.get("triangle") if in_object else None
    thing: Object | None = now.get("object") if in_object else None
    if triangle is not None:
        thing = triangle.object
    closest: Hit | None = now.get("closest")
    box: tuple[Any, Any] = now.get("rows"), now.get("columns")
    writes = recording.write_steps.count_upto(step)

    def is_fresh(name: str, turns: Column) -> bool:
        """Return True if a variable was set since the loop's present turn began."""
        return _since(recording, name, step)[0] > int(turns[turns.count_upto(step) - 1])

    is_tested = in_pixel and is_fresh("closest", recording.pixel_steps)
    return Moment(
        step=step,
        line=line,
        variables=tuple(_variables(recording, now, step)),
        pixel=pixel,
        object=None if thing is None else thing.number,
        ray=now.get("ray") if in_pixel and is_fresh("ray", recording.pixel_steps) else None,
        box=box if in_object and is_fresh("rows", recording.object_steps) else None,
        triangle=triangle,
        corners=(
            tuple(now[name] for name in "abc")
            if triangle is not None and is_fresh("c", recording.object_steps)
            else None
        ),
        canvas=_canvas(recording, writes, now),
        depth=_depth(recording, step, now),
        t=closest.t if closest and is_tested else math.inf,
        finished=recording.complete and step == len(recording) - 1,
    )


# Ways to move on: each returns a step.


def next_pixel(recording: Recording, step: int) -> int:
    """Return the step at which the next pixel's turn begins, or the last step."""
    return _after(recording, recording.pixel_steps, step)


def next_object(recording: Recording, step: int) -> int:
    """Return the step at which the next object's turn begins, or the last step."""
    return _after(recording, recording.object_steps, step)


def _after(recording: Recording, steps: Column, step: int) -> int:
    at = steps.count_upto(step)
    return int(steps[at]) if at < len(steps) else len(recording) - 1


# Parts of a moment.


def _since(recording: Recording, name: str, step: int) -> tuple[int, Any]:
    """Return a variable's value before a step, and since when it has it; (-1, None) for none."""
    changes, values = recording.values.get(name, NEVER)
    at = changes.count_upto(step)
    return (int(changes[at - 1]), values[at - 1]) if at else (-1, None)


def _variables(recording: Recording, now: dict[str, Any], step: int) -> list[Variable]:
    return [
        Variable(
            name,
            describe(now[name]),
            _since(recording, name, step)[0] == step,
            ("inside" if now[name] >= 0 else "outside") if name in EDGES else "",
            now[name],
        )
        for name in SHOWN
        if now.get(name) is not None
    ]


def describe(value: Any, first: int = 0) -> str:
    """Return a variable's value in a few characters. first: the number of the first row and column,
    for those that count them.
    """
    if isinstance(value, range):
        return f"{value.start + first} to {value.stop - 1 + first}" if value else "none"
    if isinstance(value, int):
        return f"{value + first}"
    if isinstance(value, Object):
        return value.name
    if isinstance(value, Triangle):
        part = "" if value.shares is WHOLE else ", clipped"
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


def _canvas(recording: Recording, writes: int, now: dict[str, Any]) -> Floats:
    width, height = recording.size
    canvas = now.get("canvas")
    background = (math.nan,) * 3 if canvas is None else canvas.background
    array = np.full((height, width, 3), background)
    pixels = recording.write_pixels.upto(writes)
    # Of several writes to a pixel the last one stays: NumPy assigns in order.
    array[pixels[:, 0], pixels[:, 1]] = recording.write_colors.upto(writes)
    return array


def _depth(recording: Recording, step: int, now: dict[str, Any]) -> Floats | None:
    if now.get("depth") is None:
        return None
    width, height = recording.size
    array = np.full((height, width), math.inf)
    count = recording.depth_steps.count_upto(step)
    pixels = recording.depth_pixels.upto(count)
    array[pixels[:, 0], pixels[:, 1]] = recording.depth_t.upto(count)
    return array
