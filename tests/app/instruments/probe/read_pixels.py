"""Pixels that the probe reads, and what it says and copies of them."""

from __future__ import annotations

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import PointLight, Scene, SceneObject, Sphere

SIZE = (64, 48)
ALL = ("color", "depth", "normal", "id", "primitive")
BALL = Scene(
    (SceneObject(Sphere((0, 0, -3), 1), Material((0.5, 0.4, 0.3), (0.2, 0.2, 0.2), 20), "ball"),),
    (PointLight((2, 3, 1), (0.9, 0.8, 0.7)),),
    ambient=(0.1, 0.1, 0.2),
    background=(0.25, 0.5, 0.75),
)


def line(lines, key):
    return next(line for line in lines if line.key == key)


def cameras(scene: Scene):
    """The scene's own, a parallel one, a skewed one and a clipped one."""
    own = scene.view.for_size(SIZE)
    reach = float(np.abs(flatten(scene).bounds).max())
    wide = (-reach / 3, reach / 3, -reach / 4, reach / 4)
    yield own
    yield Camera(own.eye, own.u, own.v, own.w, 1.0, wide, "parallel")
    skewed = np.array(own.u) + 0.3 * np.array(own.w), 1.4 * np.array(own.v) - 0.2 * np.array(own.u)
    yield Camera(own.eye, *map(tuple, skewed), own.w, own.distance, own.viewport)
    depth = float(np.linalg.norm(own.eye)) or 4.0
    yield Camera(
        own.eye, own.u, own.v, own.w, own.distance, own.viewport, near=0.7 * depth, far=1.2 * depth
    )
