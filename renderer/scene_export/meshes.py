"""Triangles as renderers elsewhere want them, and binary PLY files of them.

There a mesh has normals at all its vertices or at none, and its triangles wind about their
normals; here some may be flat, and any winding will do. Knows nothing of scenes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from renderer.camera_checks import volume
from renderer.scene.model import Color, Mesh
from renderer.scene.normals import face_normals
from renderer.shared_numbers import OTHER_SIDE

F32 = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Triangles:
    """vertices (n, 3), faces (m, 3), and for each vertex, or None: normals (n, 3), unit; colors
    (n, 3), linear; uv (n, 2)."""

    vertices: F32
    faces: NDArray[np.int32]
    normals: F32 | None = None
    colors: F32 | None = None
    uv: F32 | None = None

    def apart(self) -> Triangles:
        """The same with three vertices of its own for each triangle."""
        corners = self.faces.reshape(-1)
        own = {
            name: value[corners]
            for name in ("vertices", "normals", "colors", "uv")
            if (value := getattr(self, name)) is not None
        }
        return Triangles(faces=np.arange(len(corners), dtype=np.int32).reshape(-1, 3), **own)


def triangles(mesh: Mesh) -> Triangles:
    """A mesh in its own space, its triangles winding about its normals."""
    found = Triangles(mesh.vertices, mesh.faces, mesh.normals, mesh.colors, mesh.uv)
    if mesh.normals is None:
        return found
    outward = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-300)
    flat = (mesh.normals[mesh.faces] == 0).all(axis=2).any(axis=1)
    sums = mesh.normals[mesh.faces].sum(axis=1)
    turned = (np.einsum("ij,ij->i", sums, outward) < OTHER_SIDE) & ~flat
    if turned.any():
        found = replace(found, faces=np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces))
    if flat.any():
        found = found.apart()
        assert found.normals is not None
        normals = found.normals.reshape(-1, 3, 3).copy()
        normals[flat] = outward[flat, None, :]
        found = replace(found, normals=normals.reshape(-1, 3))
    return found


def is_mirrored(transform: NDArray[np.float64]) -> bool:
    return volume(*transform[:3, :3].T) < 0


def ply_bytes(mesh: Triangles, color: Color, mirrored: bool) -> bytes:
    """A binary PLY file. color: multiplies the vertices' own. mirrored: its place mirrors it, and
    the winding is turned for that."""
    columns: list[tuple[str, F32]] = [("x y z", mesh.vertices)]
    if mesh.normals is not None:
        columns.append(("nx ny nz", mesh.normals))
    if mesh.uv is not None:
        columns.append(("u v", mesh.uv))
    if mesh.colors is not None:
        columns.append(("r g b", mesh.colors * np.array(color, np.float32)))
    names = " ".join(name for name, _ in columns).split()
    rows = np.concatenate([values for _, values in columns], axis=1, dtype="<f4")
    faces = np.empty(len(mesh.faces), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = mesh.faces[:, ::-1] if mirrored else mesh.faces
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(rows)}",
        *(f"property float {name}" for name in names),
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    return "\n".join([*header, ""]).encode() + rows.tobytes() + faces.tobytes()


def unit_sphere(rings: int) -> Triangles:
    """A sphere of radius 1: twice as many segments around y as rings from pole to pole."""
    segments = 2 * rings
    polar = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    around = np.linspace(0, 2 * np.pi, segments, endpoint=False)
    x, z = np.sin(polar) * np.cos(around), -np.sin(polar) * np.sin(around)
    middle = np.stack([x, np.broadcast_to(np.cos(polar), x.shape), z], axis=-1).reshape(-1, 3)
    points = np.vstack([middle, (0, 1, 0), (0, -1, 0)]).astype(np.float32)
    here = np.arange(segments)
    after = (here + 1) % segments
    first = segments * np.arange(rings - 2)[:, None]
    upper, lower = first + here, first + segments + here
    upper_next, lower_next = first + after, first + segments + after
    last, top = segments * (rings - 2), segments * (rings - 1)
    faces = [
        np.stack([upper, lower, lower_next], axis=-1).reshape(-1, 3),
        np.stack([upper, lower_next, upper_next], axis=-1).reshape(-1, 3),
        np.column_stack([np.full(segments, top), here, after]),
        np.column_stack([last + after, last + here, np.full(segments, top + 1)]),
    ]
    return Triangles(points, np.vstack(faces).astype(np.int32), points)
