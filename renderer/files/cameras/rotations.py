"""Rotations as matrices, quaternions (w, x, y, z), and vectors along the axis, whose length is the
angle in radians (Rodrigues).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.checks import Floats, listed
from lucida.renderer.system.errors import LucidaError


def from_vector(vector: Floats) -> Floats:
    """Return the matrix (3, 3) of a rotation vector (3,)."""
    angle = float(np.linalg.norm(vector))
    axis = vector / angle if angle else vector
    return rotation_of([math.cos(angle / 2), *(math.sin(angle / 2) * axis)])


def rotation_of(quaternion: ArrayLike) -> Floats:
    """Return the rotation matrices (..., 3, 3) of quaternions (w, x, y, z), (..., 4), of any
    length.

    Raises LucidaError for a zero quaternion.
    """
    parts = np.asarray(quaternion, float)
    length = np.linalg.norm(parts, axis=-1, keepdims=True)
    if not (length > 1e-9).all():
        wrong = parts.reshape(-1, 4)[int(np.argmin(length))]
        problem = f"{listed(wrong)} is not a rotation"
        raise LucidaError("quaternion", problem, "give w, x, y, z of length 1")
    w, x, y, z = (parts / length).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(rows).T.swapaxes(-1, -2)
