"""The outline of an object as a camera sees it: where its surface turns away, and where it ends.

Pure. The part that does not depend on the camera, which triangles share an edge, is computed once
for a mesh; the rest is a sign for each triangle. A triangle faces the eye if the eye is on the
front side of its plane, as set by its winding. If there are many objects, their boxes are outlined.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.scene.boxes import extent
from renderer.scene.model import Mesh, SceneObject, Sphere

Floats = NDArray[np.float64]
T = TypeVar("T")

MOST_TRIANGLES = 100_000  # of a mesh; one with more has a box instead
MOST_EXACT = 32  # objects; of more, each has its box's outline
CORNERS, FEW_CORNERS = 128, 24  # of a sphere's ring: alone, and among many

# A box's corners: bit k of a corner's number says whether it is high along axis k. Its faces: 2 k
# is where axis k is low, 2 k + 1 where it is high.
_HIGH = np.array([[corner >> k & 1 for k in range(3)] for corner in range(8)], bool)
_BOX = np.array([(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)])
_SIDES = np.array(
    [[2 * k + (a >> k & 1) for k in range(3) if not (a ^ b) >> k & 1] for a, b in _BOX]
)


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
    if len(entries) <= MOST_EXACT:
        found = [outline_of(entry, camera) for entry in entries]
    else:
        shapes = [entry.shape for entry in entries]
        found = [
            _rings([shape for shape in shapes if isinstance(shape, Sphere)], camera, FEW_CORNERS),
            _boxes([shape for shape in shapes if isinstance(shape, Mesh)], camera),
        ]
    return np.concatenate([np.zeros((0, 2, 3)), *found])


def outline_of(entry: SceneObject, camera: Camera) -> Floats:
    """Return an object's outline; that of its box for a mesh with too many triangles."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        return _rings([shape], camera, CORNERS)
    linear, shift = shape.transform[:3, :3], shape.transform[:3, 3]
    if len(shape.faces) > MOST_TRIANGLES:
        low, high = _own_box(shape)
        segments: Floats = np.where(_HIGH, high, low)[_BOX]
    else:
        segments = _outline(edges_of(shape), shape, camera)
    world: Floats = segments @ linear.T + shift
    return world


def edges_of(mesh: Mesh) -> MeshEdges:
    """Return the edges of a mesh, found once for its arrays, however often it is moved."""
    return _once(_edges, mesh.vertices, mesh.faces)


def _own_box(mesh: Mesh) -> Floats:
    """Return the lowest and highest corner (2, 3) in the mesh's own space."""
    return _once(_box, mesh.vertices)


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


def _rings(spheres: Sequence[Sphere], camera: Camera, corners: int) -> Floats:
    """Return the outlines of spheres; none from inside a sphere."""
    centers = np.array([sphere.center for sphere in spheres], float).reshape(-1, 3)
    radii = np.array([sphere.radius for sphere in spheres], float)
    rings = contours(centers, radii, camera, corners)
    return np.stack([rings, np.roll(rings, -1, axis=1)], axis=2).reshape(-1, 2, 3)


def contours(centers: Floats, radii: Floats, camera: Camera, corners: int) -> Floats:
    """Return the circles on spheres where they are seen edge on, (m, corners, 3), without spheres
    that the eye is inside of.

    centers: (n, 3). radii: (n,).
    """
    if camera.is_parallel:
        way = np.broadcast_to(np.asarray(camera.w, float), centers.shape)
        way, back = way / np.linalg.norm(camera.w), np.zeros(len(radii))
    else:
        way = np.asarray(camera.eye, float) - centers
        distance = np.linalg.norm(way, axis=1)
        outside = distance > radii * (1 + 1e-9)
        centers, radii, way, distance = (part[outside] for part in (centers, radii, way, distance))
        way, back = way / distance[:, None], radii * (radii / distance)
        radii = radii * np.sqrt(1 - (radii / distance) ** 2)
    helper = np.eye(3)[np.abs(way).argmin(axis=1)]
    first = np.cross(way, helper)
    first = first / np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(way, first)
    angles = np.arange(corners) * (2 * math.pi / corners)
    ring = np.cos(angles)[:, None] * first[:, None] + np.sin(angles)[:, None] * second[:, None]
    found: Floats = (centers + back[:, None] * way)[:, None] + radii[:, None, None] * ring
    return found


def _boxes(meshes: Sequence[Mesh], camera: Camera) -> Floats:
    """Return the outlines of the boxes around meshes, rotated with them."""
    if not meshes:
        return np.zeros((0, 2, 3))
    transforms: Floats = np.array([mesh.transform for mesh in meshes])
    own = np.array([_own_box(mesh) for mesh in meshes])
    corners = np.where(_HIGH, own[:, 1, None], own[:, 0, None])
    world = corners @ transforms[:, :3, :3].swapaxes(1, 2) + transforms[:, None, :3, 3]
    viewers = _viewer(np.asarray(np.linalg.inv(transforms), float), camera)
    place, weight = viewers[:, :3], viewers[:, 3:]
    front = np.stack([place < own[:, 0] * weight, place > own[:, 1] * weight], axis=2)
    sides = front.reshape(-1, 6)[:, _SIDES]
    turns = sides[..., 0] != sides[..., 1]
    found: Floats = world[:, _BOX][turns]
    return found


def _viewer(from_world: Floats, camera: Camera) -> Floats:
    """Return the eye, (..., 4), in the spaces of matrices (..., 4, 4). For parallel rays, return
    the direction to it, whose last component is 0.
    """
    there = np.append(camera.w, 0.0) if camera.is_parallel else np.append(camera.eye, 1.0)
    found: Floats = from_world @ there
    return found


def _outline(edges: MeshEdges, mesh: Mesh, camera: Camera) -> Floats:
    from_world = np.asarray(np.linalg.inv(mesh.transform), float)
    front = edges.planes @ _viewer(from_world, camera) > 0
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
