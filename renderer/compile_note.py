"""Whether the tracer's kernels are being compiled in this run: seconds, told to whoever waits.

Light to import; written to by the compiler's side (renderer/trace), read by any thread.
"""

from __future__ import annotations

ONCE = "compiling the ray tracer, once for this installation ..."
EACH_TIME = (
    "compiling the ray tracer, at each start: no folder can keep it; "
    "set NUMBA_CACHE_DIR to one that can, on a disk with room"
)

_note = ""


def begin(kept: bool) -> None:
    """Something must be compiled that no cache holds. kept: the next run will find it there, as far
    as is known; what cannot be kept is told for good."""
    global _note
    if is_kept():
        _note = ONCE if kept else EACH_TIME


def is_kept() -> bool:
    """Whether the next run will find all that was compiled in this one."""
    return _note != EACH_TIME


def note() -> str:
    """What to say once something had to be compiled; empty as long as nothing had to be."""
    return _note
