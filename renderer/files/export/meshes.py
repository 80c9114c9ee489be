"""Convert triangles to glTF's form.

In glTF, a mesh has normals at all its vertices or at none, and its triangles wind about their
normals. In Lucida some triangles may be flat, and any winding is allowed.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import OTHER_SIDE
from lucida.renderer.scene.model import Mesh, Shape, Sphere
from lucida.renderer.scene.normals import face_normals

SPHERE_SUBDIVISIONS = 5
F32 = NDArray[np.float32]


class Triangles(NamedTuple):
    """An indexed triangle mesh, about the origin of its own space, with the world's axes.

    vertices (n, 3), faces (m, 3), and per vertex, or None: normals (n, 3), unit length; colors (n,
    3), linear; uv (n, 2).
    """

    vertices: F32
    faces: NDArray[np.int32]
    normals: F32 | None = None
    colors: F32 | None = None
    uv: F32 | None = None


def exported_triangles(shape: Shape, turns: bool) -> Triangles:
    """Return a shape's triangles, which wind about their normals.

    turns: False to keep the winding, which then determines the visible side.
    """
    if isinstance(shape, Sphere):
        ball = trimesh.creation.icosphere(SPHERE_SUBDIVISIONS)
        points = ball.vertices.astype(np.float32)
        return Triangles(points * np.float32(shape.radius), ball.faces, points)
    linear = shape.transform[:3, :3]
    vertices = (shape.vertices @ linear.T).astype(np.float32)
    faces = shape.faces[:, ::-1] if np.linalg.det(linear) < 0 else shape.faces
    if shape.normals is None:
        return Triangles(vertices, faces, None, shape.colors, shape.uv)
    return _wound(shape, vertices, faces, _unit(shape.normals @ np.linalg.inv(linear)), turns)


def _wound(shape: Mesh, vertices: F32, faces: Any, normals: Any, turns: bool) -> Triangles:
    outward = _unit(face_normals(vertices, faces.astype(np.int64)))
    is_flat = (normals[faces] == 0).all(axis=2).any(axis=1)
    sums = normals[faces].sum(axis=1)
    turned = (np.einsum("ij,ij->i", sums, outward) < OTHER_SIDE) & ~is_flat & turns
    faces = np.where(turned[:, None], faces[:, ::-1], faces)
    found = Triangles(vertices, faces, normals.astype(np.float32), shape.colors, shape.uv)
    if not is_flat.any():
        return found
    corners = faces.reshape(-1)  # each triangle gets its own three vertices
    flat = np.repeat(is_flat, 3)[:, None]
    own_normals = np.where(flat, np.repeat(outward, 3, axis=0), normals[corners])
    colors, uv = (None if a is None else a[corners] for a in (shape.colors, shape.uv))
    own = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return Triangles(vertices[corners], own, own_normals.astype(np.float32), colors, uv)


def _unit(vectors: NDArray[Any]) -> NDArray[np.float64]:
    """Return vectors at unit length; 0 stays 0."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: NDArray[np.float64] = vectors / np.maximum(lengths, 1e-300)
    return unit
