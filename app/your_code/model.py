"""The questions to a file about the window's camera, and the rays that its answers are.

Turns a task and a camera into cases, and answers into the rays of a small image. Pure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.checking.builtin import BUILTIN
from app.checking.calls import Failure, Limits, Run
from app.checking.cases import check_views, shot_of
from app.checking.checked import TaskResult, judged
from app.checking.diagnosed import diagnosis
from app.checking.kinds import KINDS
from app.checking.kinds.basis import case_of
from app.checking.kinds.viewing_ray import cases_of
from app.checking.mistakes.diagnosis import Diagnosis
from app.checking.task_file import TaskSet, load_tasks
from app.checking.tasks import CheckCase, CheckTask
from renderer.camera import Camera, Size
from renderer.errors import LucidaError
from renderer.scene.model import View

Floats = NDArray[np.float64]

RAY, BASIS = "viewing-ray", "basis"  # the kinds of functions that make pictures of a camera
EXACT = 1e-9
LIMITS = Limits(seconds=10.0)  # of the built-in tasks


@dataclass(frozen=True, eq=False)
class CodeRays:
    """The rays of an image, as a function makes them and as they are. size: (width, height).

    origins, directions: (H, W, 3), NaN where nothing came; right_origins, right_directions
    likewise. wrong: bool (H, W), of what came. result: in the words of a check, without diagnosis.
    camera: the mirror image of the window's, where the course's coordinates are left-handed.
    seconds: that the calls took. cases, given: what was asked and answered, in the kind's own form.
    """

    task: CheckTask
    camera: Camera
    size: Size
    origins: Floats
    directions: Floats
    right_origins: Floats
    right_directions: Floats
    wrong: NDArray[np.bool_]
    result: TaskResult
    seconds: float
    cases: Sequence[CheckCase]
    given: Floats

    @property
    def came(self) -> NDArray[np.bool_]:
        """Which pixels have a ray, bool (H, W)."""
        numbers = np.isfinite(self.origins) & np.isfinite(self.directions)
        came: NDArray[np.bool_] = np.logical_and.reduce(numbers, axis=2)
        return came


def asked_of(path: str) -> TaskSet:
    """The tasks in a course's file, "" for the built-in ones. Raises LucidaError."""
    return load_tasks(path) if path else TaskSet("", BUILTIN, LIMITS)


def tasks_of(
    functions: frozenset[str] | None, asked: Sequence[CheckTask] = BUILTIN
) -> list[CheckTask]:
    """The tasks whose functions a file has, in their order."""
    return [task for task in asked if functions is None or task.function in functions]


def is_of_camera(task: CheckTask) -> bool:
    """Return True if the task's answers make a picture of the window's camera that the course lets
    the student see, since it shows what is wrong and where.
    """
    return task.kind in (RAY, BASIS) and task.feedback in ("first-wrong", "diagnosis")


def chosen_of(tasks: Sequence[CheckTask], name: str) -> CheckTask | None:
    """The task of that name; without one the first that makes a picture of the camera, or else the
    first."""
    wished = (task for task in tasks if task.name == name)
    pictured = (task for task in tasks if is_of_camera(task))
    return next(wished, None) or next(pictured, None) or next(iter(tasks), None)


def for_camera(task: CheckTask, camera: Camera, asked: Sequence[CheckTask] = BUILTIN) -> CheckTask:
    """The task of the same function for this camera's projection, where one of those asked is."""
    fitting = (
        one
        for one in asked
        if one.kind == task.kind == RAY
        and one.function == task.function
        and camera.projection in one.projections
    )
    return next(fitting, task)


