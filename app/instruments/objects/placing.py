"""A place and a size for a new object or light: in the picture, in front of the scene's middle, and
sized to the scene. Pure.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.focus import Focus

OF_SCENE, OF_VIEW = 0.16, 0.3  # sizes relative to the scene's diagonal and the view's height
NEARER = 0.6  # the distance of a new object, relative to the middle
LIGHT_AT = 0.4, 0.7  # across the picture and up, from -1 to 1


class NewPlace(NamedTuple):
    """A point in world space, and a size across."""

    at: tuple[float, float, float]
    size: float


def place_for(focus: Focus, camera: Camera, is_light: bool = False) -> NewPlace:
    """Return a place in the middle of the picture; a light's is above it."""
    middle = float(camera.project(focus.center, (1, 1)).parameter)
    if not middle > 0:  # the scene is behind the eye, or empty
        middle = focus.reach / camera.distance
    t = middle if is_light else NEARER * middle
    across, up = LIGHT_AT if is_light else (0.0, 0.0)
    ray = camera.ray(-up / 2, across / 2, (1, 1))
    high = (camera.viewport[3] - camera.viewport[2]) * float(np.linalg.norm(camera.v))
    size = OF_VIEW * high * (1.0 if camera.is_parallel else t)
    diagonal = float(np.linalg.norm(np.ptp(focus.framed, axis=0))) if len(focus.framed) else 0.0
    x, y, z = (ray.origin + t * ray.direction).tolist()
    return NewPlace((x, y, z), min(size, OF_SCENE * diagonal) or size)
