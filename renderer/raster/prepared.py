"""A scene as the rasterizer uploads it: what takes long, and needs no OpenGL.

Owns the order of the steps. Any thread may prepare a scene, while the one with the context draws.
"""

from __future__ import annotations

from typing import NamedTuple

from renderer.raster.setup import SceneSetup, scene_setup
from renderer.scene.flat import FlatScene, flatten, same_meshes
from renderer.scene.model import Scene, check_scene


class Prepared(NamedTuple):
    """The scene's arrays, and what the triangle setup needs of them."""

    flat: FlatScene
    setup: SceneSetup


def prepare(scene: Scene, known: tuple[Scene, Prepared] | None = None) -> Prepared:
    """For Rasterizer(), or set_scene(). known: a scene that was prepared before; what the two have
    in common is taken from it. Raises LucidaError (see flatten)."""
    check_scene(scene)
    if known is None:
        flat = flatten(scene)
        return Prepared(flat, scene_setup(flat))
    old, prepared = known
    flat = flatten(scene, (old, prepared.flat))
    return Prepared(flat, scene_setup(flat, prepared, same_meshes(scene, old)))
