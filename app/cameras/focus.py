"""The subject of a scene: a point to turn around, the reach of things, and what to frame.

Pure. A floor or a sky is not framed: it is there for the other things.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Vector
from renderer.scene.boxes import extent
from renderer.scene.model import Scene, SceneObject, Sphere

Points = NDArray[np.float64]

SURROUNDING = 3.0  # times the usual object's size: what is larger, and holds the rest, is a floor


def _nothing() -> Points:
    return np.zeros((0, 3))


@dataclass(frozen=True)
class Focus:
    """center: world space. reach: how far numbers of the eye sensibly go from there, world units.

    framed: corners (n, 3) of what a picture of the scene must hold. bounds: the 8 corners of a
    box round everything. World space; both empty in an empty scene.
    """

    center: Vector = (0.0, 0.0, 0.0)
    reach: float = 2.0
    framed: Points = field(default_factory=_nothing, compare=False)
    bounds: Points = field(default_factory=_nothing, compare=False)


def scene_focus(scene: Scene) -> Focus:
    """The median of the objects' centres, and half again the scene's own eye or extent."""
    seen = [entry for _, entry in scene.visible]
    if not seen:
        return Focus()
    corners = [object_corners(entry) for entry in seen]
    balls = [_ball(entry, box) for entry, box in zip(seen, corners, strict=True)]
    center = _median(np.array([middle for middle, _ in balls]))
    extents = [float(np.linalg.norm(middle - center)) + radius for middle, radius in balls]
    eye = np.abs(np.asarray(scene.view.camera.eye) - center).max()
    reach = 1.5 * max(float(_median(np.array(extents))), float(eye))
    x, y, z = center.tolist()
    everything = np.concatenate(corners)
    return Focus(
        (x, y, z),
        float(f"{reach:.2g}"),
        np.concatenate([corners[k] for k in _things([radius for _, radius in balls], corners)]),
        _box(everything.min(axis=0), everything.max(axis=0)),
    )


def object_corners(entry: SceneObject) -> Points:
    """The corners (8, 3) of a box round an object, in world space; a mesh's lies as it does."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        center = np.asarray(shape.center, float)
        return _box(center - shape.radius, center + shape.radius)
    box = _box(*extent(shape.vertices))
    return box @ shape.transform[:3, :3].T + shape.transform[:3, 3]


def _things(radii: list[float], corners: list[Points]) -> list[int]:
    """The indices of the objects that are no floor, ground or sky; all, if there is no other."""
    usual = sorted(radii)[(len(radii) - 1) // 2]
    kept = [k for k, radius in enumerate(radii) if radius <= SURROUNDING * usual]
    rest = np.concatenate([corners[k] for k in kept])
    size = float(np.linalg.norm(rest.max(axis=0) - rest.min(axis=0))) / 2
    return [k for k, radius in enumerate(radii) if k in set(kept) or radius < size]


def _median(values: Points) -> NDArray[np.float64]:
    """Along the first axis. NumPy's own takes as long as a frame at its first call: it imports its
    masked arrays."""
    ordered = np.sort(values, axis=0)
    middle: NDArray[np.float64] = ordered[(len(ordered) - 1) // 2 : len(ordered) // 2 + 1]
    return middle.mean(axis=0)


def _ball(entry: SceneObject, corners: Points) -> tuple[Points, float]:
    """A ball round an object."""
    if isinstance(entry.shape, Sphere):
        return np.asarray(entry.shape.center, float), entry.shape.radius
    low, high = corners.min(axis=0), corners.max(axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low)) / 2


def _box(low: NDArray[np.floating], high: NDArray[np.floating]) -> Points:
    return np.array(list(product(*zip(low.tolist(), high.tolist(), strict=True))), float)
