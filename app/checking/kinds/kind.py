"""The base class of all kinds of functions: generate cases, call, read answers and judge them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from app.checking.calls import Call
from app.checking.kinds.values import shown
from app.checking.tasks import CheckCase, CheckTask

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Rounding error allowed for a correct float32 answer: 64 times 2^-24, relative to the largest
# number that it is computed from. The longest usual computations take about twenty operations; the
# inputs are rounded too, and a matrix is inverted.
FLOAT32 = 2.0**-18


class CheckKind(ABC):
    """A kind of function.

    words: the possible arguments, with their meanings.
    arguments: the default words, in order.
    returns: the words of the returned parts, if there are several.
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

    def calls(self, task: CheckTask, cases: Sequence[CheckCase]) -> list[Call]:
        """Return the calls whose values answer the cases."""
        return [Call(task.function, case.arguments) for case in cases]

    @abstractmethod
    def given(
        self, task: CheckTask, cases: Sequence[CheckCase], values: Sequence[Any]
    ) -> tuple[Any, dict[int, str]]:
        """Return the answers in the same form as `right`, and a message for each malformed one, by
        the number of its case.
        """

    def right(self, cases: Sequence[CheckCase]) -> Any:
        """Return the correct answers to all cases together, in the kind's own form."""
        return np.array([case.right for case in cases], float)

    @abstractmethod
    def wrong(self, task: CheckTask, cases: Sequence[CheckCase], given: Any) -> Flags:
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


def named(task: CheckTask, values: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """Return the arguments of a call, from the values of the words."""
    return tuple((name, values[word]) for name, word in task.conventions.arguments)


def each(
    values: Sequence[Any],
    read: Callable[[Any], Any],
    shape: tuple[int, ...],
    wanted: str,
    count: int,
) -> tuple[Floats, dict[int, str]]:
    """Apply `read` to each value.

    Return an array (count, *shape) and messages by number. It is NaN, with a message, where `read`
    returns None, and NaN where values are missing.
    """
    found = np.full((count, *shape), np.nan)
    problems: dict[int, str] = {}
    for number, value in enumerate(values):
        answer = read(value)
        if answer is None:
            problems[number] = f"returned {shown(value)}, not {wanted}"
        else:
            found[number] = answer
    return found, problems
