"""What a scene is about: a point to turn around, and how far things reach.

Pure; knows nothing of windows. A floor or a sky counts as one object among others, however large.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from renderer.camera import Vector
from renderer.scene.model import Scene, SceneObject, Sphere


@dataclass(frozen=True)
class Focus:
    """center: world space. reach: how far numbers of the eye sensibly go, world units."""

    center: Vector = (0.0, 0.0, 0.0)
    reach: float = 2.0


def scene_focus(scene: Scene) -> Focus:
    """The median of the objects' centres, and half again the scene's own eye or extent."""
    if not scene.objects:
        return Focus()
    balls = [_ball(entry) for entry in scene.objects]
    center = np.median([middle for middle, _ in balls], axis=0)
    extents = [float(np.linalg.norm(middle - center)) + radius for middle, radius in balls]
    reach = 1.5 * max(float(np.median(extents)), *(abs(x) for x in scene.view.camera.eye))
    x, y, z = center.tolist()
    return Focus((x, y, z), float(f"{reach:.2g}"))


def _ball(entry: SceneObject) -> tuple[np.ndarray, float]:
    """A ball round an object."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        return np.asarray(shape.center, float), shape.radius
    low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
    linear, offset = shape.transform[:3, :3], shape.transform[:3, 3]
    half = np.abs(linear) @ ((high - low) / 2)
    return linear @ ((low + high) / 2) + offset, float(np.linalg.norm(half))
