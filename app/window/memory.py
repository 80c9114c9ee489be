"""The memory of a process with a window: what was freed goes back to the system.

Images of many sizes leave holes in glibc's heaps, hundreds of megabytes of them, which it keeps.
Other C libraries are left alone.
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
    """Create it before there are threads: glibc makes a heap for each one, up to eight a core."""

    def __init__(self) -> None:
        self._returns_s = math.inf
        _glibc("mallopt", _M_ARENA_MAX, HEAPS)

    def follow(self, rests: bool) -> None:
        """Call once a frame. rests: nothing is moved or traced. Return what was freed once the
        window has rested for a moment, in a thread: that takes some milliseconds."""
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
