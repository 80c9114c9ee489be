"""The first hits of a few rays, computed with NumPy. They agree with the images."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Floats
from lucida.renderer.scene.model import Mesh, Scene, Sphere

MOST_OBJECTS, MOST_TRIANGLES = 100, 20_000  # one to two milliseconds


def object_on_ray(scene: Scene, origin: Floats, direction: Floats) -> int | None:
    """Return the index of the nearest object on r(t) = origin + t direction, t > 0; None if there
    is none, or no direction: outside of a lens.
    """
    if not np.isfinite(direction).all():
        return None
    return nearest_hit(scene, origin, direction)[1]


def nearest_hit(scene: Scene, origin: Floats, direction: Floats) -> tuple[float, int | None]:
    """Return the smallest t > 0 at which r(t) = origin + t direction hits an object, and its index;
    infinity and None if nothing is hit, or the direction is NaN (outside of a lens). Both sides of
    triangles count.
    """
    if not np.isfinite(direction).all():
        return math.inf, None
    t, numbers = nearest_hits(scene, origin, np.asarray(direction, float)[None])
    return float(t[0]), int(numbers[0]) if np.isfinite(t[0]) else None


def nearest_hits(
    scene: Scene, origin: Floats, directions: Floats
) -> tuple[Floats, NDArray[np.int64]]:
    """Return nearest_hit() of rays from one origin: t (n,) and indices (n,), -1 for no hit."""
    nearest = np.full(len(directions), math.inf)
    numbers = np.full(len(directions), -1)
    for k, t in _by_object(scene, origin, directions):
        closer = t < nearest
        nearest[closer], numbers[closer] = t[closer], k
    return nearest, numbers


def line_meetings(scene: Scene, origin: Floats, direction: Floats) -> tuple[float, ...]:
    """Return the t at which r(t) = origin + t direction meets objects, of each the nearest one
    ahead, and the nearest one behind.
    """
    found = set()
    for way in (1.0, -1.0):
        ways = way * np.asarray(direction, float)[None]
        found |= {way * float(t[0]) for _, t in _by_object(scene, origin, ways)}
    return tuple(sorted(t for t in found if math.isfinite(t)))


def _by_object(scene: Scene, origin: Floats, directions: Floats) -> Iterator[tuple[int, Floats]]:
    """Yield the index of each visible object, and the t of its hits, infinity for none."""
    for k, entry in scene.visible:
        shape = entry.shape
        meet = _sphere if isinstance(shape, Sphere) else _mesh
        yield k, meet(shape, origin, directions)  # type: ignore[arg-type]


def is_quick(scene: Scene) -> bool:
    """Return True if nearest_hit() takes only a small part of a frame."""
    if len(scene.objects) > MOST_OBJECTS:
        return False
    meshes = (entry.shape for _, entry in scene.visible if isinstance(entry.shape, Mesh))
    return sum(len(mesh.faces) for mesh in meshes) <= MOST_TRIANGLES


def _sphere(sphere: Sphere, origin: Floats, directions: Floats) -> Floats:
    """Return the smallest t > 0 at which each ray hits the sphere; infinity if there is none."""
    offset = np.asarray(sphere.center) - origin
    a = np.einsum("ij,ij->i", directions, directions)
    middle = directions @ offset / a
    away = offset - middle[:, None] * directions  # from the ray's nearest point to the centre
    inside = (sphere.radius**2 - np.einsum("ij,ij->i", away, away)) / a
    half = np.sqrt(np.maximum(inside, 0.0))
    t = np.where(middle - half > 0, middle - half, middle + half)
    return np.where((inside >= 0) & (t > 0), t, math.inf)


def _mesh(mesh: Mesh, origin: Floats, directions: Floats) -> Floats:
    """Return the same for triangles. Source: Möller and Trumbore 1997, all triangles at once."""
    from_world = np.linalg.inv(mesh.transform)
    start = from_world[:3, :3] @ origin + from_world[:3, 3]
    ways = directions @ from_world[:3, :3].T
    nearest = np.full(len(ways), math.inf)
    with np.errstate(all="ignore"):
        near = _box(mesh, start, ways)
        if not near.any():
            return nearest
        first, second, third = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
        one, two, to_start = second - first, third - first, start - first
        # Triple products, with the direction last: a product of matrices.
        volume = ways[near] @ np.cross(two, one).T
        other = np.cross(to_start, one)
        b1 = ways[near] @ np.cross(two, to_start).T / volume
        b2 = ways[near] @ other.T / volume
        t = np.einsum("ij,ij->i", two, other) / volume
        meets = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1) & (t > 0)
        nearest[near] = np.where(meets, t, math.inf).min(axis=1, initial=math.inf)
    return nearest


def _box(mesh: Mesh, start: Floats, ways: Floats) -> NDArray[np.bool_]:
    """Return whether each ray, in object space, meets the mesh's bounds (slabs; Kay and Kajiya
    1986).
    """
    low, high = mesh.vertices.min(axis=0) - start, mesh.vertices.max(axis=0) - start
    margin = 1e-6 * float(np.abs(high - low).max())
    sides = np.stack([low - margin, high + margin])[:, None] / ways
    found: NDArray[np.bool_] = np.nanmax(sides.min(axis=0), 1) <= np.nanmin(sides.max(axis=0), 1)
    return found
