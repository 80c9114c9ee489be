"""Keeping a team's threads from waking up on the same processor.

Linux only: elsewhere nothing is done. Linux wakes a thread on an idle processor if it finds one. In
a virtual machine it finds none after a pause: the host has taken the idle processors away, and they
count as busy. A thread is therefore woken on the processor of the thread that wakes it, and both
share it until the scheduler notices: some milliseconds, as long as a whole image takes.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Callable, Iterable

Processors = set[int]


def find_here() -> Callable[[], int] | None:
    if sys.platform != "linux" or not hasattr(os, "sched_setaffinity"):
        return None
    # PyDLL keeps the GIL: the call is quick.
    return getattr(ctypes.PyDLL(None), "sched_getcpu", None)


here = find_here()


def others_than_here() -> tuple[Processors, Processors] | None:
    """Return the processors that the calling thread may use, without and with its current one.

    Returns None if the system does not report them, or there is only one.
    """
    if here is None:
        return None
    allowed = os.sched_getaffinity(0)
    others = allowed - {here()}
    return (others, allowed) if others else None


def confine(threads: Iterable[int], processors: Processors) -> None:
    """Restrict threads of this process to these processors; 0 is the calling thread. Does nothing
    if the system forbids that.
    """
    with contextlib.suppress(OSError):
        for thread in threads:
            os.sched_setaffinity(thread, processors)
