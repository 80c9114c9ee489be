"""Triangles as other renderers need them, and binary PLY files of them.

In those renderers, a mesh has normals at all its vertices or at none, and its triangles wind about
their normals. In Lucida some triangles may be flat, and any winding is allowed.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.camera_checks import volume
from renderer.scene.model import Color, Mesh
from renderer.scene.normals import face_normals
from renderer.shared_numbers import OTHER_SIDE

F32 = NDArray[np.float32]
Viewer = tuple[float, float, float, float]  # homogeneous: a point, or a direction (w = 0)


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


def is_mirrored(transform: NDArray[np.float64]) -> bool:
    return volume(*transform[:3, :3].T) < 0


def viewer_of(camera: Camera, world_from_object: NDArray[np.float64]) -> Viewer:
    """Return a camera as the viewer in an object's space."""
    world = (*camera.w, 0.0) if camera.is_parallel else (*camera.eye, 1.0)
    x, y, z, w = np.linalg.solve(world_from_object, world).tolist()
    return x, y, z, w


def turned_to(viewer: Viewer, mesh: Triangles) -> Triangles:
    """Return the triangles, all front-facing for a viewer in their space.

    Each back-facing triangle gets the opposite winding and normals.
    """
    mesh = mesh.apart()
    back = ~_fronts(viewer, mesh)
    faces = np.where(back[:, None], mesh.faces[:, ::-1], mesh.faces)
    if mesh.normals is None:
        return replace(mesh, faces=faces)
    signs = np.where(back, np.float32(-1), np.float32(1)).repeat(3)
    return replace(mesh, faces=faces, normals=mesh.normals * signs[:, None])


def shows_backs(viewer: Viewer, mesh: Triangles) -> bool:
    """Return True if a viewer may see a back face: impossible outside a closed surface.

    The origin of parallel rays is unknown here; it may be inside.
    """
    if _fronts(viewer, mesh).all():
        return False
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    place = np.array(viewer[:3])
    may_be_inside = viewer[3] == 0 or bool(((place >= low) & (place <= high)).all())
    return may_be_inside or not _is_closed(mesh)


def _fronts(viewer: Viewer, mesh: Triangles) -> NDArray[np.bool_]:
    """Return for each triangle whether it is counterclockwise as the viewer sees it."""
    a, b, c = mesh.vertices[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    to_viewer = np.array(viewer[:3]) - viewer[3] * a
    fronts: NDArray[np.bool_] = np.einsum("ij,ij->i", np.cross(b - a, c - a), to_viewer) >= 0
    return fronts


@functools.lru_cache(1)
def _is_closed(mesh: Triangles) -> bool:
    """Return True if each edge has an opposite one, and the inside is behind the faces."""
    _, place = np.unique(mesh.vertices, axis=0, return_inverse=True)
    corners = place.reshape(-1)[mesh.faces].astype(np.int64)
    ahead = corners[:, [1, 2, 0]]
    edges, back = corners * len(place) + ahead, ahead * len(place) + corners
    a, b, c = mesh.vertices[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    inside = np.einsum("ij,ij->", a, np.cross(b, c))
    return bool(inside > 0) and bool((np.sort(edges, axis=None) == np.sort(back, axis=None)).all())


def ply_bytes(mesh: Triangles, tints: Iterable[tuple[str, Color]], mirrored: bool) -> bytes:
    """Return a binary PLY file.

    tints: for each copy of the vertices' colours, the names of its columns and a factor. mirrored:
    the transform mirrors the mesh, so the winding is reversed.
    """
    columns: list[tuple[str, F32]] = [("x y z", mesh.vertices)]
    if mesh.normals is not None:
        columns.append(("nx ny nz", mesh.normals))
    if mesh.uv is not None:
        columns.append(("u v", mesh.uv))
    if mesh.colors is not None:
        columns += [(names, mesh.colors * np.array(tint, np.float32)) for names, tint in tints]
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
    """Return a sphere of radius 1, with twice as many segments around y as rings from pole
    to pole.
    """
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
