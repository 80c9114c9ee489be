"""Compilation of the tracer's parts by other processes, into the cache of machine code.

numba compiles one function at a time, and holds the GIL meanwhile. Other processes compile
concurrently, while a window's loop continues. This module does not need numba. Nothing depends on
these processes, because a part that is still missing from the cache is compiled in this process.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Sequence

from lucida.renderer.system import compile_note
from lucida.renderer.system.child import end_child, interpreter, start_child

from . import compile_child
from .compile.cache_folder import cache_folder
from .threads.thread_pool import default_threads

_POLL_S = 0.01


def precompile(parts: Sequence[str], is_closed: Callable[[], bool]) -> None:
    """Compile the parts that are not in the cache, in one process for all if it can fork, or else
    in one for each. Return when all have ended, or is_closed() returns True.

    No process is started without a cache folder, on a single processor, or if the executable is not
    the Python interpreter.
    """
    folder, python = cache_folder(), interpreter()
    missing = [p for p in parts if folder is None or not (folder / f"{p}.done").exists()]
    if not missing:
        return
    compile_note.begin(kept=folder is not None)
    if folder is None or python is None or default_threads() == 1:
        return
    processes = []
    try:
        for group in [missing] if compile_child.can_fork() else [[part] for part in missing]:
            with contextlib.suppress(OSError):
                processes.append((start_child(python, compile_child.__name__, *group), group))
        compile_child.import_compiler()  # import the modules for loading meanwhile
        while any(process.poll() is None for process, _ in processes) and not is_closed():
            done = sum((folder / f"{part}.done").exists() for part in missing)
            compile_note.report(done, len(missing))
            time.sleep(_POLL_S)
    finally:
        for process, group in processes:
            if end_child(process) == 0:
                with contextlib.suppress(OSError):
                    for part in group:
                        (folder / f"{part}.done").touch()
