"""Programs that a lecture runs: the two loops, ray tracing in three lines, the whole program.

A run is a list of lines in the order in which they are executed, computed from the hits of all
viewing rays, so that any of its moments can be shown at once, forwards or backwards. Pure.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, three
from lucida.renderer.camera.image_plane import Size

from .loop_parts import Model, ViewingRay, color_at, intersect

GLOW = 0.01  # share of a run: the lines executed in it shine together
# When a line is executed: in each turn of the outer loop, in each turn of the inner one, if the
# object is the nearest so far, or after the inner loop. Other lines are never highlighted.
When = Literal["", "outer", "inner", "nearer", "after"]


class Line(NamedTuple):
    """A line of a program."""

    text: str
    when: When


OBJECT_ORDER = (
    Line("for each object:", "outer"),
    Line("    for each pixel:", "inner"),
    Line("        if the object affects the pixel:", "inner"),
    Line("            do something", "nearer"),
)
IMAGE_ORDER = (
    Line("for each pixel:", "outer"),
    Line("    for each object:", "inner"),
    Line("        if the object affects the pixel:", "inner"),
    Line("            do something", "nearer"),
)
RAY_TRACING = (
    Line("for each pixel:", "outer"),
    Line("    generate its viewing ray", "outer"),
    Line("    find the closest object it hits", "inner"),
    Line("    determine its colour there", "after"),
)


def whole_program(camera: Camera) -> tuple[Line, ...]:
    """Return ray tracing with the formulas of a camera, in Python, with pixels counted from 0.

    The camera's name is `cam`.
    """
    place = "(j + 0.5) / width - 0.5", "-((i + 0.5) / height - 0.5)"
    if camera.viewport != (-0.5, 0.5, -0.5, 0.5):
        place = (
            "cam.left + (j + 0.5) / width * (cam.right - cam.left)",
            "cam.top - (i + 0.5) / height * (cam.top - cam.bottom)",
        )
    ray = "cam.eye", "x*cam.u + y*cam.v - cam.distance*cam.w"
    if camera.is_parallel:
        ray = "cam.eye + x*cam.u + y*cam.v", "-cam.w"
    return (
        Line("from objects import color, intersect, miss", ""),
        Line("def render(scene, cam, canvas):", ""),
        Line("    height, width = canvas.shape[:2]", ""),
        Line("    for i in range(height):", ""),
        Line("        for j in range(width):", "outer"),
        Line(f"            x = {place[0]}", "outer"),
        Line(f"            y = {place[1]}", "outer"),
        Line(f"            origin = {ray[0]}", "outer"),
        Line(f"            direction = {ray[1]}", "outer"),
        Line("            closest = miss", "outer"),
        Line("            for object in scene:", "inner"),
        Line("                hit = intersect(object, origin, direction)", "inner"),
        Line("                if hit.t < closest.t:", "inner"),
        Line("                    closest = hit", "nearer"),
        Line("            canvas[i, j] = color(closest)", "after"),
    )


@dataclass(frozen=True, eq=False)
class Hits:
    """The hits of all viewing rays with all objects.

    t: (objects, pixels), infinite for a miss; pixels row by row.
    colors: linear light of the nearest of the first k objects, (objects + 1, pixels, 3); NaN if
    there is none.
    rays: each pixel's viewing ray.
    """

    size: Size
    t: Floats
    colors: Floats
    background: Floats
    rays: tuple[ViewingRay, ...]

    @cached_property
    def nearer(self) -> NDArray[np.bool_]:
        """Return (objects, pixels): True if an object is nearer than all objects before it."""
        before = np.minimum.accumulate(np.vstack([np.full_like(self.t[:1], math.inf), self.t]))
        return self.t < before[:-1]


def hits_of(model: Model, camera: Camera, size: Size) -> Hits:
    """Intersect the viewing rays of a small image with all objects."""
    found, count = camera.rays(size), size[0] * size[1]
    origins, directions = found.origin.reshape(-1, 3), found.direction.reshape(-1, 3)
    rays = tuple(
        ViewingRay(three(origin), three(direction), *camera.t_range)
        for origin, direction in zip(origins.tolist(), directions.tolist(), strict=True)
    )
    # Without objects, the loops run over one object that no ray meets.
    t = np.full((max(1, len(model.objects)), count), math.inf)
    colors = np.full((len(t) + 1, count, 3), math.nan)
    for k, thing in enumerate(model.objects):
        colors[k + 1] = colors[k]
        for pixel, ray in enumerate(rays):
            if math.isnan(ray.direction[0]):  # outside the lens
                continue
            hit = intersect(thing, ray)
            t[k, pixel] = hit.t
            if hit.t < t[:k, pixel].min(initial=math.inf):
                colors[k + 1, pixel] = color_at(model, ray, hit)
    return Hits(size, t, colors, np.array(model.background), rays)


@dataclass(frozen=True, eq=False)
class LoopMoment:
    """The state of a run at one moment.

    canvas: linear light (height, width, 3), NaN where nothing was set.
    pixel: the current one; None before the run and after it.
    lit: the brightness of each line that has just been executed, up to 1.
    """

    canvas: Floats
    pixel: Pixel | None
    lit: Mapping[int, float]


class LoopRun:
    """A run of a program over all pixels and objects. by_object: True if objects are outermost."""

    def __init__(self, hits: Hits, lines: tuple[Line, ...], by_object: bool = False) -> None:
        self.hits, self.lines, self.by_object = hits, lines, by_object
        # A program that determines the colour after its inner loop sets every pixel, once.
        self.sets_all = any(line.when == "after" for line in lines)
        steps = np.array(self._steps())
        self._line, self._tests = steps[:, 0], steps[:, 1]

    def _steps(self) -> list[tuple[int, int]]:
        """Return each executed line, with the number of object-pixel tests up to it."""
        of = {
            when: [n for n, line in enumerate(self.lines) if line.when == when]
            for when in ("outer", "inner", "nearer", "after")
        }
        nearer = self.hits.nearer if self.by_object else self.hits.nearer.T
        steps: list[tuple[int, int]] = []
        for outer, turns in enumerate(nearer.tolist()):
            begun = outer * len(turns)
            steps += [(n, begun) for n in of["outer"]]
            for inner, is_nearer in enumerate(turns):
                steps += [(n, begun + inner) for n in of["inner"]]
                if is_nearer:
                    steps += [(n, begun + inner + 1) for n in of["nearer"]]
            steps += [(n, begun + len(turns)) for n in of["after"]]
        return steps

    def at(self, part: float) -> LoopMoment:
        """Return the moment at which that part of the run is done: 0 before it, 1 after it."""
        objects, pixels = self.hits.t.shape
        if part <= 0 or part >= 1:
            return LoopMoment(self._canvas(objects * pixels if part > 0 else 0), None, {})
        step = min(int(part * len(self._line)), len(self._line) - 1)
        tests = int(self._tests[step])
        last = min(max(tests - 1, 0) if self._is_done(step) else tests, objects * pixels - 1)
        pixel = last % pixels if self.by_object else last // objects
        recent = self._line[max(0, step - int(GLOW * len(self._line))) : step + 1]
        counts = np.bincount(recent)
        lit = {int(n): float(counts[n] / counts.max()) for n in np.flatnonzero(counts)}
        return LoopMoment(self._canvas(tests), divmod(pixel, self.hits.size[0]), lit)

    def _is_done(self, step: int) -> bool:
        """Return True if a step's line belongs to the test before it."""
        return self.lines[self._line[step]].when in ("nearer", "after")

    def _canvas(self, tests: int) -> Floats:
        """Return the canvas after that number of tests."""
        objects, pixels = self.hits.t.shape
        at = np.arange(pixels)
        if self.by_object:
            tested = tests // pixels + (at < tests % pixels)
        else:
            tested = np.clip(tests - objects * at, 0, objects)
        if self.sets_all:
            tested[tested < objects] = 0
        canvas = self.hits.colors[tested, at]
        if self.sets_all:
            empty = (tested == objects) & np.isnan(canvas[:, 0])
            canvas[empty] = self.hits.background
        width, height = self.hits.size
        return canvas.reshape(height, width, 3)


def run_part(option: float) -> float:
    """Return the share of a run that is done. Each whole number of the option is another run."""
    return option if option <= 0 else option - math.ceil(option) + 1
