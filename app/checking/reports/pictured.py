"""Pictures of a wrong answer: the given and the correct one, large enough to see the difference.

For rays, the student's function is called once more, for a larger image of the first wrong case's
camera: the checked images are small.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.calls import Failure, Student
from lucida.app.checking.checked import TaskResult, WrongCase
from lucida.app.checking.conventions import Shot
from lucida.app.checking.kinds.viewing_ray import VIEWING_RAY, cases_of
from lucida.app.checking.reports.picture import picture
from lucida.app.checking.reports.told import told

Bytes = NDArray[np.uint8]

SIDE = 96  # approximate picture size; a whole multiple of the case's size


@dataclass(frozen=True, eq=False)
class Pictured:
    """Pictures, sRGB (H, W, 3): the given answer and the correct one."""

    given: Bytes
    right: Bytes


def pictured(student: Student, result: TaskResult) -> Pictured | None:
    """Return the pictures of a wrong answer, as far as the task's feedback allows.

    Return None for other kinds of functions, or if the student's code fails at a larger image.
    """
    first = told(result).first
    if first is None or first.case.camera is None:
        return None
    if result.task.kind == "viewing-ray":
        return _of_rays(student, result, first)
    if result.task.kind == "render":
        return _of_images(result, first)
    return None


def _of_rays(student: Student, result: TaskResult, first: WrongCase) -> Pictured | None:
    case = first.case
    assert case.camera and case.size and case.target and case.up
    camera, (width, height) = case.camera, case.size
    times = max(1, SIDE // max(width, height))
    size = width * times, height * times
    task, kind = result.task, VIEWING_RAY
    shot = Shot(camera, size, case.target, case.up)
    cases = cases_of(task, shot)
    run = student.call(kind.calls(task, cases))
    if run.failure or any(isinstance(value, Failure) for value in run.values):
        return None
    given, problems = kind.given(task, cases, run.values)
    if problems:
        return None
    right = [one.right for one in cases]
    rays = (np.reshape(part, (size[1], size[0], 2, 3)) for part in (given, right))
    return Pictured(*(picture(camera, size, part) for part in rays))


def _of_images(result: TaskResult, first: WrongCase) -> Pictured | None:
    given, right = first.answer, np.asarray(first.case.right, float)
    upright = -1 if result.task.conventions.rows == "bottom" else 1
    return Pictured(_bytes(np.asarray(given, float)[::upright]), _bytes(right[::upright]))


def _bytes(image: NDArray[np.float64]) -> Bytes:
    """Return numbers from 0 to 1 as bytes, unconverted; black where they are missing."""
    return np.rint(255 * np.clip(np.nan_to_num(image), 0, 1)).astype(np.uint8)
