"""The tracer's parts: groups of kernels that are compiled separately, each under a name.

The name marks the part in the cache folder, and another process compiles a part by its name:

    trees      builds the trees of a scene
    walk-...   finds the closest hits of an image's viewing rays, in a variant (tiles/variants.py)
    write-...  shades those hits, in the same variant
    lens       computes the frames of a lens's tiles
    rays       traces rays that a user passes
    shade      shades the hits of such rays
    reference  traces images by the simple method
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from lucida.renderer.scene.model import Mesh, Scene, SceneObject

from .image_job import Task
from .ray_batch import RayBatch
from .tiles.variants import Variant, variant_of


def parts_of(method: str, effects: bool, scene: Scene, task: Task | RayBatch) -> tuple[str, ...]:
    """Return the parts that a task on a scene needs, the slowest first.

    method: of tracer.METHODS. effects: True for shadows or mirrors.
    """
    if method == "reference":
        return ("reference",)
    if isinstance(task, RayBatch):
        return "rays", "trees", *(["shade"] if task.method == "shaded" else [])
    variant = variant_of(scene, task.camera, effects)
    if variant is Variant.LENS:
        return f"write-{variant}", f"walk-{variant}", "trees", "lens"
    return f"walk-{variant}", f"write-{variant}", "trees"


def compile_part(part: str) -> None:
    """Compile a part, or load it from the cache, by running it on nothing. Imports numba."""
    import numpy as np

    from lucida.renderer.scene.flat import flatten

    from .bvh.instances import Instances
    from .reference_engine import ReferenceEngine
    from .threads.thread_pool import Team
    from .tiles.engine import PacketEngine

    alone, nothing = Team(1), Scene(())
    triangle = SceneObject(Mesh(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)))
    ray = np.zeros((1, 3)), np.zeros((1, 3)), 0.0, np.inf

    packets = PacketEngine(nothing, alone)
    compilers: dict[str, Callable[[], object]] = {
        "trees": lambda: Instances(Scene((triangle,)), flatten(Scene((triangle,))), alone),
        "lens": packets.compile_lens,
        "rays": partial(packets.closest_hits, *ray),
        "shade": partial(packets.shaded, *ray),
        "reference": lambda: ReferenceEngine(nothing, alone).compile(),
        **{f"walk-{variant}": partial(packets.compile_walk, variant) for variant in Variant},
        **{f"write-{variant}": partial(packets.compile_write, variant) for variant in Variant},
    }
    compilers[part]()
