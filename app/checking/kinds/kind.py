"""The base class of all kinds of functions: generate cases, call, read answers and judge them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.calls import Call
from lucida.app.checking.kinds.values import shown, vectors
from lucida.app.checking.tasks import CheckCase, CheckTask

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Rounding error allowed for a correct float32 answer: 64 times 2^-24, relative to the largest
# number that it is computed from. The longest usual computations take about twenty operations; the
# inputs are rounded too, and a matrix is inverted.
FLOAT32 = 2.0**-18


Cases = Sequence[CheckCase]
Read = tuple[Any, dict[int, str]]  # the answers, and a message for each malformed one, by number


class CheckKind(ABC):
    """A kind of function.

    words: the possible arguments, with their meanings.
    arguments: the default words, in order.
    returns: the words of the returned parts, if there are several.
    answer: the description of a well-formed answer.
    """

    name: ClassVar[str]
    function: ClassVar[str]
    words: ClassVar[Mapping[str, str]]
    arguments: ClassVar[tuple[str, ...]]
    returns: ClassVar[tuple[str, ...]] = ()
    return_words: ClassVar[Mapping[str, str]] = {}
    answer: ClassVar[str]

    @abstractmethod
    def cases(self, task: CheckTask) -> list[CheckCase]:
        """Return all cases of a task, the simplest first. The same task always has the same
        cases.
        """

    def calls(self, task: CheckTask, cases: Cases) -> list[Call]:
        """Return the calls whose values answer the cases."""
        return [Call(task.function, case.arguments, notation=task.notation) for case in cases]

    def read(self, task: CheckTask, value: Any) -> Any:
        """Return one answer as numbers; None if it is malformed. The default reads a vector for
        each returned part.
        """
        return vectors(value, task.conventions.returns)

    def shape(self, task: CheckTask) -> tuple[int, ...]:
        """Return the shape of one answer as numbers."""
        return len(task.conventions.returns), 3

    def wanted(self, task: CheckTask) -> str:
        return self.answer

    def given(self, task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
        """Return the answers in the same form as `right`, and the messages. Malformed and missing
        answers are NaN.
        """
        read = [self.read(task, value) for value in values]
        found = np.full((len(cases), *self.shape(task)), np.nan)
        problems: dict[int, str] = {}
        for number, (value, answer) in enumerate(zip(values, read, strict=True)):
            if answer is None:
                problems[number] = f"returned {shown(value)}, not {self.wanted(task)}"
            else:
                found[number] = answer
        return found, problems

    def right(self, cases: Cases) -> Any:
        """Return the correct answers to all cases together, in the kind's own form."""
        return np.array([case.right for case in cases], float)

    @abstractmethod
    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        """Return the cases with wrong answers, bool (N,)."""

    @abstractmethod
    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        """Return an answer in the kind's own form as the student would write it."""

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Return the place of a wrong case, the correct answer and the given one. The place is
        empty if the arguments are enough to find it.
        """
        right = self.answer_text(task, case, case.right)
        return "", right, self.answer_text(task, case, answer)


def tolerances(cases: Cases) -> Floats:
    return np.array([case.tolerance for case in cases], float)


def named(task: CheckTask, values: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """Return the arguments of a call, from the values of the words."""
    return tuple((name, values[word]) for name, word in task.conventions.arguments)
