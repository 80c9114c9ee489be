"""The default view, lights and colours of a scene without a camera or lights of its own."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

from .focus import object_corners
from .material import Material
from .model import DirectionalLight, SceneObject, Sphere, View

MATERIAL = Material(diffuse=(0.62, 0.62, 0.62), specular=(0.1, 0.1, 0.1), shininess=40.0)
AMBIENT = (0.1, 0.1, 0.1)
BACKGROUND = (0.021, 0.023, 0.027)  # a dark neutral, #272829 on the screen
# Bright for a lecture hall, but a white surface never exceeds 1.
LIGHTS = (
    DirectionalLight((0.5, -0.8, -0.6), (0.78, 0.77, 0.74)),  # the key, from the upper left
    DirectionalLight((-0.9, -0.1, -0.3), (0.2, 0.22, 0.26)),  # the fill, from the right
)


DIRECTION = (0.5, 0.35, 1.0)  # from the scene's centre to the eye, at its front right
FOV_Y_DEG = 35.0
MARGIN = 1.08
PLANE = 0.67  # part of the way from the eye to the scene; limits the image plane
SIDES = (5, 2, 1)  # of a viewport, times powers of ten

SMALLEST_RADIUS, LARGEST_RADIUS = 1e-6, 1e11


def framing_view(objects: Sequence[SceneObject]) -> View:
    """Return a perspective view that shows every object, fitted to any aspect ratio.

    The eye is in front of the centre of their bounds, a little to the right and above. The image
    plane is between the two, and its side is a round number. Raises LucidaError if the objects are
    too small or too large to put a camera there.
    """
    if not objects:
        return View(Camera.canonical(), fit=True)
    points = np.concatenate([_outline(entry) for entry in objects])
    low, high = points.min(axis=0), points.max(axis=0)
    center = (low + high) / 2
    points = points - center
    radius = float(np.linalg.norm(high - low)) / 2
    if not SMALLEST_RADIUS <= radius <= LARGEST_RADIUS:
        size = "small" if radius < SMALLEST_RADIUS else "large"
        raise LucidaError("", f"is too {size}, {2 * radius:g} across", "scale it")
    w = np.asarray(DIRECTION) / np.linalg.norm(DIRECTION)
    u = np.cross((0.0, 1.0, 0.0), w)
    u /= np.linalg.norm(u)
    across = np.abs(points @ np.column_stack([u, np.cross(w, u)])).max(axis=1)
    # A point at depth z in front of the eye is visible if across <= z tan(fov / 2).
    needed = points @ w + MARGIN * across / math.tan(math.radians(FOV_Y_DEG) / 2)
    away = max(float(needed.max()), 1.5 * radius)
    camera = Camera.look_at(center + away * w, center, fov_y_deg=FOV_Y_DEG)
    most = PLANE * (away - float((points @ w).max())) / camera.distance
    power = 10.0 ** math.floor(math.log10(most))
    side = next(side * power for side in SIDES if side * power <= most)
    viewport = (-side / 2, side / 2, -side / 2, side / 2)
    return View(replace(camera, distance=side * camera.distance, viewport=viewport), fit=True)


def median_distance(
    objects: Iterable[SceneObject], point: Sequence[float] | NDArray[np.float64]
) -> float:
    """Return the median distance of the objects' centres from a point; 1 without objects."""
    boxes = (_outline(entry) for entry in objects if not entry.hidden)
    middles = [(points.min(axis=0) + points.max(axis=0)) / 2 for points in boxes]
    away = np.linalg.norm(np.subtract(middles, point), axis=-1)
    return float(np.median(away)) or 1.0 if middles else 1.0


def _outline(entry: SceneObject) -> NDArray[np.float64]:
    """Return points (n, 3) in world space whose hull contains the object: vertices, or a sphere's
    box.
    """
    shape = entry.shape
    if isinstance(shape, Sphere):
        return object_corners(entry)
    return shape.vertices @ shape.transform[:3, :3].T + shape.transform[:3, 3]
