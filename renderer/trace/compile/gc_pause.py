"""Keeps Python's full garbage collections away while kernels are compiled.

The compiler makes a million objects: looking through them all takes 100 ms, again and again, during
which no other thread of Python runs, and a window stands still.
"""

from __future__ import annotations

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

NEVER = 1 << 30  # collections of the middle generation between two full ones


class _Pause:
    """Nested and used by several threads, it ends with the last."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._users = 0
        self._threshold = 0

    def begin(self) -> None:
        with self._lock:
            young, middle, full = gc.get_threshold()
            if not self._users:
                self._threshold = full
                gc.set_threshold(young, middle, NEVER)
            self._users += 1

    def end(self) -> None:
        with self._lock:
            self._users -= 1
            young, middle, full = gc.get_threshold()
            if not self._users and full == NEVER:  # else somebody has changed it since
                gc.set_threshold(young, middle, self._threshold)


_pause = _Pause()


@contextmanager
def no_full_collections() -> Iterator[None]:
    """Only young objects are collected meanwhile, in the whole process."""
    _pause.begin()
    try:
        yield
    finally:
        _pause.end()
