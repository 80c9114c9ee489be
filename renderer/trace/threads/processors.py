"""On which processors a team's threads are woken: not all on one.

Owns what the system's scheduler is asked for. Linux only: elsewhere nothing is asked.

Linux wakes a thread on an idle processor if it finds one. In a virtual machine it finds none after
a pause: its host has taken the idle processors away, which counts as busy. So a thread is woken
beside the one that wakes it, and the two share a processor until the scheduler notices: some
milliseconds, as long as a whole image takes.
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
    # PyDLL: the lock of Python is kept, as for any quick call.
    return getattr(ctypes.PyDLL(None), "sched_getcpu", None)


here = find_here()


def others_than_here() -> tuple[Processors, Processors] | None:
    """The processors that the calling thread may use but for the one that it is on, and with it.

    None where the system does not tell, or there is no other.
    """
    if here is None:
        return None
    allowed = os.sched_getaffinity(0)
    others = allowed - {here()}
    return (others, allowed) if others else None


def confine(threads: Iterable[int], processors: Processors) -> None:
    """Lets threads of this process run on these processors only; 0: the calling thread. Where the
    system forbids that, it is left as it is."""
    with contextlib.suppress(OSError):
        for thread in threads:
            os.sched_setaffinity(thread, processors)
