"""A cache of a function's last values, for anything that is drawn or computed in each frame."""

from __future__ import annotations

from collections.abc import Callable
from operator import is_
from typing import Any, Generic, TypeVar, TypeVarTuple

import numpy as np

Parts = TypeVarTuple("Parts")
T = TypeVar("T")


class Memo(Generic[*Parts, T]):
    """A function that is called again only if one of its arguments has changed.

    function: must read nothing but its arguments, so that the key cannot lack an input. It may have
    an effect, such as drawing, on one of them. Bound methods and closures are rejected. most: the
    number of values to keep, the most recently used. It may exceed 1 only if there is no such
    effect:
    drawing for one key may overwrite the drawing for another. count: the number of calls of the
    function.

    Arguments are compared by same(), and must not be changed afterwards. A mutable one, such as a
    texture that is drawn over, needs another argument that identifies its content.
    """

    def __init__(self, function: Callable[[*Parts], T], most: int = 1) -> None:
        hidden = "__self__", "__closure__"
        if any(getattr(function, name, None) is not None for name in hidden):
            raise TypeError(f"{function} may read more than its arguments")
        self._function, self.most, self.count = function, most, 0
        self._known: list[tuple[tuple[*Parts], T]] = []

    def __call__(self, *key: *Parts) -> T:
        for number, (known, _) in enumerate(self._known):
            if all(map(is_, known, key)) or same(known, key):
                self._known.append(self._known.pop(number))
                return self._known[-1][1]
        # Delete first, to free the memory, and so that a failing call leaves no stale value.
        del self._known[: max(0, len(self._known) + 1 - self.most)]
        self.count += 1
        value = self._function(*key)
        self._known.append((key, value))
        return value

    def forget(self) -> None:
        """Drop all values, so that the next call computes."""
        self._known.clear()


def same(one: Any, other: Any) -> bool:
    """Return True if two arguments are the same: one object, or of one type and equal.

    Arrays are the same only if they are one object. Tuples are compared part by part.
    """
    if one is other:
        return True
    if type(one) is not type(other) or isinstance(one, np.ndarray):
        return False
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other)
