"""The slow part of uploading a scene to the rasterizer, which needs no OpenGL.

Any thread may prepare a scene while the thread with the context draws.
"""

from __future__ import annotations

from typing import NamedTuple

from renderer.raster.setup import SceneSetup, scene_setup
from renderer.scene.flat import FlatScene, flatten, same_meshes
from renderer.scene.model import Scene, check_scene


class Prepared(NamedTuple):
    """The scene's arrays, and those that the triangle setup needs."""

    flat: FlatScene
    setup: SceneSetup


def prepare(scene: Scene, known: tuple[Scene, Prepared] | None = None) -> Prepared:
    """Prepare a scene for Rasterizer(), or set_scene().

    known: an earlier scene and its result; what the two scenes have in common is reused. Raises
    LucidaError (see flatten).
    """
    check_scene(scene)
    if known is None:
        flat = flatten(scene)
        return Prepared(flat, scene_setup(flat))
    old, prepared = known
    flat = flatten(scene, (old, prepared.flat))
    return Prepared(flat, scene_setup(flat, prepared, same_meshes(scene, old)))
