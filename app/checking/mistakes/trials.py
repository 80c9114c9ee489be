"""The mistakes, one or two at once, that reproduce the given numbers.

A mistake is reported only if its line returns exactly the given numbers in every case. Mistakes
must match within float64 precision first, then within float32: an answer in float64 is never
mistaken for a mistake that is merely close to it. All equally good matches are reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.kinds.viewing_ray import largest_number
from lucida.app.checking.tasks import CheckCase, CheckTask

from .program import Mistakes, Program
from .programs import case_values, known_values
from .rays import ray_task

Floats = NDArray[np.float64]
Errors = tuple[float, float]  # of the given answers, and of the correct ones

# Errors relative to the largest intermediate result. After the usual twenty operations, they are
# well above those of float64 (2^-53) and of float32 (2^-24), respectively.
STRICT, LOOSE = 1e-11, 2.0**-18
FEW = 24  # rays that rule out most mistakes
NOTHING_ALIKE = np.inf, np.inf


def candidates(program: Program, trials: Sequence[Trial]) -> tuple[Mistakes, ...]:
    """Return all single mistakes, or else all pairs, that explain all trials; () if there are
    none.
    """
    loosely: tuple[Mistakes, ...] = ()
    for tried in ([(mistake,) for mistake in program.mistakes], program.pairs()):
        errors = {one: _worst(program, one, trials) for one in tried}
        exactly = tuple(
            one for one, (given, right) in errors.items() if given <= STRICT and right > 4 * STRICT
        )
        if exactly:
            return exactly
        loosely = loosely or tuple(
            one for one, (given, right) in errors.items() if given <= LOOSE and right > 4 * LOOSE
        )
    return loosely


def _worst(program: Program, mistakes: Mistakes, trials: Sequence[Trial]) -> Errors:
    """Return the largest errors of a program with these mistakes, up to the first trial that they
    do not explain.
    """
    worst = 0.0, 0.0
    for trial in trials:
        given, right = trial.errors(program, mistakes)
        worst = max(worst[0], given), max(worst[1], right)
        if given > LOOSE:
            break
    return worst


def trials_of(
    task: CheckTask, cases: Sequence[CheckCase], given: Sequence[Any]
) -> list[RayTrial] | list[ValueTrial]:
    """Return the trials of given answers. The first ones should rule out most mistakes."""
    if task.kind != "viewing-ray":
        return [ValueTrial(task, *one) for one in zip(cases, given, strict=True)]
    every = -(-len(cases) // FEW)
    return [RayTrial(task, cases[::step], given[::step]) for step in (every, 1)]


class RayTrial:
    """Given and correct rays. The lines run for all cases at once."""

    def __init__(self, task: CheckTask, cases: Sequence[CheckCase], given: Sequence[Any]) -> None:
        answers = np.array([given, [case.right for case in cases]], float)  # (2, N, 2, 3)
        made, scale, its = [], [], ray_task(task)
        for case in cases:
            assert case.camera is not None and case.pixel is not None
            made.append(case_values(case, *case.pixel, its))
            scale.append(largest_number(case.camera))
        self._scale = np.array(scale)
        self._known = {  # shapes (N, 1), (N, 3), (N, 4, 4)
            name: np.atleast_2d(np.array([one[name] for one in made], float).T).T
            for name in made[0]
        }
        self._finite = np.isfinite(answers).all(axis=(-2, -1))
        self._origins, directions = answers[..., 0, :], answers[..., 1, :]
        with np.errstate(all="ignore"):
            self._own = _lengths(directions)
            self._along = directions / self._own[..., None]

    def errors(self, program: Program, mistakes: Mistakes) -> Errors:
        """Return the distances of the given and of the correct rays from the program's, relative to
        the largest intermediate result.

        The error is 0 if neither is finite, because both divide by zero in the same place, as does
        a student who normalises a direction of length 0.
        """
        origins, directions = program.run(self._known, mistakes)
        with np.errstate(all="ignore"):
            length = _lengths(directions)
            turned = _lengths(self._along - directions / length[..., None]) * length
            no_length = (self._own == 0) | (length == 0)
            error = np.where(no_length, np.maximum(self._own, length), turned)
            error = np.maximum(_lengths(self._origins - origins), error)
            error /= self._scale + _lengths(origins) + length
        is_made = np.isfinite(origins).all(axis=-1) & np.isfinite(length) & (length > 0)
        error[np.isnan(error)] = np.inf
        error[~(self._finite | is_made)] = 0.0
        given, right = error.max(axis=1).tolist()
        return given, right


def _lengths(vectors: Floats) -> Floats:
    return np.sqrt(np.vecdot(vectors, vectors))


class ValueTrial:
    """A number or an array."""

    def __init__(self, task: CheckTask, case: CheckCase, given: Any) -> None:
        self._answers = np.asarray(given, float), np.asarray(case.right, float)
        self._known = known_values(task, case)
        self._judged = case.values.get("judged", ...)  # an image's pixels that count
        self._tolerance = max(case.tolerance, 1e-300)

    def errors(self, program: Program, mistakes: Mistakes) -> Errors:
        """Return the distances of the given and of the correct answer from the program's, scaled so
        that LOOSE is the limit.
        """
        (answer,) = program.run(self._known, mistakes)
        if isinstance(answer, tuple):
            answer = np.stack([np.asarray(part, float).reshape(-1) for part in answer])
        made, shape = np.asarray(answer, float), self._answers[1].shape
        if made.size != self._answers[1].size:
            return NOTHING_ALIKE
        made = made.reshape(shape)[self._judged]
        given, right = (self._apart(one[self._judged], made) for one in self._answers)
        return given, right

    def _apart(self, answer: Floats, made: Floats) -> float:
        """Return the distance. The limit is the tolerance, or LOOSE of the largest number. Matching
        NaN and inf count as equal, because both divide by zero in the same places.
        """
        largest = float(np.abs(made[np.isfinite(made)]).max(initial=0.0))
        with np.errstate(invalid="ignore"):
            same = (answer == made) | (np.isnan(answer) & np.isnan(made))
            apart = np.abs(answer - made) / max(self._tolerance, LOOSE * largest) * LOOSE
        apart = np.where(same, 0.0, np.where(np.isnan(apart), np.inf, apart))
        return float(apart.max(initial=0.0))


Trial = RayTrial | ValueTrial
