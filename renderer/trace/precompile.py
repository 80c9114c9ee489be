"""Compilation of the tracer's parts by other processes, into the cache of machine code.

numba compiles one function at a time, and holds the GIL meanwhile. Other processes compile
concurrently, and a window's loop goes on. Needs no numba. Nothing depends on these processes: a
part that is not in the cache afterwards is compiled in this process.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Sequence
from importlib import import_module

from renderer.scene.model import Scene, has_textures
from renderer.system import compile_note
from renderer.system.child import end_child, interpreter, start_child
from renderer.trace.compile.cache_folder import cache_folder
from renderer.trace.compile_child import is_copied
from renderer.trace.image_job import Task
from renderer.trace.ray_batch import RayBatch
from renderer.trace.threads.thread_pool import default_threads

_POLL_S = 0.01
_CHILD = "renderer.trace.compile_child"


def parts_of(method: str, effects: bool, scene: Scene, task: Task | RayBatch) -> tuple[str, ...]:
    """Return the parts (compile_child.py) that a task on a scene needs, the slowest first.

    method: of tracer.METHODS. effects: True if there are shadows or mirrors.
    """
    if method == "reference":
        return ("reference",)
    if isinstance(task, RayBatch):
        return "rays", "trees", *(["shade"] if task.method == "shaded" else [])
    if task.camera.lens is not None:
        return "write-lens", "walk-lens", "trees", "lens"
    variant = "-rich" if effects or has_textures(scene) else ""
    return f"walk{variant}", f"write{variant}", "trees"


def precompile(parts: Sequence[str], is_closed: Callable[[], bool]) -> None:
    """Compile the parts that are not in the cache: one process for all if it can fork, otherwise
    one for each. Return when all have ended, or is_closed() returns True.

    Starts none if they would be useless or impossible: no cache folder, a single processor, or an
    executable that is not the Python interpreter.
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
        for group in [missing] if is_copied() else [[part] for part in missing]:
            with contextlib.suppress(OSError):
                processes.append((start_child(python, _CHILD, *group), group))
        import_module(_CHILD).import_compiler()  # what loading needs, meanwhile
        while any(process.poll() is None for process, _ in processes) and not is_closed():
            time.sleep(_POLL_S)
    finally:
        for process, group in processes:
            if end_child(process) == 0:
                with contextlib.suppress(OSError):
                    for part in group:
                        (folder / f"{part}.done").touch()
