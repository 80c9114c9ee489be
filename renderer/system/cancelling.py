"""Cancel the reading of a scene by a check that is called between its parts and may raise."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from contextvars import ContextVar
from typing import TypeVar

T = TypeVar("T")


class CancelledError(Exception):
    """The result is no longer needed."""


class Cancellation:
    """A switch between two threads: one works under cancelled_by(check), the other cancels."""

    def __init__(self) -> None:
        self._cancelled = threading.Event()

    def cancel(self) -> None:
        self._cancelled.set()

    def check(self) -> None:
        """Raise CancelledError after cancel() was called."""
        if self._cancelled.is_set():
            raise CancelledError


_check: ContextVar[Callable[[], None]] = ContextVar("check")


@contextlib.contextmanager
def during(variable: ContextVar[T], value: T) -> Iterator[T]:
    """Set a context variable for the block, on this thread, and return the value."""
    token = variable.set(value)
    try:
        yield value
    finally:
        variable.reset(token)


def cancelled_by(check: Callable[[], None]) -> AbstractContextManager[object]:
    """Call `check` repeatedly during the block, on this thread. It raises to cancel."""
    return during(_check, check)


def check_cancelled() -> None:
    """Call the check, if there is one. It raises once the scene is no longer wanted."""
    if check := _check.get(None):
        check()
