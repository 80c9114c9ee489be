"""A place and a size for a new object or light: in the picture, in no other object, sized to the
scene.

Pure.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.focus import Focus, object_corners
from lucida.renderer.scene.model import Scene

OF_SCENE, OF_VIEW = 0.16, 0.3  # a new object's size: of the scene's diagonal, of the view's height
MOST = 2000  # objects that are looked at
# Places to try: across the picture and up, from -1 to 1; and distances, relative to the middle.
SHAPES_AT = (0, 0), (0.4, 0), (-0.4, 0), (0, 0.4), (0, -0.4), (0.4, 0.4), (-0.4, 0.4)
LIGHTS_AT = (0.4, 0.7), (-0.4, 0.7), (0, 0.4)
DISTANCES = 1.0, 0.85, 0.6, 0.3


class NewPlace(NamedTuple):
    """A point in world space, and a size across."""

    at: tuple[float, float, float]
    size: float


def place_for(scene: Scene, focus: Focus, camera: Camera, is_light: bool = False) -> NewPlace:
    """Return the first place in the picture that is in no object's box, or else the nearest one."""
    corners = [object_corners(entry) for _, entry in list(scene.visible)[:MOST]]
    boxes = np.array([(c.min(axis=0), c.max(axis=0)) for c in corners]).reshape(-1, 2, 3)
    middle = float(camera.project(focus.center, (1, 1)).parameter)
    if not middle > 0:  # the scene is behind the eye, or has no middle
        middle = focus.reach / camera.distance
    high = (camera.viewport[3] - camera.viewport[2]) * float(np.linalg.norm(camera.v))
    diagonal = float(np.linalg.norm(np.ptp(focus.framed, axis=0))) if len(focus.framed) else 0.0
    for distance, (across, up) in itertools.product(
        DISTANCES, LIGHTS_AT if is_light else SHAPES_AT
    ):
        ray = camera.ray(-up / 2, across / 2, (1, 1))
        at = ray.origin + distance * middle * ray.direction
        size = OF_VIEW * high * (1.0 if camera.is_parallel else distance * middle)
        size = min(size, OF_SCENE * diagonal) or size
        away = np.linalg.norm(np.clip(at, boxes[:, 0], boxes[:, 1]) - at, axis=1)
        if (away > (0.0 if is_light else 0.55 * size)).all():
            break
    x, y, z = at.tolist()
    return NewPlace((x, y, z), size)
