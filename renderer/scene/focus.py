"""The subject of a scene: a point to orbit, its reach, and the objects to frame.

Pure. A floor or a sky is background, and not framed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Vector

from .boxes import corners_of, extent
from .model import Scene, SceneObject, Sphere

Points = NDArray[np.float64]

SURROUNDING = 3.0  # times the median object's size; a larger one around the rest is a floor


def _nothing() -> Points:
    return np.zeros((0, 3))


@dataclass(frozen=True)
class Focus:
    """The subject of a scene.

    center: world space.
    reach: a sensible distance of the eye from it, world units.
    framed: corners (n, 3) that a picture of the scene must contain.
    bounds: the 8 corners of a box around everything. Both are in world space, and empty in an empty
    scene.
    """

    center: Vector = (0.0, 0.0, 0.0)
    reach: float = 2.0
    framed: Points = field(default_factory=_nothing, compare=False, repr=False)
    bounds: Points = field(default_factory=_nothing, compare=False, repr=False)


def scene_focus(scene: Scene) -> Focus:
    """Return the subject of a scene. Its centre is the median of the objects' centres; its reach is
    1.5 times the larger of the scene's own eye distance and its extent.
    """
    seen = [entry for _, entry in scene.visible]
    if not seen:
        return Focus()
    corners = [object_corners(entry) for entry in seen]
    balls = [_ball(entry, box) for entry, box in zip(seen, corners, strict=True)]
    center: Points = np.median([middle for middle, _ in balls], axis=0)
    extents = [float(np.linalg.norm(middle - center)) + radius for middle, radius in balls]
    eye = np.abs(np.asarray(scene.view.camera.eye) - center).max()
    reach = 1.5 * max(float(np.median(extents)), float(eye))
    x, y, z = center.tolist()
    everything = np.concatenate(corners)
    return Focus(
        (x, y, z),
        float(f"{reach:.2g}"),
        np.concatenate([corners[k] for k in _things([radius for _, radius in balls], corners)]),
        corners_of(np.array([everything.min(axis=0), everything.max(axis=0)])),
    )


def object_corners(entry: SceneObject) -> Points:
    """Return the corners (8, 3) of a box around an object, in world space; a mesh's box is rotated
    with it.
    """
    shape = entry.shape
    if isinstance(shape, Sphere):
        center = np.asarray(shape.center, float)
        return corners_of(np.array([center - shape.radius, center + shape.radius]))
    box = corners_of(np.array(extent(shape.vertices)))
    return box @ shape.transform[:3, :3].T + shape.transform[:3, 3]


def _things(radii: list[float], corners: list[Points]) -> list[int]:
    """Return the indices of the objects that are not a floor, ground or sky, or all if none is
    left.
    """
    usual = sorted(radii)[(len(radii) - 1) // 2]
    kept = [k for k, radius in enumerate(radii) if radius <= SURROUNDING * usual]
    rest = np.concatenate([corners[k] for k in kept])
    size = float(np.linalg.norm(rest.max(axis=0) - rest.min(axis=0))) / 2
    return [k for k, radius in enumerate(radii) if k in set(kept) or radius < size]


def _ball(entry: SceneObject, corners: Points) -> tuple[Points, float]:
    """Return a ball around an object."""
    if isinstance(entry.shape, Sphere):
        return np.asarray(entry.shape.center, float), entry.shape.radius
    low, high = corners.min(axis=0), corners.max(axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low)) / 2
