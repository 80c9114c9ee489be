"""Background work that must not block the window: one task at a time; a newer request replaces a
waiting one, or all run in order.

It loads scenes and compares images with them, for example.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, TypeVar

from lucida.renderer.system.memo import Memo, Parts

T = TypeVar("T")
NICER = 5  # on Linux: background work yields to the window


@dataclass(frozen=True)
class Outcome(Generic[T]):
    """The result of a task: its value, or the exception it raised."""

    value: T | None
    error: Exception | None = None


class Background(Generic[T]):
    """Run tasks one at a time on a worker thread, started on first use.

    wake: called on that thread after each task; by default wake_window, which the window sets to
    request a frame.
    every: run all tasks in order (for saving files); otherwise only the latest waiting task is
    kept.
    """

    wake_window: ClassVar[Callable[[], None]] = staticmethod(lambda: None)

    def __init__(
        self, name: str, wake: Callable[[], None] | None = None, every: bool = False
    ) -> None:
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
        """Queue `work`, replacing a waiting task unless `every` is set. Does nothing after
        close().
        """
        with self._changed:
            if self._closed:
                return
            self._waiting.append(work)
            self._changed.notify()
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def ask(self, function: Callable[[*Parts], T], *key: *Parts) -> None:
        """Submit function(*key) unless that was the last request. See Memo."""
        self._ask(self, function, *key)

    def forget(self) -> None:
        """Forget the last request, so that the next one is submitted in any case."""
        self._ask.forget()

    def poll(self) -> Outcome[T] | None:
        """Return the next result, or None. Each result is returned once."""
        with self._changed:
            return self._outcomes.popleft() if self._outcomes else None

    @property
    def busy(self) -> bool:
        """True while a task is waiting or running, or its result has not been polled."""
        with self._changed:
            return self._working or bool(self._waiting) or bool(self._outcomes)

    def close(self, timeout_s: float = 1.0) -> None:
        """Stop the thread. Waiting tasks are dropped unless `every` is set. A thread that does not
        end in time is a daemon, and ends with the process.
        """
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
            except Exception as error:  # the window reports it and keeps running
                outcome = Outcome(None, error)
            with self._changed:
                self._working = False
                self._outcomes.append(outcome)
            (self._wake or Background.wake_window)()


def _submit(work: Background[T], function: Callable[..., T], *key: Any) -> None:
    work.submit(lambda: function(*key))


def lower_priority() -> None:
    """Lower the priority of this thread and those it starts, so the window stays responsive (Linux
    only).
    """
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError):
            # Linux deviates from POSIX: niceness belongs to a thread and is inherited.
            thread = threading.get_native_id()
            niceness = os.getpriority(os.PRIO_PROCESS, thread) + NICER
            os.setpriority(os.PRIO_PROCESS, thread, min(niceness, 19))
