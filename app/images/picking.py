"""The first hits of a ray, computed with NumPy. They agree with the images."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.scene.model import Mesh, Scene, Sphere


def object_on_ray(scene: Scene, origin: Floats, direction: Floats) -> int | None:
    """Return the index of the nearest object on r(t) = origin + t direction, t > 0; None if there
    is none, or if the direction is NaN (outside a lens). Both sides of triangles count.
    """
    hits = [(t, k) for k, t in _by_object(scene, origin, direction) if math.isfinite(t)]
    return min(hits, default=(math.inf, None))[1]


def line_meetings(scene: Scene, origin: Floats, direction: Floats) -> tuple[float, ...]:
    """Return the t at which r(t) = origin + t direction hits objects: for each object, the nearest
    hit ahead and the nearest one behind.
    """
    found = {way * t for way in (1, -1) for _, t in _by_object(scene, origin, way * direction)}
    return tuple(sorted(filter(math.isfinite, found)))


def _by_object(scene: Scene, origin: Floats, direction: Floats) -> Iterator[tuple[int, float]]:
    """Yield the index of each visible object, and the t of its hit, infinity for none."""
    with np.errstate(all="ignore"):
        for k, entry in scene.visible if np.isfinite(direction).all() else ():
            shape = entry.shape
            meet = _sphere if isinstance(shape, Sphere) else _mesh
            yield k, meet(shape, origin, direction)  # type: ignore[arg-type]


def _sphere(sphere: Sphere, origin: Floats, direction: Floats) -> float:
    """Return the smallest t > 0 at which the ray hits the sphere; infinity if there is none."""
    offset, a = np.asarray(sphere.center) - origin, direction @ direction
    middle = direction @ offset / a
    away = offset - middle * direction  # from the ray's nearest point to the centre
    half = np.sqrt((sphere.radius**2 - away @ away) / a)  # NaN if the sphere is missed
    return min((float(t) for t in (middle - half, middle + half) if t > 0), default=math.inf)


def _mesh(mesh: Mesh, origin: Floats, direction: Floats) -> float:
    """Return the same for a mesh. Source: Möller and Trumbore 1997, for all triangles at once."""
    from_world = np.linalg.inv(mesh.transform)
    start, way = from_world[:3, :3] @ origin + from_world[:3, 3], from_world[:3, :3] @ direction
    low, high = mesh.vertices.min(axis=0) - start, mesh.vertices.max(axis=0) - start
    margin = 1e-6 * float(np.abs(high - low).max())
    sides = np.stack([low - margin, high + margin]) / way  # slabs; Kay and Kajiya 1986
    if not np.nanmax(sides.min(axis=0)) <= np.nanmin(sides.max(axis=0)):
        return math.inf
    first, second, third = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
    one, two, to_start = second - first, third - first, start - first
    other = np.cross(to_start, one)
    volume = np.cross(two, one) @ way
    b1, b2 = np.cross(two, to_start) @ way / volume, other @ way / volume
    t = np.einsum("ij,ij->i", two, other) / volume
    meets = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1) & (t > 0)
    return float(t[meets].min(initial=math.inf))
