"""Which wrong lines give the numbers that came back: one, or two at once.

A name is told only where the numbers are those that its line gives, in every case. First within
what is left of float64, then within float32: an answer in float64 is never taken for a mistake
that only comes near. All that fit alike are named.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.program import Mistakes, Program

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

# Errors relative to the largest number on the way: far from 2^-53, and from 2^-24, after the usual
# twenty operations; and between the two.
STRICT, LOOSE = 1e-11, 2.0**-18
FEW = 12  # cases by which most mistakes are ruled out


class Trial(Protocol):
    """The cases, and how far answers are from those that were given."""

    @property
    def count(self) -> int:
        """The number of cases."""

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        """How far the given answers, and the right ones, are from those of the program with each
        of these mistakes: relative to the largest number on the way, (tried, cases); inf or NaN
        where there is none."""


def candidates(program: Program, trial: Trial, wrong: NDArray[np.bool_]) -> tuple[Mistakes, ...]:
    """All mistakes, else all pairs of mistakes, that explain all cases; () where none does.
    wrong: which cases are answered wrongly, (count,)."""
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
    """The largest errors of the given answers and of the right ones, of each that is tried."""
    if not tried:
        return np.zeros(0), np.zeros(0)
    given, right = trial.errors(program, tried, cases)
    return (
        np.where(np.isnan(given), np.inf, given).max(axis=1),
        np.where(np.isnan(right), np.inf, right).max(axis=1),
    )


def _chosen(tried: Sequence[Mistakes], flags: NDArray[np.bool_]) -> list[Mistakes]:
    return [one for one, is_chosen in zip(tried, flags, strict=True) if is_chosen]
