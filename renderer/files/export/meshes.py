"""Triangles as glTF needs them.

In glTF, a mesh has normals at all its vertices or at none, and its triangles wind about their
normals. In Lucida some triangles may be flat, and any winding is allowed.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import OTHER_SIDE
from lucida.renderer.scene.model import Mesh
from lucida.renderer.scene.normals import face_normals

F32 = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Triangles:
    """An indexed triangle mesh.

    vertices (n, 3), faces (m, 3), and per vertex, or None: normals (n, 3), unit length; colors (n,
    3), linear; uv (n, 2). Two are equal if they hold the very same array objects.
    """

    vertices: F32
    faces: NDArray[np.int32]
    normals: F32 | None = None
    colors: F32 | None = None
    uv: F32 | None = None

    def _arrays(self) -> tuple[int, ...]:
        return tuple(id(getattr(self, field.name)) for field in fields(self))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Triangles) and self._arrays() == other._arrays()

    def __hash__(self) -> int:
        return hash(self._arrays())

    def apart(self) -> Triangles:
        """Return the same triangles with three vertices of their own each."""
        corners = self.faces.reshape(-1)
        own = {
            name: value[corners]
            for name in ("vertices", "normals", "colors", "uv")
            if (value := getattr(self, name)) is not None
        }
        return Triangles(faces=np.arange(len(corners), dtype=np.int32).reshape(-1, 3), **own)


def arrays_of(mesh: Mesh) -> Triangles:
    """Return a mesh's arrays, unchanged."""
    return Triangles(mesh.vertices, mesh.faces, mesh.normals, mesh.colors, mesh.uv)


@functools.lru_cache(1)  # a mesh with many instances is requested each time
def wound(mesh: Triangles, turns: bool = True) -> Triangles:
    """Return triangles that wind about their normals, with normals at all vertices or at none.

    turns: False if the winding decides which side is visible, and must stay.
    """
    if mesh.normals is None:
        return mesh
    outward = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-300)
    flat = (mesh.normals[mesh.faces] == 0).all(axis=2).any(axis=1)
    sums = mesh.normals[mesh.faces].sum(axis=1)
    turned = (np.einsum("ij,ij->i", sums, outward) < OTHER_SIDE) & ~flat & turns
    found = mesh
    if turned.any():
        found = replace(found, faces=np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces))
    if flat.any():
        found = found.apart()
        assert found.normals is not None
        normals = found.normals.reshape(-1, 3, 3).copy()
        normals[flat] = outward[flat, None, :]
        found = replace(found, normals=normals.reshape(-1, 3))
    return found


def unit_sphere(rings: int) -> Triangles:
    """Return a sphere of radius 1, with twice as many segments around y as rings from pole
    to pole.
    """
    polar = np.linspace(0, np.pi, rings + 1)[:, None]
    around = np.linspace(0, 2 * np.pi, 2 * rings + 1)
    x, z = np.sin(polar) * np.cos(around), -np.sin(polar) * np.sin(around)
    y = np.broadcast_to(np.cos(polar), x.shape)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
    number = np.arange(len(points)).reshape(x.shape)
    upper, lower = number[:-1], number[1:]
    left = np.stack([upper[:, :-1], lower[:, :-1], lower[:, 1:]], axis=-1)[:-1]
    right = np.stack([upper[:, :-1], lower[:, 1:], upper[:, 1:]], axis=-1)[1:]  # none at a pole
    faces = np.concatenate([left.reshape(-1, 3), right.reshape(-1, 3)]).astype(np.int32)
    return Triangles(points, faces, points)
