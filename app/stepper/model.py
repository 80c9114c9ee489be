"""The loop stepper: the state of a teaching renderer at any step of its run, and ways to move on.

A moment is assembled from a recording. Pixels are (row, column), 0-based.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.explaining.columns import Column
from app.explaining.notation import number, text_tuple
from app.stepper.loop_parts import Hit, Object, ViewingRay
from app.stepper.raster_parts import WHOLE, Corner, Triangle
from app.stepper.recording import Recording
from renderer.camera import Floats

SHOWN = ("object", "triangle", "a", "b", "c", "rows", "columns", "i", "j", "q", "x", "y", "ray",
         "hit", "closest", "ea", "eb", "ec", "z", "t")  # fmt: skip
EDGES = ("ea", "eb", "ec")
NEVER: tuple[Column, list[Any]] = Column("i4"), []  # a variable that was not set yet


@dataclass(frozen=True)
class Variable:
    """A variable's name and value as text.

    changed: set by the line that has just run. stale: of the turn before, not set in this one yet.
    note: the meaning of the value, for an edge
    function: the side of the edge that the pixel is on.
    """

    name: str
    text: str
    changed: bool
    stale: bool = False
    note: str = ""
    value: Any = None


@dataclass(frozen=True)
class Counters:
    """Counts at a moment.

    tests: tests of an object or a triangle at a pixel.
    writes: to the canvas.
    overwrites: those to a pixel that had been written before.
    """

    tests: int
    writes: int
    overwrites: int


@dataclass(frozen=True)
class Test:
    """One execution of the inner line. t is infinite if the object does not affect the pixel."""

    pixel: tuple[int, int]
    object: int
    t: float


@dataclass(frozen=True, eq=False)
class Moment:
    """The state before a step's line runs.

    line: its number in the source. pixel, object (its number), ray, box (rows, columns), triangle
    and corners (its own, in the image): None outside the loop that sets them.
    canvas: linear light (height, width, 3), NaN where unset.
    depth: (height, width), None in image order.
    tests: of the current inner loop: in object order those of the object or the triangle, in image
    order those of the pixel.
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
    tests: tuple[Test, ...]
    counters: Counters
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
    box: tuple[Any, Any] = now.get("rows"), now.get("columns")
    writes = recording.write_steps.count_upto(step)

    def is_fresh(name: str, turns: Column) -> bool:
        """Return True if a variable was set since the loop's present turn began."""
        return _since(recording, name, step)[0] > int(turns[turns.count_upto(step) - 1])

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
        tests=_tests(recording, step, in_pixel, in_object),
        counters=Counters(
            recording.test_steps.count_upto(step),
            writes,
            int(recording.overwrites[writes - 1]) if writes else 0,
        ),
        finished=recording.complete and step == len(recording) - 1,
    )


# Ways to move on: each returns a step.


def next_pixel(recording: Recording, step: int) -> int:
    """Return the step at which the next pixel's turn begins, or the last step."""
    return _after(recording, recording.pixel_steps, step)


def next_object(recording: Recording, step: int) -> int:
    """Return the step at which the next object's turn begins, or the last step."""
    return _after(recording, recording.object_steps, step)


def step_of_pixel(recording: Recording, pixel: tuple[int, int], step: int) -> int | None:
    """Return the step at which a pixel's turn begins: the first after `step`, else the first of
    all.

    None if it never begins.
    """
    steps = recording.pixel_steps.upto(len(recording.pixel_steps))
    if not len(steps):
        return None
    mine = steps[(_pixels_at(recording, steps) == pixel).all(axis=1)]
    if not len(mine):
        return None
    later = mine[mine > step]
    return int(later[0] if len(later) else mine[0])


def _pixels_at(recording: Recording, steps: NDArray[np.int32]) -> NDArray[np.int64]:
    """Return rows and columns at these steps of pixels' turns, (n, 2)."""
    found = np.zeros((len(steps), 2), np.int64)
    for k, name in enumerate("ij"):
        changes, values = recording.values[name]
        count = len(changes)
        at = np.searchsorted(changes.upto(count), steps, side="right") - 1
        found[:, k] = np.array(values[:count])[at]
    return found


def _after(recording: Recording, steps: Column, step: int) -> int:
    at = steps.count_upto(step)
    return int(steps[at]) if at < len(steps) else len(recording) - 1


# Parts of a moment.


def _since(recording: Recording, name: str, step: int) -> tuple[int, Any]:
    """Return a variable's value before a step, and since when it has it; (-1, None) for none."""
    changes, values = recording.values.get(name, NEVER)
    at = changes.count_upto(step)
    return (int(changes[at - 1]), values[at - 1]) if at else (-1, None)


def _stale(recording: Recording, step: int) -> set[str]:
    """Return the variables that a loop sets in each turn, and not in the present one yet."""
    source, stale = recording.source, set[str]()
    outer, inner = sorted((source.pixels, source.objects), key=lambda loop: loop.first)
    begun = {
        loop: int(turns[count - 1]) if (count := turns.count_upto(step)) else 0
        for loop, turns in (
            (source.pixels, recording.pixel_steps),
            (source.objects, recording.object_steps),
        )
    }
    lines = recording.lines.upto(step)
    for name, where in source.sets.items():
        if all(outer.runs(line) for line in where):
            is_inner = all(inner.runs(line) for line in where)
            first = max(begun.values()) if is_inner else begun[outer]
            if where.isdisjoint(lines[max(first - 1, 0) :].tolist()):
                stale.add(name)
    return stale


def _variables(recording: Recording, now: dict[str, Any], step: int) -> list[Variable]:
    stale = _stale(recording, step)
    return [
        Variable(
            name,
            describe(now[name]),
            _since(recording, name, step)[0] == step,
            name in stale,
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


def _tests(recording: Recording, step: int, in_pixel: bool, in_object: bool) -> tuple[Test, ...]:
    """Return the tests since the outer loop's turn began."""
    pixels, objects = recording.source.pixels, recording.source.objects
    outer_is_pixel = pixels.first < objects.first
    if not (in_pixel if outer_is_pixel else in_object):
        return ()
    begun = recording.pixel_steps if outer_is_pixel else recording.object_steps
    first_step = int(begun[begun.count_upto(step) - 1])
    first, last = (recording.test_steps.count_upto(at) for at in (first_step, step))
    return tuple(
        Test((int(row[0]), int(row[1])), int(row[2]), float(t))
        for row, t in zip(
            recording.tests.upto(last)[first:], recording.test_t.upto(last)[first:], strict=True
        )
    )
