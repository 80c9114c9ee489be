"""From a task and its wrong answers to the diagnosis: which program of mistakes is asked."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.conventions import PAIRS, Conventions
from app.checking.kinds.kind import Flags
from app.checking.kinds.viewing_ray import are_right
from app.checking.mistakes.basis import BASIS
from app.checking.mistakes.corners import has_corners
from app.checking.mistakes.diagnosis import Diagnosis
from app.checking.mistakes.hits import CLOSEST, SHAPES, SPHERE, TRIANGLE
from app.checking.mistakes.images import bitmap_program, gray_program, offset_program
from app.checking.mistakes.program import Program
from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_trial import RayCase
from app.checking.mistakes.rays import WORDS, RayTask
from app.checking.mistakes.render import render_program, render_values
from app.checking.mistakes.sides import SIZES
from app.checking.mistakes.value_diagnosis import ValueCase, diagnose_values
from app.checking.tasks import CheckCase, CheckTask
from renderer.pixels import Indexing

_HITS = ("hit-sphere", "hit-triangle", "closest-hit")
_KNOWN = {"eye", "target", "up", "origin", "direction", "center", "radius", "a", "b", "c"}
_KNOWN |= {"gray", "threshold", "i", "j", "width", "height"}
MOST = 1000  # cases of rays that are looked at: of a large image, these
LETTERS = {"row": "i", "column": "j"}  # by which the table knows them

# Words by what the table of wrong lines calls them.
_SAME = {
    "row": {"i"},
    "column": {"j"},
    "size": {"width", "height"},
    "viewport": {"left", "right", "bottom", "top"},
    **{name: set(pair) for name, pair in PAIRS.items()},
}
_PIXELS = ({"i", "j"}, {"x_pixel", "y_pixel"}, {"x01", "y01"}, {"x11", "y11"})
_EDGES = {"left", "right", "bottom", "top"}
_FRAMES = ({"eye", "u", "v", "w"}, {"eye", "target", "up"}, {"eye", "forward", "up"})
_MATRICES = {"camera_to_world", "world_to_camera"}


def diagnosis(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    """What is told of the wrong answers of a task beside the first one; None where nothing is.

    given: in the kind's own form. wrong: bool (N,), which are."""
    with np.errstate(all="ignore"):  # they may be any numbers
        if task.kind == "viewing-ray":
            return _of_rays(task, cases, np.asarray(given), wrong)
        if (
            task.kind in _HITS
            and np.isinf(np.asarray(given, float)).reshape(len(cases), -1)[:, -1].all()
        ):
            return Diagnosis(("It never finds a hit: all its answers are misses.",))
        if task.kind == "render":
            projections = [case.camera.projection for case in cases if case.camera is not None]
            first = projections[int(np.argmax(wrong))]
            chosen = [n for n, projection in enumerate(projections) if projection == first]
        else:
            chosen = list(range(len(cases)))
        asked = [_value_case(task, cases[number], given[number]) for number in chosen]
        return diagnose_values(_program(task, cases[chosen[0]]), asked, wrong[chosen])


def _program(task: CheckTask, case: CheckCase) -> Program:
    match task.kind:
        case "basis":
            return BASIS
        case "hit-sphere":
            return SPHERE
        case "hit-triangle":
            return TRIANGLE
        case "closest-hit":
            return CLOSEST
        case "to-gray":
            return gray_program(task.weights)
        case "to-bitmap":
            return bitmap_program(task.inclusive)
        case "memory-offset":
            return offset_program(task.conventions.base, task.column_major, task.stride)
    return render_program(_render_task(task, case))


def _render_task(task: CheckTask, case: CheckCase) -> RayTask:
    """As the student writes the loops: from 0, whatever the task counts elsewhere."""
    assert case.camera is not None
    rays = ray_task(replace(task.conventions, base=0))
    return replace(rays, projection=case.camera.projection)


