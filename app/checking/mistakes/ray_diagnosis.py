"""The explanation of wrong viewing rays: by name, as a camera, and by what is correct about
them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.checking.mistakes.diagnosis import Diagnosis, named
from app.checking.mistakes.difference import Fit
from app.checking.mistakes.differences import told_differences
from app.checking.mistakes.fitted import affine_rays
from app.checking.mistakes.program import Program
from app.checking.mistakes.ray_facts import Rays, facts, kept
from app.checking.mistakes.ray_trial import Lengths, RayCase, RayTrial, images
from app.checking.mistakes.rays import RayTask, ray_program
from app.explaining.symbols import marked

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

FITTED = 12  # wrong images at most


def diagnose_rays(
    cases: Sequence[RayCase],
    given: ArrayLike,
    wrong: ArrayLike,
    task: RayTask | None = None,
    lengths: Lengths = "any",
    any_origin: bool = False,
) -> Diagnosis | None:
    """Return the diagnosis of the rays given for these pixels; None if none is wrong.

    given: origins and directions in the world, (N, 2, 3).
    wrong: the wrong ones, (N,).
    task: how the rays were asked for; each camera's projection replaces the task's.
    lengths: directions must have the correct length ("exact") or may have any.
    any_origin: any point of a ray may be its origin.
    """
    flags = np.asarray(wrong, bool)
    if not flags.any():
        return None
    rays, own_task = np.asarray(given, float).reshape(-1, 2, 3), task or RayTask()

    def program_and_trial(kind: str, chosen: list[int]) -> tuple[Program, RayTrial]:
        its_task = replace(own_task, projection=kind)
        its_cases = [cases[number] for number in chosen]
        trial = RayTrial(its_cases, rays[chosen], its_task, lengths, any_origin)
        return ray_program(its_task), trial

    kinds = [case.camera.projection for case in cases]
    sentences, found, explained = named(kinds, flags, program_and_trial)
    fits = _fits(cases, rays, flags)
    differences = told_differences(fits) if fits else ()
    camera = fits[0].rays.camera(fits[0].asked, fits[0].size) if fits else None
    asked = Rays(cases, rays, flags, own_task, any_origin, camera is not None)
    if remembered := kept(asked):
        sentences.append(f"Or, with the same numbers: {remembered}" if sentences else remembered)
    if not explained:
        if differences:
            sentences.append(
                f"What you wrote is a camera, only another one: {marked('; '.join(differences))}."
            )
        sentences += facts(asked)
    return Diagnosis(tuple(sentences), found, differences, camera, int(np.argmax(flags)))


def _fits(cases: Sequence[RayCase], rays: Floats, wrong: Flags) -> list[Fit]:
    """Return the cameras fitted to the wrong images; none if an image belongs to no camera."""
    fits = []
    chosen = [(first, last) for first, last in images(cases) if wrong[first:last].any()]
    for first, last in chosen[:FITTED]:
        case = cases[first]
        i, j = np.array([one.pixel for one in cases[first:last]]).T
        scale = float(np.linalg.norm(case.camera.eye))
        found = affine_rays(i, j, rays[first:last, 0], rays[first:last, 1], scale)
        if found is None or found.camera(case.camera, case.size) is None:
            return []
        fits.append(Fit(case.camera, case.size, found, case.target, case.up))
    return fits
