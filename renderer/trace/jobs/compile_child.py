"""What a process does that compiles kernels for another one, into the cache.

Owns the parts that kernels are compiled in. Imports the compiler late: without collecting garbage,
all of this takes a tenth less time, for 40 MB.
"""

from __future__ import annotations

import gc
import os

from renderer import compile_note
from renderer.child import end_with_parent


def main(part: str) -> None:
    """Compiles a part, and ends at once: to take a compiler's million objects down would take a
    sixth of its time. The status is 1 where the cache could not take it."""
    gc.disable()
    from renderer.trace.compile.numba_inside import part as part_of_numba

    end_with_parent()
    if (shortcuts := part_of_numba("numba_shortcuts")) is not None:
        shortcuts.take_shortcuts()
    compile_part(part)
    os._exit(0 if compile_note.is_kept() else 1)


def compile_part(part: str) -> None:
    """Compiles a part, one of precompile.parts_of(), or finds it in the cache."""
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
    else:
        effects, kernel = "-effects" in part, part.replace("-effects", "")
        PacketEngine(Scene(()), Team(1), effects, int(effects), (kernel,))  # nothing to build
