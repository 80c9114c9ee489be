"""Texture coordinates of procedural shapes, computed from their corners' positions.

schema.py documents them for users. A vertex on a seam is duplicated, because its faces show
different places of the image.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .model import Mesh
from .normals import face_normals

Floats = NDArray[np.float64]
CAP = 1 - 1e-6  # the least y of a unit normal at an end of a cylinder or a cone


def on_box(mesh: Mesh) -> Mesh:
    """Show the whole image on each side. It is upright on the four sides around y; its lower edge
    is in front (+z) on the upper side, and behind on the lower one.
    """
    corners, normals = _corners(mesh)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    x, y, z = ((corners - low) / (high - low)).transpose(2, 0, 1)
    axis = np.abs(normals).argmax(axis=1)
    is_front = (normals[np.arange(len(axis)), axis] > 0)[:, None]
    around = np.where(is_front, 1 - z, z), np.where(is_front, x, 1 - x)
    u = np.where((axis == 0)[:, None], around[0], np.where((axis == 2)[:, None], around[1], x))
    v = np.where((axis == 1)[:, None], np.where(is_front, 1 - z, z), y)
    return _with_corner_uv(mesh, np.stack([u, v], axis=-1))


def on_plane(mesh: Mesh) -> Mesh:
    """Show the image in the plane y = 0, once on the shape's square or rectangle."""
    corners, _ = _corners(mesh)
    return _with_corner_uv(mesh, _flat(mesh, corners))


def on_cylinder(mesh: Mesh) -> Mesh:
    """Show the image once around the side, and once on each end, of a cylinder or a cone."""
    corners, normals = _corners(mesh)
    low, high = mesh.vertices[:, 1].min(), mesh.vertices[:, 1].max()
    side = np.stack([_around(corners), (corners[..., 1] - low) / (high - low)], axis=-1)
    is_cap = np.abs(normals[:, 1]) > CAP
    uv = np.where(is_cap[:, None, None], _flat(mesh, corners), side)
    below = is_cap & (normals[:, 1] < 0)
    uv[below, :, 1] = 1 - uv[below, :, 1]  # upright when seen from below
    return _with_corner_uv(mesh, uv)


def on_torus(mesh: Mesh, radius: float) -> Mesh:
    """Show the image once around the axis and once around the tube, whose seam is inside."""
    corners, _ = _corners(mesh)
    away = np.hypot(corners[..., 0], corners[..., 2]) - radius
    v = _unwrapped(0.5 + np.arctan2(corners[..., 1], away) / (2 * np.pi))
    return _with_corner_uv(mesh, np.stack([_around(corners), v], axis=-1))


def _corners(mesh: Mesh) -> tuple[Floats, Floats]:
    """Return the faces' corners (m, 3, 3) and unit normals (m, 3)."""
    normals = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return mesh.vertices[mesh.faces].astype(np.float64), normals


def _flat(mesh: Mesh, corners: Floats) -> Floats:
    low, high = mesh.vertices.min(axis=0)[[0, 2]], mesh.vertices.max(axis=0)[[0, 2]]
    uv: Floats = (corners[..., [0, 2]] - low) / (high - low)
    uv[..., 1] = 1 - uv[..., 1]
    return uv


def _around(corners: Floats) -> Floats:
    """Return u (m, 3): 1/2 towards z, growing towards x. A corner on the axis has the mean of the
    others.
    """
    x, z = corners[..., 0], corners[..., 2]
    u = _unwrapped(0.5 + np.arctan2(x, z) / (2 * np.pi), np.hypot(x, z) > 0)
    return u


def _unwrapped(turns: Floats, known: NDArray[np.bool_] | None = None) -> Floats:
    """Return angles of faces' corners (m, 3), in turns, so that no two of a face are far apart."""
    known = np.ones(turns.shape, bool) if known is None else known
    first = np.take_along_axis(turns, known.argmax(axis=1)[:, None], axis=1)
    turns = turns - np.round(turns - first)
    mean = np.where(known, turns, 0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    return np.where(known, turns, mean[:, None])


def _with_corner_uv(mesh: Mesh, uv: Floats) -> Mesh:
    """Return the mesh with texture coordinates of its faces' corners, (m, 3, 2)."""
    places = uv.astype(np.float32).reshape(-1, 2)
    key = np.column_stack([mesh.faces.reshape(-1).astype(np.float64), places])
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    source = mesh.faces.reshape(-1)[first]
    return replace(
        mesh,
        vertices=mesh.vertices[source],
        faces=inverse.reshape(-1, 3).astype(np.int32),
        normals=None if mesh.normals is None else mesh.normals[source],
        uv=places[first],
    )
