"""Return the freed memory of a process with a window to the system.

Images of many sizes leave hundreds of megabytes of holes in glibc's heaps, which it keeps. With
other C libraries, nothing is done.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import sys
import threading
import time

RESTS_S = 0.3
HEAPS = 2
_M_ARENA_MAX = -8  # in glibc's malloc.h


class FreedMemory:
    """A trimmer of freed memory. Create it before there are threads, because glibc makes a heap for
    each thread, up to eight per core.
    """

    def __init__(self) -> None:
        self._returns_s = math.inf
        _glibc("mallopt", _M_ARENA_MAX, HEAPS)

    def follow(self, rests: bool) -> None:
        """Return freed memory to the system once the window has rested for a moment. Call once a
        frame. A thread does the work, which takes some milliseconds.

        rests: True if nothing is moving or being traced.
        """
        now_s = time.monotonic()
        if not rests:
            self._returns_s = now_s + RESTS_S
        elif now_s > self._returns_s:
            self._returns_s = math.inf
            threading.Thread(target=_glibc, args=("malloc_trim", 0), daemon=True).start()


def _glibc(name: str, *arguments: int) -> None:
    if sys.platform == "linux":
        with contextlib.suppress(OSError, AttributeError):
            getattr(ctypes.CDLL(None), name)(*arguments)
