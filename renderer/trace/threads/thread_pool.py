"""A team of threads that run one kernel together.

This module does not need numba. A kernel is any function, preferably one that releases the GIL and
divides its work with a control array (see atomic.py).
"""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.errors import LucidaError

MOST_THREADS = 1024
# The control array of one kernel launch: pieces of work taken and done, and a request to stop.
NEXT, DONE = 0, 16  # on separate cache lines, to avoid false sharing
CANCELLED = 1 << 60  # more than any amount of work


Control = NDArray[np.int64]


def new_control() -> Control:
    """Return a control array with nothing taken and nothing done."""
    return np.zeros(32, np.int64)


def cancel(control: Control) -> None:
    """Withdraw the remaining work. Any thread may call this at any time."""
    control[NEXT] = CANCELLED


def cancelled_control() -> Control:
    """Return the control array of a launch that only compiles its kernel."""
    control = new_control()
    cancel(control)
    return control


def default_threads() -> int:
    """Return the number of processors that this process may use."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def check_threads(threads: int | None) -> int:
    """Return the number of threads; the default for None. Raises LucidaError."""
    if threads is None:
        return min(default_threads(), MOST_THREADS)
    if isinstance(threads, bool) or not isinstance(threads, int):
        raise LucidaError("threads", f"{threads!r} is not a whole number", "give e.g. 2, or None")
    if not 1 <= threads <= MOST_THREADS:
        raise LucidaError("threads", f"{threads} is not in 1 to {MOST_THREADS}", "give e.g. 2")
    return threads


class AbandonedError(Exception):
    """The team's work is no longer needed."""


class Team:
    """The calling thread and size - 1 helpers, which start on first use.

    Only one thread at a time, the owner, may use a team. Helpers are daemon threads; the owner
    calls close(). is_over: called before each kernel; returns True to abandon the work.
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self.is_over: Callable[[], bool] | None = None
        self._helpers: list[threading.Thread] = []
        self._calls: queue.SimpleQueue[tuple[Callable[..., Any], tuple] | None] = (
            queue.SimpleQueue()
        )
        self._outcomes: queue.SimpleQueue[BaseException | None] = queue.SimpleQueue()

    def run(self, kernel: Callable[..., Any], *args: Any, size: int | None = None) -> None:
        """Call kernel(*args) in each thread, or in `size` of them. Return when all have returned.

        Raises a call's exception after all have ended, or AbandonedError, before any call, if
        is_over() returns True.
        """
        if self.is_over is not None and self.is_over():
            raise AbandonedError
        helpers = min(self.size, self.size if size is None else max(size, 1)) - 1
        while len(self._helpers) < helpers:
            name = f"lucida-trace-{len(self._helpers) + 1}"
            helper = threading.Thread(target=self._help, name=name, daemon=True)
            helper.start()
            self._helpers.append(helper)
        for _ in range(helpers):
            self._calls.put((kernel, args))
        errors = [_outcome(kernel, args)]
        errors += [self._outcomes.get() for _ in range(helpers)]
        for error in errors:
            if error is not None:
                raise error

    def close(self) -> None:
        """Stop the helpers, and wait for them."""
        for _ in self._helpers:
            self._calls.put(None)
        for helper in self._helpers:
            helper.join()
        self._helpers.clear()

    def _help(self) -> None:
        while (call := self._calls.get()) is not None:
            self._outcomes.put(_outcome(*call))
            del call  # frees its arrays while waiting for the next one


def _outcome(kernel: Callable[..., Any], args: tuple) -> BaseException | None:
    try:
        kernel(*args)
    except BaseException as error:
        return error
    return None
