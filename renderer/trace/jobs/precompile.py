"""Compilation of kernels by other processes, into the cache that this process then loads from.

numba compiles one function at a time, and holds the GIL meanwhile. Processes compile concurrently,
and a window's loop goes on.

Needs no numba, whose import takes as long as theirs, so that they can start first. Nothing depends
on them: a kernel that is not in the cache afterwards is compiled in this process, at its first
call.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import subprocess
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

import llvmlite.binding as llvm

from renderer import compile_note
from renderer.child import end_child, interpreter, start_child
from renderer.trace.compile.cache_folder import cache_folder
from renderer.trace.jobs.compile_child import is_copied
from renderer.trace.threads.thread_pool import default_threads

LIMIT_S = 120.0  # a process that takes longer is killed
_POLL_S = 0.01
_CHILD = "renderer.trace.jobs.compile_child"
_found: set[str] = set()  # parts that this process has found in the cache


def parts_of(method: str, shadows: bool, mirror_depth: int, variant: str) -> tuple[str, ...]:
    """Return the parts of a Tracer's engine that are worth a process (see compile_child.py), the
    slowest first.

    variant: "-lens" if the camera has one, then "-textures" or "-metals" if the scene has these.
    """
    if method != "packets":
        return ()
    writing = "write" + "-effects" * (shadows or mirror_depth > 0) + variant
    return (writing, "walk-lens", "lens") if "-lens" in variant else (writing, "walk", "trees")


def part_of_rays(method: str, origins: str) -> str:
    """Return the part for an engine's closest_hits, any_hits or shaded. origins: their dtype."""
    return f"rays-{method}-{origins}"


class Precompilation:
    """Processes that compile the parts not known to be in the cache: one for all if it can fork,
    otherwise one for each.

    There are none if they would be useless or impossible: no cache folder, a single processor, or
    an executable that is not the Python interpreter.
    """

    def __init__(self, parts: tuple[str, ...]) -> None:
        self._processes: dict[tuple[Path, ...], subprocess.Popen[bytes]] = {}
        self._end_s = time.monotonic() + LIMIT_S
        if _found.issuperset(parts):
            return
        folder, python = cache_folder(), interpreter()
        if folder is None or python is None or default_threads() == 1:
            return
        marks = {part: folder / f"{part}-{_processor()}.done" for part in parts}
        wanted = tuple(part for part in parts if not marks[part].exists())
        _found.update(set(parts).difference(wanted))
        for group in [wanted] if wanted and is_copied() else [(part,) for part in wanted]:
            with contextlib.suppress(OSError):
                process = start_child(python, _CHILD, *group)
                self._processes[tuple(marks[part] for part in group)] = process
                compile_note.begin(kept=True)

    def is_over(self) -> bool:
        """Return True if all are finished, or were given up."""
        for marks, process in list(self._processes.items()):
            if process.poll() is None:
                continue
            if end_child(process) == 0:
                with contextlib.suppress(OSError):
                    for mark in marks:
                        mark.touch()
            del self._processes[marks]
        if time.monotonic() > self._end_s:
            self.end()
        return not self._processes

    def wait(self, is_closed: Callable[[], bool]) -> None:
        """Wait until all are finished, or is_closed() returns True; then kill those that remain."""
        try:
            while not (self.is_over() or is_closed()):
                time.sleep(_POLL_S)
        finally:
            self.end()

    def end(self) -> None:
        """Kill those that are still running."""
        for process in self._processes.values():
            end_child(process)
        self._processes.clear()


@cache
def _processor() -> str:
    """Return a name for the target processor: several may share a folder."""
    try:
        features = llvm.get_host_cpu_features().flatten()
    except RuntimeError:
        features = ""
    chosen = [os.environ.get(f"NUMBA_CPU_{name}") for name in ("NAME", "FEATURES")]
    text = repr((llvm.get_host_cpu_name(), features, chosen))
    return hashlib.sha256(text.encode()).hexdigest()[:12]
