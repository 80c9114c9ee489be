"""The outline of an object as a camera sees it: where its surface turns away, and where it ends.

Pure. The part that does not depend on the camera, which triangles share an edge, is computed once
for a mesh; the rest is a sign for each triangle. A triangle faces the eye if the eye is on the
front side of its plane, as set by its winding. Many objects, and large ones, have their boxes.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.boxes import extent
from lucida.renderer.scene.model import Mesh, SceneObject, Sphere

Floats = NDArray[np.float64]
T = TypeVar("T")

MOST_TRIANGLES = 100_000  # of a mesh; one with more has a box instead
MOST_EXACT = 32  # objects; of more, each mesh has its box
CORNERS = 128  # of a sphere's ring

# A box's corners: bit k of a corner's number is set if it is high along axis k.
_HIGH = np.array([[corner >> k & 1 for k in range(3)] for corner in range(8)], bool)
_BOX = np.array([(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)])


@dataclass(frozen=True, eq=False)
class MeshEdges:
    """The edges of a mesh, in its own space.

    planes (m, 4): of the triangles, n . p + d > 0 in front. ends (n, 2, 3): of the edges. sides (n,
    2): the two triangles at each; the same one twice at a border. turned (n,): True if these two
    have opposite winding, so that the front of one is the back of the other.
    """

    planes: Floats
    ends: Floats
    sides: NDArray[np.int64]
    turned: NDArray[np.bool_]


def outlines_of(entries: Sequence[SceneObject], camera: Camera) -> Floats:
    """Return segments (n, 2, 3) in the world: the outlines of some objects, including hidden
    parts.
    """
    most = MOST_TRIANGLES if len(entries) <= MOST_EXACT else 0
    found = [outline_of(entry, camera, most) for entry in entries]
    return np.concatenate([np.zeros((0, 2, 3)), *found])


def outline_of(entry: SceneObject, camera: Camera, most: int = MOST_TRIANGLES) -> Floats:
    """Return an object's outline; the edges of its box for a mesh of more than `most` triangles."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        return _ring(shape, camera)
    linear, shift = shape.transform[:3, :3], shape.transform[:3, 3]
    if len(shape.faces) > most:
        low, high = _once(_box, shape.vertices)
        segments: Floats = np.where(_HIGH, high, low)[_BOX]
    else:
        segments = _outline(edges_of(shape), shape, camera)
    world: Floats = segments @ linear.T + shift
    return world


def edges_of(mesh: Mesh) -> MeshEdges:
    """Return the edges of a mesh, found once for its arrays, however often it is moved."""
    return _once(_edges, mesh.vertices, mesh.faces)


def _box(vertices: NDArray[Any]) -> Floats:
    return np.array(extent(vertices), float)


_found: dict[tuple[Any, ...], Any] = {}


def _once(find: Callable[..., T], *arrays: NDArray[Any]) -> T:
    """Return find(*arrays), kept as long as all the arrays exist."""
    key = find, *map(id, arrays)
    if key not in _found:
        _found[key] = find(*arrays)
        for array in arrays:
            weakref.finalize(array, _found.pop, key, None).atexit = False
    found: T = _found[key]
    return found


def _ring(sphere: Sphere, camera: Camera) -> Floats:
    """Return the circle where a sphere is seen edge on, (n, 2, 3); none from inside."""
    center, radius, back = np.asarray(sphere.center, float), sphere.radius, 0.0
    way = np.asarray(camera.w if camera.is_parallel else camera.eye - center, float)
    distance = float(np.linalg.norm(way))
    if not camera.is_parallel:
        if distance <= radius * (1 + 1e-9):
            return np.zeros((0, 2, 3))
        back = radius * radius / distance
        radius *= math.sqrt(1 - (radius / distance) ** 2)
    way /= distance
    first = np.cross(way, np.eye(3)[np.abs(way).argmin()])
    first /= np.linalg.norm(first)
    angles = np.arange(CORNERS)[:, None] * (2 * math.pi / CORNERS)
    ring = np.cos(angles) * first + np.sin(angles) * np.cross(way, first)
    ring = center + back * way + radius * ring
    return np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)


def _outline(edges: MeshEdges, mesh: Mesh, camera: Camera) -> Floats:
    # For parallel rays, the eye is the direction to it, whose last component is 0.
    eye = np.append(camera.w, 0.0) if camera.is_parallel else np.append(camera.eye, 1.0)
    front = edges.planes @ (np.linalg.inv(mesh.transform) @ eye) > 0
    first, second = edges.sides[:, 0], edges.sides[:, 1]
    seen = (front[first] != front[second]) ^ edges.turned
    return edges.ends[seen | (first == second)]


def _edges(vertices: NDArray[Any], triangles: NDArray[Any]) -> MeshEdges:
    # Vertices at one place are one: meshes have several where their normals differ.
    places, same = np.unique(vertices, axis=0, return_inverse=True)
    faces = same.reshape(-1)[triangles]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    corners = places.astype(float)[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    planes = np.column_stack([normals, -np.einsum("ij,ij->i", normals, corners[:, 0])])
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    key = np.minimum(start, end) * np.int64(len(places)) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    # Edges of three triangles and more are pairs of neighbours in this order, too.
    key, triangle, forward = key[order], order // 3, (start < end)[order]
    is_first = np.append(True, key[1:] != key[:-1])
    run = np.cumsum(is_first) - 1
    place = np.arange(len(key)) - np.flatnonzero(is_first)[run]
    has_next = np.append(~is_first[1:], False)
    # Each but the first of a run adjoins the previous one; a single one is a border.
    pair = np.flatnonzero(place > 0)
    alone = np.flatnonzero(is_first & ~has_next)
    one, other = np.append(pair - 1, alone), np.append(pair, alone)
    ends = np.stack([key[other] // len(places), key[other] % len(places)], axis=1)
    return MeshEdges(
        planes,
        places.astype(float)[ends],
        np.stack([triangle[one], triangle[other]], axis=1),
        (forward[one] == forward[other]) & (one != other),
    )
