"""What a process does that compiles kernels for another one, into the cache.

Owns the parts that kernels are compiled in. Imports the compiler late: without collecting garbage,
all of this takes a tenth less time, for 40 MB.
"""

from __future__ import annotations

import gc
import os
import sys

from renderer import compile_note
from renderer.child import end_with_parent


def main(*parts: str) -> None:
    """Compiles parts, and ends at once: to take a compiler's million objects down would take a
    sixth of its time. The status is 1 where the cache could not take it.

    Several parts are compiled at once, each by a copy of this process, made when all is imported:
    see is_copied().
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
    """Whether one process is to be given all parts: where it can copy itself safely."""
    return sys.platform == "linux"


def _make_ready() -> None:
    """Does what all parts begin with: half a second's work."""
    import numba

    import renderer.trace.packets.engine  # noqa: F401

    numba.njit(lambda: None).compile(())


def _compile_in_copy(part: str, number: int) -> int:
    """Compiles a part in a copy of this process, whose number it gives."""
    copy = os.fork()
    if copy:
        return copy
    status = 1
    try:
        end_with_parent()
        os.nice(number)  # what takes longest is not to be the last at work
        compile_part(part)
        status = 0 if compile_note.is_kept() else 1
    finally:
        os._exit(status)


def compile_part(part: str) -> None:
    """Compiles a part, of precompile.parts_of() or part_of_rays(), or finds it in the cache."""
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
