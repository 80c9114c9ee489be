"""Work that the window does not wait for: one thing at a time, the newest waiting one wins, or each
has its turn.

Owns a thread. Knows nothing of the work. Scenes are loaded and images compared with it.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from renderer.memo import Memo, Parts

T = TypeVar("T")
NICER = 5  # on Linux: what goes on beside the window gives way to it


@dataclass(frozen=True)
class Outcome(Generic[T]):
    """The result of a task: its value, or the exception it raised."""

    value: T | None
    error: Exception | None = None


class Background(Generic[T]):
    """Runs functions in a thread of its own, which starts with the first. wake: called from that
    thread after each. every: all of them, one after another, for what must not be left out, such as
    files that are to be written; otherwise the newest that waits takes the others' place."""

    def __init__(self, name: str, wake: Callable[[], None], every: bool = False) -> None:
        self._name, self._wake, self._every = name, wake, every
        self._changed = threading.Condition()
        most = None if every else 1
        self._waiting: deque[Callable[[], T]] = deque(maxlen=most)
        self._working = False
        self._outcomes: deque[Outcome[T]] = deque(maxlen=most)
        self._closed = False
        self._thread: threading.Thread | None = None
        self._ask: Memo[*tuple[Any, ...], None] = Memo(_submit)

    def submit(self, work: Callable[[], T]) -> None:
        """Asks for `work`; where not every work is done, it takes the place of what has not begun.
        After close() nothing is begun."""
        with self._changed:
            if self._closed:
                return
            self._waiting.append(work)
            self._changed.notify()
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def ask(self, function: Callable[[*Parts], T], *key: *Parts) -> None:
        """Submit function(*key), unless that was asked for last. See Memo."""
        self._ask(self, function, *key)

    def forget(self) -> None:
        """Submit whatever is asked for next."""
        self._ask.forget()

    def poll(self) -> Outcome[T] | None:
        """The newest outcome, once, or the next where every work is done; None while there is
        none."""
        with self._changed:
            return self._outcomes.popleft() if self._outcomes else None

    @property
    def busy(self) -> bool:
        """True while a task is waiting or running, or its result has not been polled."""
        with self._changed:
            return self._working or bool(self._waiting) or bool(self._outcomes)

    def close(self, timeout_s: float = 1.0) -> None:
        """Drops waiting work, unless every work is done; a daemon thread that does not end in time
        is left to the exit."""
        with self._changed:
            self._closed = True
            if not self._every:
                self._waiting.clear()
            self._changed.notify()
        if self._thread is not None:
            self._thread.join(timeout_s)

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting)
                if not self._waiting:
                    return
                work = self._waiting.popleft()
                self._working = True
            try:
                outcome = Outcome(work())
            except Exception as error:  # shown in the window, which goes on
                outcome = Outcome(None, error)
            with self._changed:
                self._working = False
                self._outcomes.append(outcome)
            self._wake()


def _submit(work: Background[T], function: Callable[..., T], *key: Any) -> None:
    work.submit(lambda: function(*key))


def lower_priority() -> None:
    """The calling thread, and the threads that it starts, give way to the window's (Linux)."""
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError):
            # There, and against POSIX, niceness belongs to a thread and is inherited.
            thread = threading.get_native_id()
            niceness = os.getpriority(os.PRIO_PROCESS, thread) + NICER
            os.setpriority(os.PRIO_PROCESS, thread, min(niceness, 19))
