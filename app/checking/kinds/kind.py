"""A kind of function: it generates cases, calls the function, reads its answers and judges them.

Return values are JSON values, parsed leniently. None means that a value is not of that type.
Infinite and NaN numbers are numbers here; the caller decides about them.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.tasks import Call, CheckCase, CheckTask
from lucida.app.checking.words import Words

SHOWN = 80  # characters of a value in a message
DEPTH = 8  # of nested lists that are displayed


def number(value: Any) -> float | None:
    """Return a number. Accept a list of one number, because arrays of one element become lists."""
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def vector(value: Any) -> tuple[float, float, float] | None:
    """Return three numbers from a list, a row or column of a matrix, or fields x, y and z. A fourth
    number that is 0 or 1 is a homogeneous coordinate.
    """
    if isinstance(value, dict):
        value = [value.get(name) for name in ("x", "y", "z")]
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if not isinstance(value, list) or len(value) not in (3, 4):
        return None
    numbers = [number(part) for part in value]
    if len(numbers) == 4 and numbers.pop() not in (0.0, 1.0):
        return None
    x, y, z = numbers
    return None if x is None or y is None or z is None else (x, y, z)


def vectors(value: Any, names: Sequence[str]) -> list[tuple[float, float, float]] | None:
    """Return a vector for each name, read from a list in this order, by name, or from a flat list
    of numbers.
    """
    value = in_order(value, names)
    if isinstance(value, list) and len(value) == 3 * len(names) != 3:
        value = [value[k : k + 3] for k in range(0, len(value), 3)]
    elif len(names) == 1 and vector(value) is not None:
        value = [value]
    if not isinstance(value, list) or len(value) != len(names):
        return None
    found = [vector(part) for part in value]
    read = [part for part in found if part is not None]
    return read if len(read) == len(names) else None


def in_order(value: Any, names: Sequence[str]) -> Any:
    """Return an answer with named parts as a list in the order of the names. Return any other value
    unchanged.
    """
    if isinstance(value, dict) and all(name in value for name in names):
        return [value[name] for name in names]
    return value


def is_miss(value: Any) -> bool:
    """Return True if the value means a miss: None, False, inf, nan, or a list of only these.

    Minus infinity is not a miss: it is nearer than every hit.
    """
    if isinstance(value, list) and len(value) <= 2:
        return all(not isinstance(part, list) and is_miss(part) for part in value)
    if value is None or value is False:
        return True
    found = number(value)
    return found is not None and not math.isfinite(found) and found != -math.inf


def array(value: Any) -> NDArray[np.float64] | None:
    """Return a list of numbers as an array; None for anything else."""
    if not isinstance(value, list):
        return None
    try:
        made = np.array(value)
    except (ValueError, OverflowError):
        return None
    return made.astype(float) if made.dtype.kind in "biuf" else None


def shown(value: Any) -> str:
    """Format a returned value for a message: shorten it, or show only an array's shape."""
    text = text_of(value)
    if len(text) <= SHOWN:
        return text
    made = array(value)
    return f"{text[: SHOWN - 3]}..." if made is None else f"an array of shape {made.shape}"


def text_of(value: Any, depth: int = DEPTH) -> str:
    """Format a value as in Python, with six-digit numbers: (1, 0.5, -2)."""
    if depth == 0:
        return "..."
    match value:
        case bool() | None | str():
            return repr(value)
        case int() | float():
            return f"{value + 0.0:.6g}" if isinstance(value, float) else str(value)
        case list() | tuple():
            return "(" + ", ".join(text_of(part, depth - 1) for part in value) + ")"
        case dict():
            return (
                "{"
                + ", ".join(f"{name}: {text_of(part, depth - 1)}" for name, part in value.items())
                + "}"
            )
    return repr(value)


Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

# The rounding error allowed for a correct float32 answer is 64 times 2^-24, relative to the largest
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
        return [Call(task.function, case.arguments, task.notation) for case in cases]

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
