"""The mistakes, one or two at once, that reproduce the given numbers.

A mistake is named only if its line returns exactly the given numbers in every case. Mistakes must
match within float64 precision first, then within float32: an answer in float64 is never mistaken
for a mistake that is merely close to it. All that fit equally well are named.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.kinds.viewing_ray import largest_number
from lucida.app.checking.mistakes.program import Mistakes, Program
from lucida.app.checking.mistakes.programs import case_values, known_values
from lucida.app.checking.mistakes.rays import RayTask, ray_task, run_rays
from lucida.app.checking.tasks import CheckCase, CheckTask

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

# Errors relative to the largest intermediate result. After the usual twenty operations, they are
# well above those of float64 (2^-53) and of float32 (2^-24), respectively.
STRICT, LOOSE = 1e-11, 2.0**-18
FEW = 12  # cases that rule out most mistakes
EXACT = ("to-bitmap", "memory-offset")  # kinds whose answers must be equal


def candidates(program: Program, trial: Trial, wrong: NDArray[np.bool_]) -> tuple[Mistakes, ...]:
    """Return all single mistakes, or else all pairs, that explain all cases; () if there are none.

    wrong: the cases with wrong answers, (count,).
    """
    everything = np.arange(trial.count)
    few = np.array(sorted(_spread(np.flatnonzero(wrong)) | _spread(everything)))
    singles: list[Mistakes] = [(mistake,) for mistake in program.mistakes]
    loosely: tuple[Mistakes, ...] = ()
    for tried in (singles, list(program.pairs())):
        near = tried
        for cases in (few, everything):
            near = _chosen(near, _worst(program, trial, near, cases)[0] <= LOOSE)
        given, right = _worst(program, trial, near, everything)
        found = _chosen(near, (given <= STRICT) & (right > 4 * STRICT))
        if found:
            return tuple(found)
        loosely = loosely or tuple(_chosen(near, right > 4 * LOOSE))
    return loosely


def _spread(numbers: Numbers) -> set[int]:
    chosen = np.linspace(0, len(numbers) - 1, min(FEW, len(numbers))).astype(int)
    return set(numbers[chosen].tolist())


def _worst(
    program: Program, trial: Trial, tried: Sequence[Mistakes], cases: Numbers
) -> tuple[Floats, Floats]:
    """Return, for each tried mistake, the largest error of the given and of the correct answers."""
    if not tried:
        return np.zeros(0), np.zeros(0)
    given, right = trial.errors(program, tried, cases)
    return (
        np.where(np.isnan(given), np.inf, given).max(axis=1),
        np.where(np.isnan(right), np.inf, right).max(axis=1),
    )


def _chosen(tried: Sequence[Mistakes], flags: NDArray[np.bool_]) -> list[Mistakes]:
    return [one for one, is_chosen in zip(tried, flags, strict=True) if is_chosen]


def trial_of(
    task: CheckTask, projection: str, cases: Sequence[CheckCase], given: Sequence[Any]
) -> Trial:
    """Return the trial of given answers. projection: of all of the cases' cameras, if any."""
    if task.kind == "viewing-ray":
        return RayTrial(cases, np.asarray(given, float), ray_task(task, projection))
    return ValueTrial(task, cases, given)


