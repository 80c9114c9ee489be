"""A kind of function: it generates cases, calls the function, reads its answers and judges them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.calls import Call
from lucida.app.checking.kinds.values import shown, text_of
from lucida.app.checking.tasks import CheckCase, CheckTask

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Words = Mapping[str, str]

# Rounding error allowed for a correct float32 answer: 64 times 2^-24, relative to the largest
# number that it is computed from. The longest usual computations take about twenty operations; the
# inputs are rounded too, and a matrix is inverted.
FLOAT32 = 2.0**-18

Cases = Sequence[CheckCase]


@dataclass(frozen=True, kw_only=True)
class CheckKind(ABC):
    """A kind of function.

    words: the possible arguments, with their meanings.
    arguments: the default words, in order.
    answer: the description of a well-formed answer.
    returns: the words of the returned parts, if there are several.
    """

    name: str
    function: str
    words: Words
    arguments: tuple[str, ...]
    answer: str
    returns: tuple[str, ...] = ()
    return_words: Words = field(default_factory=dict)

    @abstractmethod
    def cases(self, task: CheckTask) -> list[CheckCase]:
        """Return all cases of a task, the simplest first. The same task always has the same
        cases.
        """

    def calls(self, task: CheckTask, cases: Cases) -> list[Call]:
        """Return the calls whose values answer the cases."""
        return [Call(task.function, case.arguments, notation=task.notation) for case in cases]

    @abstractmethod
    def read(self, task: CheckTask, case: CheckCase, value: Any) -> ArrayLike | None:
        """Return an answer in the form of case.right; None if it is malformed."""

    def wanted(self, task: CheckTask, case: CheckCase) -> str:
        return self.answer

    def given(
        self, task: CheckTask, cases: Cases, values: Sequence[Any]
    ) -> tuple[list[Floats], dict[int, str]]:
        """Return the answers in the form of the correct ones, and a message for each malformed one
        by its number. Malformed and missing answers are NaN.
        """
        given = [np.full(np.shape(case.right), np.nan) for case in cases]
        problems: dict[int, str] = {}
        for number, (case, value) in enumerate(zip(cases, values, strict=False)):
            answer = self.read(task, case, value)
            if answer is None:
                problems[number] = f"returned {shown(value)}, not {self.wanted(task, case)}"
            else:
                given[number] = np.asarray(answer, float)
        return given, problems

    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        """Return the cases with wrong answers, bool (N,)."""
        pairs = zip(cases, given, strict=True)
        return np.array([wrong_numbers(case, answer).any() for case, answer in pairs], bool)

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Floats) -> str:
        """Return an answer as the student would write it."""
        parts = self.parts(task, case, answer)
        return ", ".join(f"{name} {text_of(parts[name])}" for name in task.conventions.returns)

    def parts(self, task: CheckTask, case: CheckCase, answer: Floats) -> dict[str, Any]:
        """Return the parts of an answer by their words."""
        return dict(zip(self.returns, np.asarray(answer).tolist(), strict=True))

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Return the place of a wrong case, the correct answer and the given one. The place is
        empty if the arguments are enough to find it.
        """
        right = self.answer_text(task, case, case.right)
        return "", right, self.answer_text(task, case, answer)


def wrong_numbers(case: CheckCase, answer: Floats) -> Flags:
    """Return the numbers of an answer that are wrong. Those of a miss are infinite."""
    right = np.asarray(case.right)
    with np.errstate(invalid="ignore"):
        return np.asarray(~((answer == right) | (np.abs(answer - right) <= case.tolerance)))


def named(task: CheckTask, values: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """Return the arguments of a call, from the values of the words."""
    return tuple((name, values[word]) for name, word in task.conventions.arguments)
