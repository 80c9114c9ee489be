"""Reading a large image back from the GPU, a part per frame.

Reading waits for the GPU, and copies: 4096 x 2160 pixels of all channels take longer than a frame
may.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from renderer.frame import CHANNELS, Frame

PART_PIXELS = 1 << 16
PART_S = 0.004  # what a frame has for it, at least one part

Region = tuple[int, int, int, int]  # first row and column, one past the last of each
Read = Callable[[tuple[str, ...], Region], Mapping[str, NDArray]]


class Readback:
    """The reading of one image. of: identifies it. size: (width, height)."""

    def __init__(self, of: object, size: tuple[int, int], read: Read) -> None:
        self.of = of
        self._size = size
        self._read = read
        self._row = 0
        self._arrays: dict[str, NDArray] = {}

    def go_on(self, in_parts: bool = True) -> Frame | None:
        """Read the next rows, as many as a frame has time for, or all. Return the frame once it is
        complete.
        """
        until_s = time.perf_counter() + PART_S if in_parts else math.inf
        while self._row < self._size[1]:
            self._read_part()
            if time.perf_counter() > until_s:
                break
        if self._row < self._size[1]:
            return None
        arrays: dict[str, Any] = self._arrays
        return Frame(size=self._size, **arrays)

    def _read_part(self) -> None:
        width, height = self._size
        last = min(self._row + max(1, PART_PIXELS // width), height)
        for name, values in self._read(CHANNELS, (self._row, 0, last, width)).items():
            if name not in self._arrays:
                self._arrays[name] = np.empty((height, *values.shape[1:]), values.dtype)
            self._arrays[name][self._row : last] = values
        self._row = last
