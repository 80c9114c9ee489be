"""The mistakes, one or two at once, that reproduce the given numbers.

A mistake is named only if its line returns exactly the given numbers in every case. Mistakes must
match within float64 precision first, then within float32: an answer in float64 is never mistaken
for a mistake that is merely close to it. All that fit equally well are named.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.mistakes.program import Mistakes, Program

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

# Errors relative to the largest intermediate result. After the usual twenty operations, they are
# well above those of float64 (2^-53) and of float32 (2^-24), respectively.
STRICT, LOOSE = 1e-11, 2.0**-18
FEW = 12  # cases that rule out most mistakes


class Trial(Protocol):
    """The cases, and the distances between programs' answers and the given ones."""

    @property
    def count(self) -> int:
        """The number of cases."""

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        """Return how far the given answers, and the correct ones, are from the program's with each
        of these mistakes.

        The errors are (tried, cases), relative to the largest intermediate result; inf or NaN where
        an answer is missing.
        """


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