class RayTrial:
    """Rays, given and correct, (N, 2, 3) each: the lines run for all cases at once."""

    def __init__(self, cases: Sequence[CheckCase], given: Floats, task: RayTask) -> None:
        self.count, self.given = len(cases), given
        self.right = np.array([case.right for case in cases], float)
        made, scale = [], []
        for case in cases:
            assert case.camera is not None and case.pixel is not None
            made.append(case_values(case, *case.pixel, task))
            scale.append(largest_number(case.camera))
        self.scale = np.array(scale)
        self.known = {
            name: np.array([np.atleast_1d(one[name]) for one in made], float) for name in made[0]
        }

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        """Return how far the given answers, and the correct ones, are from the program's with each
        of these mistakes.

        The errors are (tried, cases), relative to the largest intermediate result; inf or NaN where
        an answer is missing.
        """
        made = self.made(program, tried, cases)
        given = self.apart(self.given[cases], made, cases)
        return given, self.apart(self.right[cases], made, cases)

    def made(self, program: Program, tried: Sequence[Mistakes], cases: Numbers) -> Floats:
        """Return the rays with each of these mistakes, (tried, cases, 2, 3)."""
        known = {name: value[cases] for name, value in self.known.items()}
        return np.array([run_rays(program, known, one) for one in tried]).swapaxes(1, 2)

    def apart(self, rays: Floats, made: Floats, cases: Numbers) -> Floats:
        """Return the distance between rays, relative to the largest intermediate result: (...,
        cases).

        It is 0 if neither is finite: both divide by zero in the same place.
        """
        with np.errstate(all="ignore"):
            origins, directions = made[..., 0, :], made[..., 1, :]
            length = np.linalg.norm(directions, axis=-1)
            own = np.linalg.norm(rays[..., 1, :], axis=-1)
            scale = self.scale[cases] + np.linalg.norm(origins, axis=-1) + length
            along = directions / length[..., None]
            moved = rays[..., 0, :] - origins
            turned = np.linalg.norm(rays[..., 1, :] / own[..., None] - along, axis=-1) * length
            no_way = (own == 0) | (length == 0)
            turned = np.where(no_way, np.maximum(own, length), turned)
            apart = np.maximum(np.linalg.norm(moved, axis=-1), turned) / scale
        numbers = [np.isfinite(one).all(axis=(-2, -1)) for one in (rays, made)]
        return np.where(numbers[0] | numbers[1], apart, 0.0)


class ValueTrial:
    """Numbers or arrays: the lines run for one case after another."""

    def __init__(self, task: CheckTask, cases: Sequence[CheckCase], given: Sequence[Any]) -> None:
        self.count, self._cases, self._given = len(cases), cases, given
        self._known = [known_values(task, case) for case in cases]
        self._is_exact = task.kind in EXACT

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        """Return the errors of each mistake, up to the first case that it does not explain. Stop
        there, because running an image takes long.
        """
        given, right = np.full((2, len(tried), len(cases)), np.inf)
        for row, mistakes in enumerate(tried):
            for column, number in enumerate(cases):
                made = self._made(program, number, mistakes)
                if made is None:
                    break
                given[row, column] = self._apart(number, self._given[number], made)
                right[row, column] = self._apart(number, self._cases[number].right, made)
                if given[row, column] > LOOSE:
                    break
        return given, right

    def _made(self, program: Program, number: int, mistakes: Mistakes) -> Floats | None:
        """Return the program's answer in the shape of the correct one; None if the shapes do not
        match.
        """
        shape = np.shape(self._cases[number].right)
        (answer,) = program.run(self._known[number], mistakes)
        if isinstance(answer, tuple):
            answer = np.stack([np.asarray(part, float).reshape(-1) for part in answer])
        made = np.asarray(answer, float)
        return made.reshape(shape) if made.size == np.prod(shape, dtype=int) else None

    def _apart(self, number: int, answer: Any, made: Floats) -> float:
        """Return the distance between two answers, scaled so that LOOSE is the limit.

        The limit is the tolerance, or LOOSE of the largest number. Equal NaN and inf count as
        equal: both divide by zero in the same places.
        """
        case, found = self._cases[number], np.asarray(answer, float)
        judged = case.values.get("judged", ...)  # of an image: the pixels that count
        found, made = found[judged], made[judged]
        if self._is_exact:
            return 0.0 if np.array_equal(found, made, equal_nan=True) else np.inf
        finite = made[np.isfinite(made)]
        near = max(case.tolerance, LOOSE * float(np.abs(finite).max(initial=0.0)), 1e-300)
        with np.errstate(invalid="ignore"):
            same = (found == made) | (np.isnan(found) & np.isnan(made))
            apart = np.where(same, 0.0, np.abs(found - made) / near * LOOSE)
        return float(apart.max(initial=0.0))


Trial = RayTrial | ValueTrial
