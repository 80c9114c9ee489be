"""The last values of a function, for what is drawn or found in each frame."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar, TypeVarTuple

import numpy as np

Parts = TypeVarTuple("Parts")
T = TypeVar("T")


class Memo(Generic[*Parts, T]):
    """A function that is called again only if one of its arguments has changed.

    function: must read nothing but its arguments, so that the key cannot lack an input. It may have
    an effect, such as drawing, on one of them. Bound methods and closures are refused.
    most: how many values are kept; those asked for last. More than one only if there is no
    such effect: what is drawn for one key may be drawn over for the next.
    count: how often the function was called.

    Arguments are compared by same(), and must not be changed afterwards. What can be, such as a
    texture that is drawn over, needs another argument that says what it holds.
    """

    def __init__(self, function: Callable[[*Parts], T], most: int = 1) -> None:
        hidden = "__self__", "__closure__"
        if any(getattr(function, name, None) is not None for name in hidden):
            raise TypeError(f"{function} may read more than its arguments")
        self._function, self.most, self.count = function, most, 0
        self._known: list[tuple[tuple[*Parts], T]] = []

    def __call__(self, *key: *Parts) -> T:
        for number, (known, _) in enumerate(self._known):
            if same(known, key):
                self._known.append(self._known.pop(number))
                return self._known[-1][1]
        # First, so that its memory is free, and a call that fails leaves no stale value.
        del self._known[: max(0, len(self._known) + 1 - self.most)]
        self.count += 1
        value = self._function(*key)
        self._known.append((key, value))
        return value

    def forget(self) -> None:
        """Drop all values: the next call computes."""
        self._known.clear()


def same(one: Any, other: Any) -> bool:
    """Return whether two arguments are the same: one object, or of one type and equal.

    Arrays are the same only if they are one object. Tuples are compared part by part.
    """
    if one is other:
        return True
    if type(one) is not type(other) or isinstance(one, np.ndarray):
        return False
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other)
