"""The main function of a process that compiles kernels into the cache for another process.

Imports the compiler late: with garbage collection turned off, all of this takes a tenth less time,
at the cost of 40 MB.
"""

from __future__ import annotations

import gc
import os
import sys

from renderer import compile_note
from renderer.child import end_with_parent


def main(*parts: str) -> None:
    """Compile parts, then exit at once: freeing a compiler's million objects would take a sixth of
    its time.

    The exit status is 1 if the cache could not be written. Several parts are compiled concurrently,
    each by a fork of this process made after all imports: see is_copied().
    """
    gc.disable()
    end_with_parent()
    if len(parts) == 1:
        compile_part(parts[0])
        os._exit(0 if compile_note.is_kept() else 1)
    _make_ready()
    copies = [_compile_in_copy(part, number) for number, part in enumerate(parts)]
    os._exit(1 if any([os.waitpid(copy, 0)[1] for copy in copies]) else 0)


def is_copied() -> bool:
    """Return True if one process should compile all parts: if it can fork safely."""
    return sys.platform == "linux"


def _make_ready() -> None:
    """Do the work that all parts begin with: half a second."""
    import numba

    import renderer.trace.packets.engine  # noqa: F401

    numba.njit(lambda: None).compile(())


def _compile_in_copy(part: str, number: int) -> int:
    """Compile a part in a fork of this process. Return the fork's process id."""
    copy = os.fork()
    if copy:
        return copy
    status = 1
    try:
        end_with_parent()
        os.nice(number)  # the first parts take longest, so they get priority
        compile_part(part)
        status = 0 if compile_note.is_kept() else 1
    finally:
        os._exit(status)


def compile_part(part: str) -> None:
    """Compile a part of precompile.parts_of() or part_of_rays(), or load it from the cache."""
    import numpy as np

    from renderer.scene.flat import flatten
    from renderer.scene.model import Mesh, Scene, SceneObject
    from renderer.trace.bvh.instances import Instances
    from renderer.trace.packets.engine import PacketEngine
    from renderer.trace.threads.thread_pool import Team

    if part == "trees":
        corners, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)
        scene = Scene((SceneObject(Mesh(corners, face)),))
        Instances(scene, flatten(scene), Team(1))
    elif part.startswith("rays-"):
        _, method, origins = part.split("-")
        engine = PacketEngine(Scene(()), Team(1), kernels=())
        ray = np.zeros((1, 3), origins), np.zeros((1, 3), np.float32)
        getattr(engine, method)(*ray, 0.0, np.inf)
    else:
        effects, kernel = "-effects" in part, part.replace("-effects", "")
        PacketEngine(Scene(()), Team(1), effects, int(effects), (kernel,))  # nothing to build