def why_not_asked(task: CheckTask, camera: Camera, size: Size) -> str:
    """Why a task cannot be asked of a camera, in words; empty where it can."""
    if task.kind != RAY:
        return ""
    if camera.projection not in task.projections:
        other = "parallel" if "parallel" in task.projections else "perspective"
        return f"{task.name} is for {other} projection: P switches to it."
    view = View(camera, fit=False)
    try:
        check_views(replace(task, views=(view,), size=size))
    except LucidaError as error:
        return (
            f"{task.name} is not asked of this camera: it {error.problem}. Make it orthonormal, "
            "with a symmetric viewport, pixels square."
        )
    if task.conventions.needs_rigid and camera.determinant < 0:
        return f"{task.name} is not asked of this camera: it is left-handed. Turn u round."
    return ""


def cases_for(task: CheckTask, camera: Camera, size: Size) -> list[CheckCase]:
    """Return the cases: the ray of each pixel, or the basis, once. camera: for that size."""
    shot = shot_of(View(camera, fit=False), size, task.conventions)
    if task.kind == RAY:
        return cases_of(task, shot)
    return [case_of(task, camera.eye, shot.target, shot.up)]


def rays_of(
    task: CheckTask,
    camera: Camera,
    size: Size,
    cases: Sequence[CheckCase],
    run: Run,
    seconds: float = 0.0,
) -> CodeRays:
    """The rays of a run that answers the cases, or the first of them."""
    kind = KINDS[task.kind]
    values = [None if isinstance(value, Failure) else value for value in run.values]
    given, _ = kind.given(task, cases, values)
    result = judged(replace(task, feedback="first-wrong"), cases, run)
    if task.kind == RAY:
        right, rays = kind.right(cases), given
        wrong = kind.wrong(task, cases, given) & np.isfinite(given).all(axis=(1, 2))
    else:
        right, rays = _turned(camera, size, kind.right(cases)[0]), _turned(camera, size, given[0])
        wrong = np.full(len(rays), bool(kind.wrong(task, cases, given)[0]))
        wrong &= np.isfinite(rays).all(axis=(1, 2))
    width, height = size
    shape = (height, width, 3)
    return CodeRays(
        task,
        cases[0].camera or camera,
        size,
        rays[:, 0].reshape(shape),
        rays[:, 1].reshape(shape),
        right[:, 0].reshape(shape),
        right[:, 1].reshape(shape),
        wrong.reshape(height, width),
        result,
        seconds,
        cases,
        given,
    )


def diagnosis_of(rays: CodeRays) -> Diagnosis | None:
    """Return what the rays are instead, as far as known. Takes a while."""
    wrong = KINDS[rays.task.kind].wrong(rays.task, rays.cases, rays.given)
    return diagnosis(rays.task, rays.cases, rays.given, wrong)


def _turned(camera: Camera, size: Size, basis: Floats) -> Floats:
    """The camera's rays with another basis, u, v, w in its rows: (N, 2, 3)."""
    width, height = size
    i, j = np.indices((height, width)).reshape(2, -1)
    rays = camera.ray(i, j, size)
    count = width * height
    eye = np.asarray(camera.eye)
    change = np.linalg.inv(camera.basis).T @ basis
    origins = eye + (np.broadcast_to(rays.origin, (count, 3)) - eye) @ change
    directions = np.broadcast_to(rays.direction, (count, 3)) @ change
    return np.stack([origins, directions], axis=1)


def canvas_pixel(
    pixel: tuple[int, int], of: Camera, size: Size, to: Camera, to_size: Size
) -> tuple[int, int]:
    """The pixel of another image of the same view, nearest to a pixel's centre; the cameras differ
    in their viewports, or one is the other's mirror image. Both (row, column), from 0."""
    left, right, bottom, top = of.viewport
    x = left + (pixel[1] + 0.5) / size[0] * (right - left)
    y = top - (pixel[0] + 0.5) / size[1] * (top - bottom)
    x = -x if np.dot(of.u, to.u) < 0 else x
    left, right, bottom, top = to.viewport
    row = int((top - y) / (top - bottom) * to_size[1] - EXACT)
    column = int((x - left) / (right - left) * to_size[0] - EXACT)
    return min(max(row, 0), to_size[1] - 1), min(max(column, 0), to_size[0] - 1)
