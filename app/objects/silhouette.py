"""The line round an object as a camera sees it: where its surface turns away, and where it ends.

Pure. What does not depend on the camera, which triangles share an edge, is found once for a mesh;
what does is a sign for each triangle. A triangle is turned towards the eye where the eye is on the
side of its plane that its winding names front.
"""

from __future__ import annotations

import weakref
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import polyline
from app.outside.outlines import contour
from renderer.camera import Camera
from renderer.scene.boxes import extent
from renderer.scene.model import Mesh, SceneObject, Sphere

Floats = NDArray[np.float64]

MOST_TRIANGLES = 100_000  # of a mesh; one with more has a box instead

_BOX = [(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)]


@dataclass(frozen=True, eq=False)
class MeshEdges:
    """Of one mesh, in its own space. planes (m, 4): of the triangles, n . p + d > 0 in front.
    ends (n, 2, 3): of the edges. sides (n, 2): the two triangles at each; twice the same at a
    border. turned (n,): whether these two are wound against each other, so that the front of the
    one is the back of the other."""

    planes: Floats
    ends: Floats
    sides: NDArray[np.int64]
    turned: NDArray[np.bool_]


_by_faces: dict[int, tuple[weakref.ref, MeshEdges]] = {}


def outline_of(entry: SceneObject, camera: Camera) -> Floats:
    """Segments (n, 2, 3) in the world: an object's outline, hidden parts too; a box round a mesh of
    too many triangles."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        return _round(shape, camera)
    linear, shift = shape.transform[:3, :3], shape.transform[:3, 3]
    if len(shape.faces) > MOST_TRIANGLES:
        low, high = (corner.astype(float) for corner in extent(shape.vertices))
        corners = np.array([np.where([k & 1, k & 2, k & 4], high, low) for k in range(8)])
        segments = corners[_BOX]
    else:
        segments = _outline(edges_of(shape), shape, camera)
    world: Floats = segments @ linear.T + shift
    return world


def edges_of(mesh: Mesh) -> MeshEdges:
    """Found once for the arrays of a mesh, however often that is moved."""
    kept = _by_faces.get(id(mesh.faces))
    if kept is not None and kept[0]() is mesh.faces:
        return kept[1]
    found, key = _edges(mesh), id(mesh.faces)
    _by_faces[key] = weakref.ref(mesh.faces, lambda _: _by_faces.pop(key, None)), found
    return found


def _outline(edges: MeshEdges, mesh: Mesh, camera: Camera) -> Floats:
    from_world = np.linalg.inv(mesh.transform)
    if camera.is_parallel:
        viewer = np.append(from_world[:3, :3] @ camera.w, 0.0)
    else:
        viewer = from_world @ np.append(camera.eye, 1.0)
    front = edges.planes @ viewer > 0
    first, second = edges.sides[:, 0], edges.sides[:, 1]
    seen = (front[first] != front[second]) ^ edges.turned
    return edges.ends[seen | (first == second)]


def _edges(mesh: Mesh) -> MeshEdges:
    # Vertices at one place are one: meshes have several where their normals differ.
    places, same = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = same.reshape(-1)[mesh.faces]
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
    # Each but the first of a run meets the one before; who is alone is a border.
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


def _round(sphere: Sphere, camera: Camera) -> Floats:
    """Nothing from inside."""
    ring = contour(sphere, camera)
    return np.zeros((0, 2, 3)) if ring is None else polyline(ring, closed=True)
