"""The explanation of wrong viewing rays: by name, and by what is correct about them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.checking.mistakes.diagnosis import Diagnosis, named
from lucida.app.checking.mistakes.program import Program
from lucida.app.checking.mistakes.ray_facts import facts
from lucida.app.checking.mistakes.ray_trial import RayCase, RayTrial
from lucida.app.checking.mistakes.rays import RayTask, ray_program


def diagnose_rays(
    cases: Sequence[RayCase],
    given: ArrayLike,
    wrong: ArrayLike,
    task: RayTask | None = None,
    any_origin: bool = False,
) -> Diagnosis | None:
    """Return the diagnosis of the rays given for these pixels; None if none is wrong.

    given: origins and directions in the world, (N, 2, 3).
    wrong: the wrong ones, (N,).
    task: how the rays were asked for; each camera's projection replaces the task's.
    any_origin: any point of a ray may be its origin.
    """
    flags = np.asarray(wrong, bool)
    if not flags.any():
        return None
    rays, own_task = np.asarray(given, float).reshape(-1, 2, 3), task or RayTask()

    def program_and_trial(kind: str, chosen: list[int]) -> tuple[Program, RayTrial]:
        its_task = replace(own_task, projection=kind)
        its_cases = [cases[number] for number in chosen]
        return ray_program(its_task), RayTrial(its_cases, rays[chosen], its_task, any_origin)

    kinds = [case.camera.projection for case in cases]
    sentences, found, explained = named(kinds, flags, program_and_trial)
    if not explained:
        sentences += facts(cases, RayTrial(cases, rays, own_task, any_origin), flags)
    return Diagnosis(tuple(sentences), found)
