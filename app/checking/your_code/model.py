"""The questions to a file about the window's camera, and the rays in its answers.

A report holds the findings on a file as one immutable value: a thread makes it, the view reads it.
Pure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.checked import TaskResult, judged
from lucida.app.checking.conventions import Shot
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds.viewing_ray import cases_of
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckCase, CheckTask, Failure, Run
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

Floats = NDArray[np.float64]

RAY = "viewing-ray"  # the kind of task whose function makes pictures of a camera
RAY_TASK = next(task for task in BUILTIN if task.kind == RAY)
EXACT = 1e-6  # in pixels: a corner belongs to its upper left pixel
ENDLESS = ("time", "memory", "ended")  # after these, a file is not run for another camera


@dataclass(frozen=True, eq=False)
class CodeRays:
    """The rays of an image, as a function computes them, and the correct rays.

    size: (width, height).
    given, right: origins and directions, (H, W, 2, 3); NaN if missing.
    wrong: the wrong rays among those returned, bool (H, W).
    result: the result of the check.
    """

    task: CheckTask
    camera: Camera
    size: Size
    given: Floats
    right: Floats
    wrong: NDArray[np.bool_]
    result: TaskResult

    @property
    def came(self) -> NDArray[np.bool_]:
        """The pixels that have a ray, bool (H, W)."""
        return np.asarray(np.isfinite(self.given).all(axis=(2, 3)))


def ray_task_for(camera: Camera) -> CheckTask:
    """Return the task of a viewing ray for this camera's projection."""
    return next(one for one in BUILTIN if one.kind == RAY and camera.projection == one.projection)


def cases_for(task: CheckTask, camera: Camera, size: Size) -> list[CheckCase]:
    """Return the case of each pixel. camera: the camera for that size."""
    return cases_of(task, Shot(camera, size, camera.eye, camera.v))


def rays_of(task: CheckTask, size: Size, cases: Sequence[CheckCase], run: Run) -> CodeRays:
    """Return the rays of a run that answers all of the cases, or the first of them."""
    camera = cases[0].camera
    assert camera is not None
    kind = KINDS[task.kind]
    values = [None if isinstance(value, Failure) else value for value in run.values]
    given = np.array(kind.given(task, cases, values)[0])
    wrong = kind.wrong(task, cases, given) & np.isfinite(given).all(axis=(1, 2))
    right = np.array([case.right for case in cases], float)
    shape = size[1], size[0]
    given, right = given.reshape(*shape, 2, 3), right.reshape(*shape, 2, 3)
    result = judged(replace(task, feedback="first-wrong"), cases, run)
    return CodeRays(task, camera, size, given, right, wrong.reshape(shape), result)


def canvas_pixel(
    pixel: tuple[int, int], of: Camera, size: Size, to: Camera, to_size: Size
) -> tuple[int, int]:
    """Return the pixel of another image of the same view that is nearest to a pixel's centre.

    The cameras differ in their viewports. Both pixels are (row, column), from 0.
    """
    ray = of.pinhole.ray(*pixel, size)
    seen = to.pinhole.project(ray.origin + ray.direction, to_size)
    row, column = (int(place + 0.5 - EXACT) for place in (seen.row, seen.column))
    return min(max(row, 0), to_size[1] - 1), min(max(column, 0), to_size[0] - 1)


@dataclass(frozen=True)
class CodeQuestion:
    """A question to a file.

    version: the file's version, which changes with each save.
    camera, size: the camera and the size of the pictures.
    """

    path: str
    version: int
    camera: Camera
    size: Size

    def differs_in_camera(self, other: CodeQuestion) -> bool:
        """Return True if the questions differ only in the camera."""
        return replace(self, camera=other.camera) == other


@dataclass(frozen=True, eq=False)
class CodeReport:
    """The findings on a file.

    rays: the rays for the window's camera; None if the file answers nothing.
    results: the results of tasks that were tried with other cameras, by name.
    failure: the reason for missing answers.
    output: the text that the file printed.
    """

    question: CodeQuestion
    rays: CodeRays | None = None
    results: Mapping[str, TaskResult] = field(default_factory=dict)
    failure: Failure | None = None
    output: str = ""

    @property
    def halted(self) -> bool:
        """True if the file should not rerun by itself, because it would take as long again."""
        return self.failure is not None and self.failure.kind in ENDLESS

    @property
    def untried(self) -> CheckTask | None:
        """The task to try with other cameras; None if there is none or it has been tried."""
        if self.rays is None or self.failure or self.rays.task.name in self.results:
            return None
        return self.rays.task
