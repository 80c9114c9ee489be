"""The first hit of a single ray, computed with NumPy. It agrees with the images."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from renderer.scene.model import Mesh, Scene, Sphere

Floats = NDArray[np.float64]

MOST_OBJECTS, MOST_TRIANGLES = 100, 20_000  # one to two milliseconds


def object_on_ray(scene: Scene, origin: Floats, direction: Floats) -> int | None:
    """Return the index of the nearest object on r(t) = origin + t direction, t > 0; None if there
    is none.
    """
    return nearest_hit(scene, origin, direction)[1]


def nearest_hit(scene: Scene, origin: Floats, direction: Floats) -> tuple[float, int | None]:
    """Return the smallest t > 0 at which r(t) = origin + t direction hits an object, and its index;
    infinity and None if nothing is hit. Both sides of triangles count.
    """
    nearest, number = math.inf, None
    for k, entry in scene.visible:
        shape = entry.shape
        meet = _sphere if isinstance(shape, Sphere) else _mesh
        t = meet(shape, origin, direction)  # type: ignore[arg-type]
        if t < nearest:
            nearest, number = t, k
    return nearest, number


def is_quick(scene: Scene) -> bool:
    """Return True if nearest_hit() takes only a small part of a frame."""
    if len(scene.objects) > MOST_OBJECTS:
        return False
    meshes = (entry.shape for _, entry in scene.visible if isinstance(entry.shape, Mesh))
    return sum(len(mesh.faces) for mesh in meshes) <= MOST_TRIANGLES


def _sphere(sphere: Sphere, origin: Floats, direction: Floats) -> float:
    """Return the smallest t > 0 at which the ray hits the sphere; infinity if there is none."""
    offset = np.asarray(sphere.center) - origin
    a = float(direction @ direction)
    middle = float(direction @ offset) / a
    away = offset - middle * direction  # from the ray's nearest point to the centre
    inside = (sphere.radius**2 - float(away @ away)) / a
    if inside < 0:
        return math.inf
    half = math.sqrt(inside)
    return next((t for t in (middle - half, middle + half) if t > 0), math.inf)


def _mesh(mesh: Mesh, origin: Floats, direction: Floats) -> float:
    """Return the same for triangles. Source: Möller and Trumbore 1997, all triangles at once."""
    from_world = np.linalg.inv(mesh.transform)
    start = from_world[:3, :3] @ origin + from_world[:3, 3]
    way = from_world[:3, :3] @ direction
    with np.errstate(all="ignore"):
        if not _box(mesh, start, way):
            return math.inf
        first, second, third = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
        one, two = second - first, third - first
        across = np.cross(way, two)
        volume = np.einsum("ij,ij->i", one, across)
        to_start = start - first
        b1 = np.einsum("ij,ij->i", to_start, across) / volume
        other = np.cross(to_start, one)
        b2 = other @ way / volume
        t = np.einsum("ij,ij->i", two, other) / volume
        meets = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1) & (t > 0)
    return float(t[meets].min(initial=math.inf))


def _box(mesh: Mesh, start: Floats, way: Floats) -> bool:
    """Return True if the ray, in object space, meets the mesh's bounds (slabs; Kay and Kajiya
    1986).
    """
    low, high = mesh.vertices.min(axis=0) - start, mesh.vertices.max(axis=0) - start
    margin = 1e-6 * float(np.abs(high - low).max())
    sides = np.stack([low - margin, high + margin]) / way
    return bool(np.nanmax(sides.min(axis=0)) <= np.nanmin(sides.max(axis=0)))
