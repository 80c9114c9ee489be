"""The outline of an object as a camera sees it: where its surface turns away, and where it ends.

Pure. Which triangles share an edge is found once for a mesh. An edge is in the outline if both of
its triangles are on the same side of the plane through it and the eye. Many objects, and large
ones, have their boxes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.boxes import extent
from lucida.renderer.scene.model import SceneObject, Sphere
from lucida.renderer.system.memo import Memo

Floats = NDArray[np.float64]

MOST_TRIANGLES = 100_000  # of a mesh; one with more has a box instead
MOST_EXACT = 32  # objects; of more, each mesh has its box
CORNERS = 128  # of a sphere's ring

# A box's corners: bit k of a corner's number is set if it is high along axis k.
_HIGH = np.array([[corner >> k & 1 for k in range(3)] for corner in range(8)], bool)
_BOX = np.array([(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)])


class MeshEdges(NamedTuple):
    """The edges of a mesh, in its own space.

    ends (n, 2, 3): of the edges of two triangles. planes (n, 2, 4): of these two, n . p + d = 0,
    with normals that turn about the edge in one sense. borders (m, 2, 3): the edges of one.
    """

    ends: Floats
    planes: Floats
    borders: Floats


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
    if len(shape.faces) > most:
        low, high = np.array(extent(shape.vertices), float)
        segments: Floats = np.where(_HIGH, high, low)[_BOX]
    else:
        # For parallel rays, the eye is the direction to it, whose last component is 0.
        eye = np.append(camera.w, 0.0) if camera.is_parallel else np.append(camera.eye, 1.0)
        segments = _outline(
            edges_of(shape.vertices, shape.faces), np.linalg.inv(shape.transform) @ eye
        )
    world: Floats = segments @ shape.transform[:3, :3].T + shape.transform[:3, 3]
    return world


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


def _outline(edges: MeshEdges, eye: Floats) -> Floats:
    front = edges.planes @ eye > 0
    return np.concatenate([edges.borders, edges.ends[front[:, 0] == front[:, 1]]])


def _edges(vertices: NDArray[Any], faces: NDArray[Any]) -> MeshEdges:
    # Vertices at one place are one: meshes have several where their normals differ.
    mesh = trimesh.Trimesh(vertices.astype(float), faces, process=True)
    ends = mesh.vertices[mesh.face_adjacency_edges]
    start, end = ends[:, :1], ends[:, 1:]
    normals = np.cross(end - start, mesh.vertices[mesh.face_adjacency_unshared] - start)
    planes = np.concatenate([normals, -(normals * start).sum(axis=2, keepdims=True)], axis=2)
    alone = trimesh.grouping.group_rows(mesh.edges_sorted, require_count=1)  # type: ignore[no-untyped-call]
    return MeshEdges(ends, planes, mesh.vertices[mesh.edges_sorted[alone]])


edges_of = Memo(_edges, MOST_EXACT)
