"""Memory for images, reused as soon as nothing refers to it.

Blocks are kept between two images. A live image has 10 to 100 MB. The system provides fresh memory
page by page, with thousands of page faults that can take as long as the tracing. All channels of an
image therefore share one block, which returns here when the last array in it is freed.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

KEPT = 3  # idle blocks; the one that has been idle longest is dropped first
LARGEST_KEPT_BYTES = 1 << 27  # 2560x1440 pixels of all channels
_LINE_BYTES = 64
# Stagger arrays within pages, because a pixel's numbers would compete for the same cache set.
_STAGGER_BYTES = _LINE_BYTES

Block = NDArray[np.uint8]


class Buffers:
    """A user's idle blocks. Any thread may take arrays, and free them."""

    def __init__(self) -> None:
        # A deque's operations are atomic, so _Lease.__del__, which may interrupt any thread
        # anywhere, needs no lock.
        self.idle: deque[Block] = deque(maxlen=KEPT)

    def arrays(self, layouts: Iterable[tuple[tuple[int, ...], DTypeLike]]) -> list[NDArray]:
        """Return an array of each (shape, dtype), writable and uninitialised. Raises
        MemoryError.
        """
        parts = [(shape, np.dtype(dtype)) for shape, dtype in layouts]
        sizes = [math.prod(shape) * dtype.itemsize for shape, dtype in parts]
        begins = [0]
        for size in sizes:
            begins.append(begins[-1] + -(-size // _LINE_BYTES) * _LINE_BYTES + _STAGGER_BYTES)
        lease = _Lease(self._block(begins[-1] + _LINE_BYTES), self.idle)
        # Every view of `whole`, and every view of a view, keeps it alive; it keeps the lease alive.
        whole = np.asarray(lease)
        first = -lease.address % _LINE_BYTES
        return [
            np.ndarray(shape, dtype, whole, first + begin)
            for begin, (shape, dtype) in zip(begins[:-1], parts, strict=True)
        ]

    def _block(self, size: int) -> Block:
        """Return an idle block of that size, or a new one. The most recently used block comes
        first, because most of it is still cached.
        """
        for _ in range(KEPT):
            try:
                block = self.idle.pop()
            except IndexError:
                break
            if block.nbytes == size:
                return block
            self.idle.appendleft(block)
        return np.empty(size, np.uint8)


class _Lease:
    """A block in use. NumPy treats it as an array, and keeps it alive as the owner of the
    memory.
    """

    def __init__(self, block: Block, idle: deque[Block]) -> None:
        self._block, self._idle = block, idle
        self.__array_interface__: dict[str, Any] = block.__array_interface__

    @property
    def address(self) -> int:
        return int(self.__array_interface__["data"][0])

    def __del__(self) -> None:
        if self._block.nbytes <= LARGEST_KEPT_BYTES:
            self._idle.append(self._block)
