"""The correct parts of wrong rays, reported when no mistake fits."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.cases import is_orthonormal, is_symmetric
from lucida.app.checking.mistakes.candidates import LOOSE
from lucida.app.checking.mistakes.ray_trial import RayCase, RayTrial

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


def facts(cases: Sequence[RayCase], trial: RayTrial, wrong: Flags) -> list[str]:
    """Return a few sentences, the most helpful first. wrong: the wrong rays, (N,)."""
    broken = trial.count - np.count_nonzero(np.isfinite(trial.given).all(axis=(1, 2)))
    if broken:
        return [f"{broken} of {trial.count} rays have NaN or inf: look for a division by 0."]
    if np.ptp(trial.given, axis=0).max() == 0:
        return ["All your rays are the same: they do not depend on i and j."]
    return [*_parts(trial), *_where(cases, wrong)]


def _parts(trial: RayTrial) -> Iterator[str]:
    """Compare origins and directions separately."""
    right, given = trial.right, trial.given

    def is_right(origins: Floats, directions: Floats) -> Flags:
        made = np.stack([origins, directions], axis=1)
        return trial.apart(made, right, np.arange(trial.count)) <= LOOSE

    origins = is_right(given[:, 0], right[:, 1])
    directions = is_right(right[:, 0], given[:, 1])
    if origins.all() and not directions.all():
        yield "Your origins are correct, your directions are not."
    elif directions.all() and not origins.all():
        yield "Your directions are correct, your origins are not."


PLACES: dict[str, Callable[[RayCase], bool]] = {
    "in parallel projection": lambda case: case.camera.is_parallel,
    "in perspective": lambda case: not case.camera.is_parallel,
    "where the basis is orthonormal": lambda case: is_orthonormal(case.camera),
    "where the viewport is symmetric": lambda case: is_symmetric(case.camera),
    "where `distance` = 1": lambda case: case.camera.distance == 1.0,
    "in square images": lambda case: case.size[0] == case.size[1],
}  # fmt: skip


def _where(cases: Sequence[RayCase], wrong: Flags) -> Iterator[str]:
    """Yield a property of exactly the images whose rays are all correct."""
    firsts, right = [], []
    numbers = range(len(cases))
    for _, group in groupby(numbers, lambda number: (cases[number].camera, cases[number].size)):
        image = list(group)
        firsts.append(cases[image[0]])
        right.append(not wrong[image].any())
    if any(right):
        found = [place for place, is_there in PLACES.items() if [*map(is_there, firsts)] == right]
        if found:
            yield f"Your rays are correct {' and '.join(found)}, and wrong elsewhere."
