"""A pause of Python's full garbage collections while kernels are compiled.

The compiler creates a million objects. Each full collection takes 100 ms, during which no other
Python thread runs, and a window freezes.
"""

from __future__ import annotations

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

NEVER = 1 << 30  # middle-generation collections between two full ones


class _Pause:
    """A pause that may be nested and used by several threads; it ends with the last user."""

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
            if not self._users and full == NEVER:  # otherwise other code has changed it
                gc.set_threshold(young, middle, self._threshold)


_pause = _Pause()


@contextmanager
def no_full_collections() -> Iterator[None]:
    """Pause full collections in the whole process; young objects are still collected."""
    _pause.begin()
    try:
        yield
    finally:
        _pause.end()
