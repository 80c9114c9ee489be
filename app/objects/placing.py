"""A place and a size for a new object or light: in sight, in no other object, sized to the scene.

Pure.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.focus import Focus, object_corners
from renderer.scene.model import Scene

Floats = NDArray[np.float64]

OF_SCENE, OF_VIEW = 0.16, 0.3  # a new object's size: of the scene's diagonal, of the view's height
MARGIN = 0.03  # of the picture, on each side
MOST = 2000  # objects that are looked at
# Where it is tried: across the picture and up, from -1 to 1; and how far, relative to the middle.
SHAPES_AT = ((0, 0), (0.4, 0), (-0.4, 0), (0, 0.4), (0.4, 0.4), (-0.4, 0.4), (0, -0.4), (0.65, 0),
             (-0.65, 0), (0.65, 0.6), (-0.65, 0.6), (0.65, -0.5), (-0.65, -0.5))  # fmt: skip
LIGHTS_AT = ((0.4, 0.7), (-0.4, 0.7), (0, 0.75), (0.7, 0.5), (-0.7, 0.5), (0, 0.4), (0, 0))
CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
FARNESS = (1.0, 0.85, 0.7, 0.55, 0.4, 0.25, 1.2)


class NewPlace(NamedTuple):
    """A point in world space, and a size across."""

    at: tuple[float, float, float]
    size: float


def place_for(
    scene: Scene, focus: Focus, cameras: Sequence[Camera], is_light: bool = False
) -> NewPlace:
    """Return the place that meets most: it is seen by the cameras, the first of which counts for
    its size, nothing is in front of it, and it is in no object's box.
    """
    camera, boxes = cameras[0], _boxes(scene)
    middle = float(camera.project(focus.center, (1, 1)).parameter)
    if not middle > 0:  # the scene is behind the eye, or has no middle
        middle = focus.reach / camera.distance
    best, most = NewPlace(focus.center, 1.0), -1.0
    for far in FARNESS:
        for place in LIGHTS_AT if is_light else SHAPES_AT:
            found = _candidate(cameras, focus, place, far * middle)
            radius = 0.0 if is_light else found.size / 2
            seen = sum(_sees(one, np.array(found.at), radius, boxes) for one in cameras)
            score = seen + _is_free(np.array(found.at), radius, boxes)
            if score > most:
                best, most = found, score
    return best


def _candidate(
    cameras: Sequence[Camera], focus: Focus, place: tuple[float, float], parameter: float
) -> NewPlace:
    ray = cameras[0].ray(-place[1] / 2, place[0] / 2, (1, 1))
    at = ray.origin + parameter * ray.direction
    sizes = [OF_VIEW * _height(camera, at) for camera in cameras]
    if len(focus.framed):
        sizes.append(OF_SCENE * float(np.linalg.norm(np.ptp(focus.framed, axis=0))))
    x, y, z = at.tolist()
    return NewPlace((x, y, z), min(size for size in sizes if size > 0))


def _height(camera: Camera, at: Floats) -> float:
    """Return the height of a camera's picture as far away as a point, in world units."""
    high = (camera.viewport[3] - camera.viewport[2]) * float(np.linalg.norm(camera.v))
    return high if camera.is_parallel else high * float(camera.project(at, (1, 1)).parameter)


def _boxes(scene: Scene) -> Floats:
    """Return the boxes (n, 2, 3) of the visible objects."""
    corners = [object_corners(entry) for _, entry in list(scene.visible)[:MOST]]
    return np.array([(c.min(axis=0), c.max(axis=0)) for c in corners]).reshape(-1, 2, 3)


def _is_free(at: Floats, radius: float, boxes: Floats) -> bool:
    """Return True if a ball touches no box, except for those around everything."""
    nearest = np.clip(at, boxes[:, 0], boxes[:, 1])
    away = np.linalg.norm(nearest - at, axis=1)
    return bool((away > radius).all())


def _sees(camera: Camera, at: Floats, radius: float, boxes: Floats) -> bool:
    """Return True if a ball is inside the camera's picture, and no box is before its middle."""
    around = camera.project(at + radius * CORNERS, (1, 1))
    inside = np.abs([around.row, around.column]) <= 0.5 - MARGIN
    if not ((around.parameter > 0).all() and inside.all()):
        return False
    seen = camera.project(at, (1, 1))
    origin = camera.ray(float(seen.row), float(seen.column), (1, 1)).origin
    way = at - origin
    with np.errstate(all="ignore"):
        ends = (boxes - origin) / way
    near, far = np.nanmin(ends, axis=1, initial=np.inf), np.nanmax(ends, axis=1, initial=-np.inf)
    first, last = near.max(axis=1, initial=-np.inf), far.min(axis=1, initial=np.inf)
    return not bool(((first <= last) & (first > 0) & (first < 1)).any())
