"""A checker on texture coordinates, for targets without solid checkers.

On a face parallel to two of the object's axes, a solid checker's cells are squares along those two;
the position along the third decides which colour comes first. Other faces have no such coordinates.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lucida.renderer.files.export.meshes import Triangles
from lucida.renderer.images.shared_numbers import CELL_NUDGE
from lucida.renderer.scene.model import Checker
from lucida.renderer.scene.normals import face_normals

ALONG = 1e-6  # tolerance: the part of a unit normal across its axis


def with_checker_uv(mesh: Triangles, checker: Checker) -> Triangles | None:
    """Return the triangles with texture coordinates for a checker; None if a face is parallel to no
    two axes.

    Two cells of the checker make the unit: (0, 0) to (1/2, 1/2) has the first colour.
    """
    mesh = mesh.apart()
    normals = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    axis = np.abs(normals).argmax(axis=1)
    faces = np.arange(len(axis))
    across = normals.copy()
    across[faces, axis] = 0
    if (np.abs(across) > ALONG).any():
        return None
    # The object's origin is the centre of a cell; a face on a border takes the cell inside.
    cells = mesh.vertices.reshape(-1, 3, 3).astype(float) / checker.size + 0.5
    height = cells.mean(axis=1)[faces, axis] - CELL_NUDGE * normals[faces, axis]
    others = np.array([[1, 2], [0, 2], [0, 1]])[axis]
    uv = np.take_along_axis(cells, others[:, None, :].repeat(3, axis=1), axis=2)
    uv[:, :, 0] += (np.floor(height) % 2)[:, None]
    # Shift the coordinates by whole periods to keep them small.
    uv -= 2 * np.floor(uv.min(axis=1, keepdims=True) / 2)
    return replace(mesh, uv=(uv / 2).reshape(-1, 2).astype(np.float32))
