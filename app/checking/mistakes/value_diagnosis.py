"""The explanation of wrong answers that are numbers or arrays: bases, hits, images, offsets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.mistakes.candidates import LOOSE
from lucida.app.checking.mistakes.diagnosis import Diagnosis, named
from lucida.app.checking.mistakes.program import Mistakes, Program

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ValueCase:
    """A case with its answers.

    known: the values that the program's lines use, by name: numbers, vectors (3,), arrays.
    right, given: the answers as arrays of the same shape; given may be None.
    tolerance: of the correct answer; None if it must be exact.
    judged: the parts of the answer that count; None for all.
    """

    known: Mapping[str, Any]
    right: Any
    given: Any
    tolerance: float | None = 0.0
    judged: NDArray[np.bool_] | None = None


class ValueTrial:
    def __init__(self, cases: Sequence[ValueCase]) -> None:
        self.cases = cases
        self.count = len(cases)

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        """Return the errors of each mistake, up to the first case that it does not explain. Stop
        there, because running an image takes long.
        """
        given, right = np.full((2, len(tried), len(cases)), np.inf)
        for row, mistakes in enumerate(tried):
            for column, number in enumerate(cases):
                case = self.cases[number]
                made = _made(program, case, mistakes)
                given[row, column] = _apart(case, case.given, made)
                right[row, column] = _apart(case, case.right, made)
                if given[row, column] > LOOSE:
                    break
        return given, right


def _made(program: Program, case: ValueCase, mistakes: Mistakes) -> Floats | None:
    """Return the program's answer in the shape of the correct one; None if the shapes do not
    match.
    """
    shape = np.shape(case.right)
    (answer,) = program.run(case.known, mistakes)
    if isinstance(answer, tuple):
        answer = np.stack([np.asarray(part, float).reshape(-1) for part in answer])
    made = np.asarray(answer, float)
    return made.reshape(shape) if made.size == np.prod(shape, dtype=int) else None


def _apart(case: ValueCase, answer: Any, made: Floats | None) -> float:
    """Return the distance between two answers, scaled so that LOOSE is the limit.

    The limit is the tolerance, or LOOSE of the largest number. Equal NaN and inf count as equal:
    both divide by zero in the same places.
    """
    if answer is None or made is None:
        return np.inf
    found = np.asarray(answer, float)
    if found.shape != made.shape:
        return np.inf
    if case.judged is not None:
        found, made = found[case.judged], made[case.judged]
    if case.tolerance is None:
        return 0.0 if np.array_equal(found, made, equal_nan=True) else np.inf
    finite = made[np.isfinite(made)]
    near = max(case.tolerance, LOOSE * float(np.abs(finite).max(initial=0.0)), 1e-300)
    with np.errstate(invalid="ignore"):
        same = (found == made) | (np.isnan(found) & np.isnan(made))
        apart = np.where(same, 0.0, np.abs(found - made) / near * LOOSE)
    return float(apart.max(initial=0.0))


def diagnose_values(
    program: Program, cases: Sequence[ValueCase], wrong: ArrayLike
) -> Diagnosis | None:
    """Return the diagnosis of the given answers; None if none is wrong. wrong: the wrong ones."""
    return diagnose_by_kind({"": program}, ["" for _ in cases], cases, wrong)


def diagnose_by_kind(
    programs: Mapping[str, Program],
    kinds: Sequence[str],
    cases: Sequence[ValueCase],
    wrong: ArrayLike,
) -> Diagnosis | None:
    """Diagnose cases of several kinds, each with its own program. For images, the kind is the
    projection.
    """
    flags = np.asarray(wrong, bool)
    if not flags.any():
        return None
    constant = _constant(cases)
    if constant:
        return Diagnosis((constant,))

    def program_and_trial(kind: str, chosen: list[int]) -> tuple[Program, ValueTrial]:
        return programs[kind], ValueTrial([cases[number] for number in chosen])

    sentences, found, _ = named(kinds, flags, program_and_trial)
    return Diagnosis(tuple(sentences), found)


def _constant(cases: Sequence[ValueCase]) -> str:
    """Return a sentence if all answers are the same number; empty otherwise."""
    answers = [np.ravel(np.asarray(case.given, float)) for case in cases if case.given is not None]
    numbers = np.concatenate(answers) if answers else np.zeros(0)
    if len(cases) < 3 or len(answers) < len(cases) or not (numbers == numbers[0]).all():
        return ""
    if np.isinf(numbers[0]) and any(np.isinf(case.right).any() for case in cases):
        return "You never find a hit."
    return f"All your answers are {numbers[0]:.4g}, whatever is asked."
