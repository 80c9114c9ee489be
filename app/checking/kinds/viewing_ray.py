"""The viewing ray of a pixel, in the words of any course.

Answers are arrays (2, 3): origin and direction in the world.

Tolerances. Let S = X|u| + Y|v| + d|w|, where X = max(|left|, |right|) + (right - left) and Y is
the same for bottom and top. No intermediate result is larger than M = |eye| + S: neither a point
on the viewport nor the difference after the eye is subtracted again. An origin is correct within
FLOAT32 * M; a direction, as an angle, within FLOAT32 * M / |direction|. If the basis follows from
a target, eye - target cancels as well, and so does up x w if the two are nearly parallel: the
angle grows by the tolerance of basis.py. A direction of unit length is correct within FLOAT32. The
generated cameras have M / |direction| < 60, which is a tolerance of 3e-4; half a pixel of their
images is at least 1e-2.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.checking.cases import shots
from lucida.app.checking.conventions import Conventions, Shot, argument_lists
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import described
from lucida.renderer.camera.camera import Camera

from .basis import conditioning
from .kind import FLOAT32, Cases, CheckKind, Flags, Floats, vectors


class ViewingRayKind(CheckKind):
    def cases(self, task: CheckTask) -> list[CheckCase]:
        return [case for shot in shots(task) for case in cases_of(task, shot)]

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> Floats | None:
        returns, right = task.conventions.returns, np.asarray(case.right)
        if (parts := vectors(value, returns)) is None:
            return None
        given = np.zeros((2, 3))
        places = [self.returns.index(name) for name in returns]
        given[places] = parts
        if task.conventions.space == "camera":
            frame, eye = _frame(task.conventions, case)
            with np.errstate(all="ignore"):
                given = given @ frame.T + [eye, np.zeros(3)]
        others = [place for place in (0, 1) if place not in places]
        given[others] = right[others]  # a part that is not required counts as correct
        return given

    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        return ~are_right(cases, given, task.conventions.unit)

    def parts(self, task: CheckTask, case: CheckCase, answer: Floats) -> dict[str, Any]:
        ray = np.asarray(answer, float)
        if task.conventions.space == "camera":
            frame, eye = _frame(task.conventions, case)
            ray = np.linalg.solve(frame, (ray - [eye, np.zeros(3)]).T).T
        return super().parts(task, case, ray)

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        assert case.size is not None and case.pixel is not None
        width, height = case.size
        i, j = case.pixel
        where = f"pixel in row {i}, column {j} (from 0, from the top left) of {width}x{height}"
        return where, *super().first_wrong(task, case, answer)[1:]


VIEWING_RAY = ViewingRayKind(**described("viewing-ray"))


def cases_of(task: CheckTask, shot: Shot) -> list[CheckCase]:
    """Return a case for each pixel of an image."""
    width, height = shot.size
    i, j = (part.ravel() for part in np.indices((height, width)))
    rays = shot.camera.ray(i, j, shot.size)
    right = np.stack([rays.origin, rays.direction], axis=1)
    if task.conventions.unit:
        right[:, 1] /= np.linalg.norm(right[:, 1], axis=1, keepdims=True)
    tolerances = np.column_stack(_tolerances(task.conventions, shot, rays.direction))
    lists = argument_lists(shot, task.conventions, i, j)
    names = [name for name, _ in task.conventions.arguments]
    columns = [lists[word] for _, word in task.conventions.arguments]
    pixels = zip(i.tolist(), j.tolist(), strict=True)
    return [
        CheckCase(
            tuple(zip(names, values, strict=True)),
            ray,
            tolerance,
            {},
            shot.camera,
            shot.size,
            pixel,
            shot.target,
            shot.up,
        )
        for *values, ray, tolerance, pixel in zip(*columns, right, tolerances, pixels, strict=True)
    ]


def _tolerances(conventions: Conventions, shot: Shot, directions: Floats) -> tuple[Floats, Floats]:
    """Return the tolerances of origins and of directions, (N,) each; the module's docstring derives
    them.
    """
    camera = shot.camera
    largest = largest_number(camera)
    angle = largest / np.linalg.norm(directions, axis=1)
    origin = np.full(len(directions), largest)
    if {"target", "up"} & conventions.words:
        basis = conditioning(camera.eye, shot.target, shot.up)
        angle = angle + basis
        origin = origin + basis * _reach(camera)
    return FLOAT32 * origin, FLOAT32 * angle


def _reach(camera: Camera) -> float:
    """Return the X|u| + Y|v| of the module's docstring."""
    left, right, bottom, top = camera.viewport
    x = max(abs(left), abs(right)) + right - left
    y = max(abs(bottom), abs(top)) + top - bottom
    return float(x * np.linalg.norm(camera.u) + y * np.linalg.norm(camera.v))


def largest_number(camera: Camera) -> float:
    """Return the M of the module's docstring."""
    depth = camera.distance * np.linalg.norm(camera.w)
    return float(np.linalg.norm(camera.eye) + _reach(camera) + depth)


def are_right(cases: Cases, given: ArrayLike, unit: bool) -> Flags:
    """Return the correct rays, bool (N,).

    given: (N, 2, 3) in the world.
    unit: True if directions must be of length 1.
    """
    given = np.asarray(given)
    right = np.array([case.right for case in cases], float)
    tolerance = np.array([case.tolerance for case in cases], float)
    with np.errstate(all="ignore"):
        lengths = np.linalg.norm(given[:, 1], axis=1)
        directions = given[:, 1] / lengths[:, None]
        wanted = right[:, 1] / np.linalg.norm(right[:, 1], axis=1, keepdims=True)
        turned = np.linalg.norm(np.cross(directions, wanted), axis=1)
        ahead = np.sum(directions * wanted, axis=1) > 0
        fine = ahead & (turned <= tolerance[:, 1])
        fine &= np.linalg.norm(given[:, 0] - right[:, 0], axis=1) <= tolerance[:, 0]
        if unit:
            fine &= np.abs(lengths - 1) <= FLOAT32
    return fine


def _frame(conventions: Conventions, case: CheckCase) -> tuple[Floats, Floats]:
    """Return the axes of camera space as columns, and the eye."""
    assert case.camera is not None
    return case.camera.basis * np.array(conventions.axes, float), np.asarray(case.camera.eye)
