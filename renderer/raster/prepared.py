"""A scene as the rasterizer uploads it: what takes long, and needs no OpenGL.

Owns the order of the steps. Any thread may prepare a scene, while the one with the context draws.
"""

from __future__ import annotations

from typing import NamedTuple

from renderer.raster.setup import SceneSetup, scene_setup
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import Scene, check_scene


class Prepared(NamedTuple):
    """The scene's arrays, and what the triangle setup needs of them."""

    flat: FlatScene
    setup: SceneSetup


def prepare(scene: Scene) -> Prepared:
    """For Rasterizer(), or set_scene(). Raises LucidaError (see flatten)."""
    flat = flatten(check_scene(scene))
    return Prepared(flat, scene_setup(flat))
