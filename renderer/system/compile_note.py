"""A note that the tracer's kernels are being compiled in this run, which takes seconds.

The compiler's side (renderer/trace) writes it; any thread may read it. It is light to import.
"""

from __future__ import annotations

ONCE = "compiling the ray tracer, once for this installation ..."
EACH_TIME = (
    "compiling the ray tracer, at each start: no folder can keep it; "
    "set NUMBA_CACHE_DIR to one that can, on a disk with room"
)

_note = ""
_progress = ""


def begin(kept: bool) -> None:
    """Note that something must be compiled that is not in a cache.

    kept: the next run is expected to find it in the cache. Once something cannot be kept, the note
    stays.
    """
    global _note
    if is_kept():
        _note = ONCE if kept else EACH_TIME


def is_kept() -> bool:
    """Return True if the next run will find everything that was compiled in this one."""
    return _note != EACH_TIME


def report(done: int, count: int) -> None:
    """Report how many of the parts have been compiled."""
    global _progress
    _progress = f"{done} of {count} parts"


def progress() -> str:
    """Return how many of how many parts have been compiled; empty before the first report."""
    return _progress


def note() -> str:
    """Return the message to show once something had to be compiled; empty before that."""
    return _note
