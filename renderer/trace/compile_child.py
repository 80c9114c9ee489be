"""The tracer's parts, each compiled on its own; and the process that compiles them for another.

A part is one or more kernels: "trees" builds the trees; "walk" finds the closest hits of viewing
rays, and "write" shades them; "rays" traces rays that are handed in, and "shade" shades them;
"reference" is the simple method. "walk-rich" and "write-rich" are for scenes with textures, and for
shadows and mirrors; "walk-lens" and "write-lens" for all these and a lens, whose table "lens"
makes.
"""

from __future__ import annotations

import gc
import os
import sys

from renderer.system.child import end_with_parent


def main(*parts: str) -> None:
    """Compile parts, then exit at once: freeing a compiler's million objects would take a sixth of
    its time.

    The exit status is 1 if the cache could not be written. Several parts are compiled concurrently,
    each by a fork of this process. Without garbage collection, all of this takes a tenth less time,
    at the cost of 40 MB.
    """
    gc.disable()
    end_with_parent()
    if len(parts) == 1:
        os._exit(_compile(parts[0]))
    import_compiler()
    import numba

    numba.njit(lambda: 0)()  # prepares numba's compiler, once for all
    copies = [_start_copy(part) for part in parts]
    os._exit(max(os.waitpid(copy, 0)[1] != 0 for copy in copies))


def is_copied() -> bool:
    """Return True if one process should compile all parts: if it can fork safely."""
    return sys.platform == "linux"


def import_compiler() -> None:
    """Import all modules that compilation, or loading from the cache, needs."""
    import renderer.trace.engine  # noqa: F401


def _start_copy(part: str) -> int:
    """Compile a part in a fork of this process. Return the fork's process id."""
    copy = os.fork()
    if copy:
        return copy
    try:
        end_with_parent()
        os._exit(_compile(part))
    finally:
        os._exit(1)


def _compile(part: str) -> int:
    from renderer.trace.compile.compiled import is_cached

    compile_part(part)
    return 0 if is_cached() else 1


def compile_part(part: str) -> None:
    """Compile a part, or load it from the cache, by work on nothing."""
    import numpy as np

    from renderer.scene.flat import flatten
    from renderer.scene.model import Mesh, Scene, SceneObject
    from renderer.trace.bvh.instances import Instances
    from renderer.trace.engine import Engine
    from renderer.trace.threads.thread_pool import Team
    from renderer.trace.tiles.engine import PacketEngine

    nothing, alone = Scene(()), Team(1)
    if part == "trees":
        corners, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)
        scene = Scene((SceneObject(Mesh(corners, face)),))
        Instances(scene, flatten(scene), alone)
    elif part == "rays":
        ray = np.zeros((1, 3)), np.zeros((1, 3))
        PacketEngine(nothing, alone).closest_hits(*ray, 0.0, np.inf)
    elif part == "shade":
        ray = np.zeros((1, 3)), np.zeros((1, 3))
        PacketEngine(nothing, alone).shaded(*ray, 0.0, np.inf)
    elif part == "reference":
        Engine(nothing, alone).compile()
    else:
        PacketEngine(nothing, alone).compile(part)
