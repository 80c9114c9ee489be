"""Memory for images, used again as soon as nobody looks at what was in it.

Owns the blocks of memory that idle between two images. Knows nothing of pixels.

A live image is 10 to 100 MB, fresh memory for which comes from the system page by page: thousands
of interrupts, which can take as long as the tracing. So all channels of an image lie in one block,
and the block comes back here when the last array of it is gone.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

KEPT = 3  # idle blocks; the one that has been idle longest goes first
LARGEST_KEPT_BYTES = 1 << 27  # 2560x1440 pixels of all channels
_LINE_BYTES = 64
# Not all at the same place within memory's pages: a pixel's numbers would compete for the same
# lines of the cache.
_STAGGER_BYTES = _LINE_BYTES

Block = NDArray[np.uint8]


class Buffers:
    """A user's idle blocks. Any thread may take arrays, and let them go."""

    def __init__(self) -> None:
        # Its single operations are atomic, so that there is no lock for _Lease.__del__ to wait for,
        # which may interrupt any thread anywhere.
        self.idle: deque[Block] = deque(maxlen=KEPT)

    def arrays(self, layouts: Iterable[tuple[tuple[int, ...], DTypeLike]]) -> list[NDArray]:
        """An array of each (shape, dtype), writable, which hold anything. Raises MemoryError."""
        parts = [(shape, np.dtype(dtype)) for shape, dtype in layouts]
        sizes = [math.prod(shape) * dtype.itemsize for shape, dtype in parts]
        begins = [0]
        for size in sizes:
            begins.append(begins[-1] + -(-size // _LINE_BYTES) * _LINE_BYTES + _STAGGER_BYTES)
        lease = _Lease(self._block(begins[-1] + _LINE_BYTES), self.idle)
        # Every view of `whole`, and every view of these, keeps it alive, and it the lease.
        whole = np.asarray(lease)
        first = -lease.address % _LINE_BYTES
        return [
            np.ndarray(shape, dtype, whole, first + begin)
            for begin, (shape, dtype) in zip(begins[:-1], parts, strict=True)
        ]

    def _block(self, size: int) -> Block:
        """An idle block of that size, the last used one, of which most is cached; or a new one."""
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
    """A block in use. NumPy takes it for an array, whose memory is this object's."""

    def __init__(self, block: Block, idle: deque[Block]) -> None:
        self._block, self._idle = block, idle
        self.__array_interface__: dict[str, Any] = block.__array_interface__

    @property
    def address(self) -> int:
        return int(self.__array_interface__["data"][0])

    def __del__(self) -> None:
        if self._block.nbytes <= LARGEST_KEPT_BYTES:
            self._idle.append(self._block)
