"""Work that the window does not wait for: one thing at a time, the newest waiting one wins.

Owns a thread. Knows nothing of the work. Scenes are loaded and images compared with it.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")
NICER = 5  # on Linux: what goes on beside the window gives way to it


@dataclass(frozen=True)
class Outcome(Generic[T]):
    """What a piece of work gave: a value, or the exception that ended it."""

    value: T | None
    error: Exception | None = None


class Background(Generic[T]):
    """Runs functions in a thread of its own, which starts with the first. wake: called from that
    thread after each."""

    def __init__(self, name: str, wake: Callable[[], None]) -> None:
        self._name, self._wake = name, wake
        self._changed = threading.Condition()
        self._waiting: Callable[[], T] | None = None
        self._working = False
        self._outcome: Outcome[T] | None = None
        self._closed = False
        self._thread: threading.Thread | None = None

    def submit(self, work: Callable[[], T]) -> None:
        """Asks for `work`; takes the place of work that has not begun."""
        with self._changed:
            self._waiting = work
            self._changed.notify()
            if self._thread is None and not self._closed:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def poll(self) -> Outcome[T] | None:
        """The newest outcome, once; None while there is none."""
        with self._changed:
            outcome, self._outcome = self._outcome, None
            return outcome

    @property
    def busy(self) -> bool:
        """Whether work waits, runs, or has an outcome that poll() has not given."""
        with self._changed:
            return self._working or self._waiting is not None or self._outcome is not None

    def close(self, timeout_s: float = 1.0) -> None:
        """Drops waiting work; a daemon thread that does not end in time is left to the exit."""
        with self._changed:
            self._waiting, self._closed = None, True
            self._changed.notify()
        if self._thread is not None:
            self._thread.join(timeout_s)

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting is not None)
                if self._closed:
                    return
                work, self._waiting = self._waiting, None
                self._working = True
            assert work is not None
            try:
                outcome = Outcome(work())
            except Exception as error:  # shown in the window, which goes on
                outcome = Outcome(None, error)
            with self._changed:
                self._working, self._outcome = False, outcome
            self._wake()


def lower_priority() -> None:
    """The calling thread, and the threads that it starts, give way to the window's (Linux)."""
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError):
            # There, and against POSIX, niceness belongs to a thread and is inherited.
            thread = threading.get_native_id()
            niceness = os.getpriority(os.PRIO_PROCESS, thread) + NICER
            os.setpriority(os.PRIO_PROCESS, thread, min(niceness, 19))
