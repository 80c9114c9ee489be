"""The diagnosis of a task's wrong answers: chooses the program of mistakes to compare with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.kinds.kind import Flags
from lucida.app.checking.kinds.viewing_ray import are_right
from lucida.app.checking.mistakes.diagnosis import Diagnosis
from lucida.app.checking.mistakes.ray_diagnosis import diagnose_rays
from lucida.app.checking.mistakes.ray_trial import RayCase
from lucida.app.checking.mistakes.render import render_program, render_values
from lucida.app.checking.mistakes.value_diagnosis import (
    ValueCase,
    diagnose_by_kind,
    diagnose_values,
)
from lucida.app.checking.mistakes.value_programs import value_case
from lucida.app.checking.own_words import asked_rays, in_the_tasks_words, programs
from lucida.app.checking.tasks import CheckCase, CheckTask

MOST = 1000  # of rays that are examined; large images have more


def diagnosis(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    """Return the diagnosis of wrong answers in the task's words; None if there is nothing to say.

    given: the answers in the kind's own form.
    wrong: the wrong ones, bool (N,).
    """
    with np.errstate(all="ignore"):  # a student's numbers may be anything
        found = _diagnosis(task, cases, given, wrong)
    return found and replace(found, sentences=in_the_tasks_words(task, found.sentences))


def _diagnosis(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    """Return the same in the words of the programs."""
    if task.kind == "viewing-ray":
        return _of_rays(task, cases, np.asarray(given), wrong)
    if task.kind == "render":
        return _of_images(task, cases, given, wrong)
    if task.kind == "closest-hit" and np.isinf(np.asarray(given)[:, 1]).all():
        return Diagnosis(("You never find a hit.",))
    (program,) = programs(task)
    asked = [
        value_case(task.kind, case.values, np.asarray(case.right, float), answer, case.tolerance)
        for case, answer in zip(cases, given, strict=True)
    ]
    return diagnose_values(program, asked, wrong)


def _of_images(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    """Diagnose images."""
    rays = asked_rays(task)
    kinds, asked = [], []
    for case, image in zip(cases, given, strict=True):
        assert case.camera is not None and case.size is not None
        kinds.append(case.camera.projection)
        its_task = replace(rays, projection=case.camera.projection)
        scene = case.values["scene"]
        known = render_values(
            case.camera, case.size, its_task, scene["objects"], scene["background"]
        )
        known |= {"target": np.asarray(case.target), "up": np.asarray(case.up)}
        judged = case.values["judged"]
        asked.append(ValueCase(known, case.right, image, case.tolerance, judged))
    made = {kind: render_program(replace(rays, projection=kind)) for kind in kinds}
    return diagnose_by_kind(made, kinds, asked, wrong)


def _of_rays(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: Flags
) -> Diagnosis | None:
    if task.conventions.unit:
        right = np.array([case.right for case in cases], float)
        tolerance = np.array([case.tolerance for case in cases], float)
        of_any_length = replace(task.conventions, unit=False)
        if are_right(of_any_length, right, given, tolerance).all():
            return Diagnosis(("The directions are correct, but not of length 1: normalise them.",))
    chosen = np.arange(len(cases)) if len(cases) <= MOST else _some(wrong)
    asked = [
        RayCase(case.camera, case.size, case.pixel, case.target, case.up)
        for case in (cases[number] for number in chosen.tolist())
        if case.camera is not None and case.size is not None and case.pixel is not None
    ]
    return diagnose_rays(
        asked,
        given[chosen],
        wrong[chosen],
        asked_rays(task),
        any_origin=task.conventions.any_origin,
    )


def _some(wrong: Flags) -> NDArray[np.intp]:
    """Return the numbers of at most MOST cases, spread evenly over the wrong and over the other
    cases. The first of each is included.
    """
    parts = (np.flatnonzero(flags) for flags in (wrong, ~wrong))
    chosen = [part[:: 2 * len(part) // MOST or 1] for part in parts]
    return np.sort(np.concatenate(chosen))
