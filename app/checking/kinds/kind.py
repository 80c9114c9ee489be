"""What all kinds of functions have: how their cases are made, called, read and judged."""

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

# Rounding errors that a right answer in float32 may have: 64 of 2^-24, each relative to the largest
# number that it is computed from. The longest usual ways take about twenty operations; the inputs
# are rounded too, and a matrix is inverted.
FLOAT32 = 2.0**-18


class CheckKind(ABC):
    """A kind of function. words: what its arguments can be, with their meanings. arguments: the
    words by default, in their order. returns: the words of what comes back, where it has parts."""

    name: ClassVar[str]
    function: ClassVar[str]
    words: ClassVar[Mapping[str, str]]
    arguments: ClassVar[tuple[str, ...]]
    returns: ClassVar[tuple[str, ...]] = ()
    return_words: ClassVar[Mapping[str, str]] = {}
    answer: ClassVar[str]

    @abstractmethod
    def cases(self, task: CheckTask) -> list[CheckCase]:
        """All cases of a task, the simplest first; the same for the same task."""

    def calls(self, task: CheckTask, cases: Sequence[CheckCase]) -> list[Call]:
        """The calls whose values answer the cases."""
        return [Call(task.function, case.arguments) for case in cases]

    @abstractmethod
    def given(
        self, task: CheckTask, cases: Sequence[CheckCase], values: Sequence[Any]
    ) -> tuple[Any, dict[int, str]]:
        """The answers in the kind's own form, as `right`; and what is wrong with the form of
        those that are none, by the number of the case."""

    def right(self, cases: Sequence[CheckCase]) -> Any:
        """The right answers in the kind's own form, of all cases together."""
        return np.array([case.right for case in cases], float)

    @abstractmethod
    def wrong(self, task: CheckTask, cases: Sequence[CheckCase], given: Any) -> Flags:
        """Which of the cases are answered wrongly, bool (N,)."""

    @abstractmethod
    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        """An answer in the kind's own form, as the student would write it."""

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Where a wrong case is, beside its arguments, or empty where they say it all; the right
        answer and the one given."""
        right = self.answer_text(task, case, case.right)
        return "", right, self.answer_text(task, case, answer)


def named(task: CheckTask, values: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """The arguments of a call, from the values of the words."""
    return tuple((name, values[word]) for name, word in task.conventions.arguments)


def each(
    values: Sequence[Any],
    read: Callable[[Any], Any],
    shape: tuple[int, ...],
    wanted: str,
    count: int,
) -> tuple[Floats, dict[int, str]]:
    """What `read` makes of each value, (count, *shape): NaN with a message where that is None, and
    NaN where there are fewer values."""
    found = np.full((count, *shape), np.nan)
    problems: dict[int, str] = {}
    for number, value in enumerate(values):
        answer = read(value)
        if answer is None:
            problems[number] = f"returned {shown(value)}, not {wanted}"
        else:
            found[number] = answer
    return found, problems
