"""Random views of random scenes: the rasterizer against the tracer, pixel by pixel.

    python -m tools.attack.random_views --views 10000 --processes 2
    python -m tools.attack.random_views --seed 1 --first 4711 --views 1      one view again

Prints a line for each view with unexplained pixels (or an error), whose number and seed make it
again, and a total; the exit status is 1 if there was any. View n of a seed is the same whatever was
drawn before it.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import random
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from lucida import Camera, Rasterizer, Scene, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS, Comparison, compare_frames
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.flat import FlatScene, flatten
from tools.attack.random_scenes import random_lens, random_scene, random_view

VIEWS_OF_A_SCENE = 10
CHUNK = 10 * VIEWS_OF_A_SCENE  # views that a process takes at a time


@dataclass(frozen=True)
class Task:
    """Views first to last - 1 of a seed; offset: how far from the origin their scenes are.

    lenses: the part of the views that are through a lens.
    """

    seed: int
    first: int
    last: int
    offset: float = 0.0
    backend: str = "auto"
    lenses: float = 0.0


@dataclass
class Total:
    """Lines about failing views; counts of views, of those that hit anything, and of pixels."""

    lines: list[str] = field(default_factory=list)
    views: int = 0
    seeing: int = 0
    pixels: int = 0
    unexplained: int = 0
    explained: Counter[str] = field(default_factory=Counter)

    def add(self, other: Total) -> None:
        self.lines += other.lines
        self.views += other.views
        self.seeing += other.seeing
        self.pixels += other.pixels
        self.unexplained += other.unexplained
        self.explained += other.explained

    def __str__(self) -> str:
        causes = ", ".join(f"{name} {count}" for name, count in self.explained.most_common())
        return (
            f"{self.views} views, {self.seeing} that see something, {self.pixels} pixels: "
            f"{len(self.lines)} views fail, {self.unexplained} pixels unexplained; "
            f"explained: {causes or 'none'}"
        )


def scene_of(task: Task, number: int) -> Scene:
    """The scene of a view: the same for VIEWS_OF_A_SCENE views."""
    rng = np.random.default_rng([task.seed, 0, number // VIEWS_OF_A_SCENE])
    return random_scene(rng, task.offset)


def view_of(task: Task, number: int, flat: FlatScene) -> tuple[str, Camera, tuple[int, int]]:
    """(what it tries, camera, size) of a view of that scene."""
    rng = np.random.default_rng([task.seed, 1, number])
    kind, camera = random_view(rng, flat)
    width, height = rng.integers(1, 90, 2).tolist()
    through = np.random.default_rng([task.seed, 2, number])
    if through.random() < task.lenses:
        camera = random_lens(through, camera)
    return kind, camera, (width, height)


def run(task: Task, spoiled: Callable[[Frame], Frame] = lambda frame: frame) -> Total:
    """Compare the task's views, in this process. spoiled: changes the ray images."""
    total = Total()
    with (
        warnings.catch_warnings(),
        Rasterizer(Scene(()), backend=task.backend) as rasterizer,
        Tracer(Scene(()), threads=1) as tracer,
    ):
        warnings.simplefilter("error", RuntimeWarning)
        drawn = -1
        for number in range(task.first, task.last):
            if number // VIEWS_OF_A_SCENE != drawn:
                drawn = number // VIEWS_OF_A_SCENE
                scene = scene_of(task, number)
                flat = flatten(scene)
                rasterizer.set_scene(scene)
                tracer.set_scene(scene)
            kind, camera, size = view_of(task, number, flat)
            where = f"view {number}, {kind}, {camera.projection}, {size[0]}x{size[1]}"
            where += ", cut" if camera.near or camera.far else ""
            where += f", {camera.lens.model}" if camera.lens is not None else ""
            total.views += 1
            try:
                result = compared(flat, rasterizer, tracer, camera, size, spoiled)
            except Exception as error:  # whatever a view brings about is a finding
                total.lines.append(f"{where}: {type(error).__name__}: {error}")
                continue
            total.pixels += result.pixels
            total.seeing += bool((result.ray.channel("id") >= 0).any())
            total.explained += Counter(result.explained)
            if result.unexplained:
                total.unexplained += result.unexplained
                total.lines.append(
                    f"{where}: {result.unexplained} of {result.pixels} pixels unexplained"
                    + (f", {result.shading} in the colour alone" if result.shading else "")
                )
    return total


def compared(
    flat: FlatScene,
    rasterizer: Rasterizer,
    tracer: Tracer,
    camera: Camera,
    size: tuple[int, int],
    spoiled: Callable[[Frame], Frame],
) -> Comparison:
    enlargement = 1 + size[0] % 2
    raster = rasterizer.render(camera, size, CHANNELS, enlargement=enlargement)
    ray = spoiled(tracer.render(camera, size, CHANNELS))
    return compare_frames(flat, camera, size, raster, ray, enlargement=enlargement)


def _deeper(frame: Frame) -> Frame:
    """Plant a fault that must be noticed."""
    return replace(frame, depth=frame.channel("depth") * np.float32(1.01))


def _totals(tasks: list[Task], processes: int) -> Iterator[Total]:
    if processes == 1:
        yield from map(run, tasks)
        return
    # Anew, not forked: neither OpenGL nor the tracer's threads outlive a fork.
    os.environ.setdefault("LP_NUM_THREADS", "1")  # of OpenGL, where it runs on the processor
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        yield from pool.imap(run, tasks)


def main(argv: list[str] | None = None) -> int:
    """The command line; gives the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--views", type=int, default=1000, metavar="N")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="number of the first")
    parser.add_argument("--seed", type=int, metavar="S", help="a random one where none is given")
    parser.add_argument(
        "--minutes", type=float, default=math.inf, help="no further views after that"
    )
    parser.add_argument("--offset", type=float, default=0.0, metavar="D", help="from the origin")
    parser.add_argument(
        "--lenses", type=float, default=0.25, metavar="PART", help="of the views, through a lens"
    )
    parser.add_argument("--processes", type=int, default=1, metavar="N")
    parser.add_argument("--backend", default="auto", help="of OpenGL: egl, osmesa or auto")
    chosen = parser.parse_args(argv)
    chosen.seed = random.randrange(1 << 20) if chosen.seed is None else chosen.seed
    last = chosen.first + chosen.views
    tasks = [
        Task(
            chosen.seed,
            first,
            min(first + CHUNK, last),
            chosen.offset,
            chosen.backend,
            chosen.lenses,
        )
        for first in range(chosen.first, last, CHUNK)
    ]
    if not run(Task(1, 0, VIEWS_OF_A_SCENE), _deeper).lines:
        print("random_views: depths that are wrong are not noticed: the attack sees nothing")
        return 1
    total, end_s = Total(), time.monotonic() + 60 * chosen.minutes
    for part in _totals(tasks, max(1, min(chosen.processes, len(tasks)))):
        for line in part.lines:
            print(f"seed {chosen.seed}, {line}", flush=True)
        total.add(part)
        if time.monotonic() > end_s:
            break
    print(total)
    return 1 if total.lines else 0


if __name__ == "__main__":
    sys.exit(main())