def _value_case(task: CheckTask, case: CheckCase, given: Any) -> ValueCase:
    values = case.values
    known = {name: _array(value) for name, value in values.items() if name in _KNOWN}
    if task.kind == "closest-hit":
        known |= {"objects": values["objects"], **SHAPES}
    if task.kind == "to-gray":
        red, green, blue = np.moveaxis(np.asarray(values["rgb"], float), 2, 0)
        known |= {"red": red, "green": green, "blue": blue}
    if task.kind == "render":
        assert case.camera is not None and case.size is not None
        rays = _render_task(task, case)
        scene = values["scene"]
        of_camera = render_values(
            case.camera, case.size, rays, scene["objects"], scene["background"]
        )
        up = {"target": np.asarray(case.target), "up": np.asarray(case.up)}
        return ValueCase({**of_camera, **up}, case.right, given, case.tolerance, values["judged"])
    exact = task.kind in ("to-bitmap", "memory-offset")
    tolerance = None if exact else float(case.tolerance)
    return ValueCase(known, np.asarray(case.right, float), given, tolerance)


def _array(value: Any) -> Any:
    return np.asarray(value, float) if isinstance(value, list) else value


def _of_rays(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    if task.conventions.unit:
        right = np.array([case.right for case in cases], float)
        tolerance = np.array([case.tolerance for case in cases], float)
        of_any_length = replace(task.conventions, unit=False)
        if are_right(of_any_length, right, given, tolerance).all():
            return Diagnosis(("The directions are right, but not of length 1: normalise them.",))
    chosen = np.arange(len(cases)) if len(cases) <= MOST else _some(wrong)
    asked = [
        RayCase(case.camera, case.size, case.pixel, case.target, case.up)
        for case in (cases[number] for number in chosen.tolist())
        if case.camera is not None and case.size is not None and case.pixel is not None
    ]
    found = diagnose_rays(
        asked,
        given[chosen],
        wrong[chosen],
        ray_task(task.conventions),
        any_origin=task.conventions.any_origin,
    )
    if found is None:
        return None
    return replace(found, sentences=_in_the_tasks_words(task, found.sentences))


def _some(wrong: Flags) -> NDArray[np.intp]:
    """As many numbers of cases as are looked at, evenly of those that are wrong and of the
    others; the first of each is one of them."""
    parts = []
    for flags in (wrong, ~wrong):
        numbers = np.flatnonzero(flags)
        step = max(len(numbers) * 2 // MOST, 1)
        parts.append(numbers[::step])
    return np.sort(np.concatenate(parts))


def ray_task(conventions: Conventions) -> RayTask:
    """How the table of wrong lines has these words; the camera's own, where it has not."""
    words = {same for word in conventions.words for same in _SAME.get(word, {word})}
    pixel = next((pair for pair in _PIXELS if pair <= words), {"i", "j"})
    if {"rotation", "eye"} <= words or (words & _MATRICES and conventions.row_vectors):
        words = words - _MATRICES | {"eye", "u", "v", "w"}
    seen = words >= _EDGES or words >= set(SIZES) or any(word.startswith("fov") for word in words)
    placed = bool(words & _MATRICES) or any(frame <= words for frame in _FRAMES)
    if not (has_corners(words) or (seen and placed)):
        words = set(WORDS)
    words = words - set().union(*_PIXELS) | pixel | {"width", "height"}
    return RayTask(
        indexing=Indexing(conventions.base),
        from_top=conventions.rows == "top",
        words=frozenset(words),
        axes=conventions.axes,
    )


def _in_the_tasks_words(task: CheckTask, sentences: Sequence[str]) -> tuple[str, ...]:
    """The sentences, and what the task calls the letters of a pixel in them."""
    text = " ".join(sentences)
    called = []
    for name, word in task.conventions.arguments:
        for place, part in enumerate(PAIRS.get(word, (word,))):
            letter = LETTERS.get(part, part)
            own = name if word not in PAIRS else f"{name}[{place}]"
            if own != letter and re.search(rf"\b{letter}\b", text):
                called.append(f"{letter} is your `{own}`")
    return (*sentences, f"Here {' and '.join(called)}.") if called else tuple(sentences)
