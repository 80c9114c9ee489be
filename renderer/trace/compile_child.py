"""The process that compiles parts of the tracer (parts.py) for another process."""

from __future__ import annotations

import contextlib
import gc
import os
import sys
from collections.abc import Sequence

from lucida.renderer.system.child import end_with_parent

from .parts import compile_part
from .threads.thread_pool import default_threads


def main(*parts: str) -> None:
    """Compile parts in a fork for each processor. Parts in one fork share functions that they call.

    The exit status is 1 if the cache could not be written. The process exits at once, because
    freeing a compiler's million objects would take a sixth of its time. Turning off garbage
    collection saves a tenth of the time, at the cost of 40 MB.
    """
    gc.disable()
    end_with_parent()
    if len(parts) == 1:
        os._exit(_compile(parts[0]))
    import_compiler()
    import numba

    numba.njit(lambda: 0)()  # prepares numba's compiler, once for all
    count = min(default_threads(), len(parts))
    forks = [_fork(parts[first::count]) for first in range(count)]
    os._exit(max(os.waitpid(fork, 0)[1] != 0 for fork in forks))


def can_fork() -> bool:
    """Return True if one process may compile all parts, by forking safely."""
    return sys.platform == "linux"


def import_compiler() -> None:
    """Import all modules that compilation, or loading from the cache, needs."""
    from .reference_engine import ReferenceEngine  # noqa: F401
    from .tiles.engine import PacketEngine  # noqa: F401


def _fork(parts: Sequence[str]) -> int:
    """Compile parts in a fork of this process. Return the fork's process id."""
    if fork := os.fork():
        return fork
    try:
        end_with_parent()
        os._exit(max(map(_compile, parts)))
    finally:
        os._exit(1)


def _compile(part: str) -> int:
    """Compile a part. Return the exit status."""
    from .compile.cache_folder import cache_folder
    from .compile.compiled import is_cached

    compile_part(part)
    folder = cache_folder()
    if folder is None or not is_cached():
        return 1
    with contextlib.suppress(OSError):
        (folder / f"{part}.done").touch()
    return 0
