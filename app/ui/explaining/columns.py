"""A list of numbers that one thread appends to while others read it.

Reading takes no lock, because appended numbers never change.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray


class Column:
    """Numbers, or rows of `width` numbers."""

    def __init__(self, dtype: DTypeLike, width: int = 0) -> None:
        self._rows: NDArray[Any] = np.empty((1024, width) if width else 1024, dtype)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: int) -> Any:
        return self._rows[index]

    def append(self, value: Any) -> None:
        if self._count == len(self._rows):
            # A new array: readers of the old one are not disturbed.
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
        self._rows[self._count] = value
        self._count += 1

    def upto(self, count: int) -> NDArray[Any]:
        """Return the first `count`."""
        return self._rows[:count]

    def count_upto(self, value: int) -> int:
        """Return the number of sorted values that are at most `value`."""
        return int(np.searchsorted(self._rows[: self._count], value, side="right"))
