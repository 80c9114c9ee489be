"""Leaving the reading of a scene half way: between its parts it asks whether anybody waits.

Knows nothing of who waits, nor of what is read.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from contextvars import ContextVar


def check_cancelled() -> None:
    """Raises what cancelled_by() was given to raise, once nobody waits for the scene any more."""
    _check.get()()


@contextlib.contextmanager
def cancelled_by(check: Callable[[], None]) -> Iterator[None]:
    """Inside it, in this thread, `check` is asked again and again; it raises to end the reading."""
    token = _check.set(check)
    try:
        yield
    finally:
        _check.reset(token)


def _goes_on() -> None:
    pass


_check: ContextVar[Callable[[], None]] = ContextVar("whether to go on", default=_goes_on)
