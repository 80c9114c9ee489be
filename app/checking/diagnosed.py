"""From a task and its wrong answers to the diagnosis: which program of mistakes is asked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from app.checking.conventions import PAIRS, Conventions
from app.checking.kinds.kind import Flags
from app.checking.kinds.viewing_ray import are_right
from app.checking.mistakes.diagnosis import Diagnosis
from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_trial import RayCase
from app.checking.mistakes.rays import WORDS, RayTask
from app.checking.tasks import CheckCase, CheckTask
from renderer.pixels import Indexing

_SAME = {"row": "i", "column": "j"}
_PIXELS = ({"i", "j"}, {"x01", "y01"}, {"x11", "y11"})
_EDGES = {"left", "right", "bottom", "top"}
_ANGLES = {"fov_y", "fov_x", "fov_y_rad", "fov_x_rad"}
_FRAMES = ({"eye", "u", "v", "w"}, {"eye", "target", "up"})
_MATRICES = {"camera_to_world", "world_to_camera"}


def diagnosis(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    """What is told of the wrong answers of a task beside the first one; None where nothing is.

    given: in the kind's own form. wrong: bool (N,), which are."""
    if task.kind == "viewing-ray":
        return _of_rays(task, cases, np.asarray(given), wrong)
    return None


def _of_rays(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    if task.conventions.unit:
        right = np.array([case.right for case in cases], float)
        tolerance = np.array([case.tolerance for case in cases], float)
        of_any_length = replace(task.conventions, unit=False)
        if are_right(of_any_length, right, given, tolerance).all():
            return Diagnosis(("The directions are right, but not of length 1: normalise them.",))
    asked = [
        RayCase(case.camera, case.size, case.pixel, case.target, case.up)
        for case in cases
        if case.camera is not None and case.size is not None and case.pixel is not None
    ]
    return diagnose_rays(
        asked, given, wrong, ray_task(task.conventions), any_origin=task.conventions.any_origin
    )


def ray_task(conventions: Conventions) -> RayTask:
    """How the table of wrong lines has these words; the camera's own, where it has not."""
    words = {_SAME.get(word, word) for word in conventions.words}
    words |= {part for word in words & PAIRS.keys() for part in PAIRS[word]}
    pixel = next((pair for pair in _PIXELS if pair <= words), {"i", "j"})
    camera = words & (WORDS | _ANGLES | _MATRICES | {"target", "up", "aspect"})
    framed = any(frame <= words for frame in _FRAMES)
    by_matrix = bool(words & _MATRICES) and conventions.axes == (1, 1, 1)
    seen = words >= _EDGES or bool(words & _ANGLES)
    if not (seen and (framed or (by_matrix and not conventions.row_vectors))):
        camera = set(WORDS)
    camera = camera - {"i", "j"} | pixel | {"width", "height"}
    indexing = Indexing(conventions.base)
    return RayTask("perspective", indexing, conventions.rows == "top", frozenset(camera))
