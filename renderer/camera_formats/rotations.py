"""Rotation vectors: along the axis, with the angle in radians as length (Rodrigues)."""

from __future__ import annotations

import math

import numpy as np

from renderer.camera_checks import Floats


def from_vector(vector: Floats) -> Floats:
    """Return the matrix (3, 3) of a rotation vector (3,)."""
    angle = float(np.linalg.norm(vector))
    x, y, z = (vector / angle).tolist() if angle else (0.0, 0.0, 0.0)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    # 1 - cos as a square, which is accurate for small angles.
    return np.eye(3) + math.sin(angle) * cross + 2 * math.sin(angle / 2) ** 2 * cross @ cross


def to_vector(rotation: Floats) -> Floats:
    """Return the rotation vector (3,), no longer than pi, of a rotation matrix (3, 3).

    Uses the quaternion, an eigenvector, which is accurate at every angle, including near pi.
    Source: Bar-Itzhack 2000, "New method for extracting the quaternion from a rotation matrix".
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation.tolist()
    form = np.array(
        [
            [xx - yy - zz, xy + yx, xz + zx, zy - yz],
            [xy + yx, yy - xx - zz, yz + zy, xz - zx],
            [xz + zx, yz + zy, zz - xx - yy, yx - xy],
            [zy - yz, xz - zx, yx - xy, xx + yy + zz],
        ]
    )
    quaternion: Floats = np.linalg.eigh(form)[1][:, -1]
    axis, real = quaternion[:3], float(quaternion[3])
    if real < 0:
        axis, real = -axis, -real
    length = float(np.linalg.norm(axis))
    return axis * (2 * math.atan2(length, real) / length) if length else np.zeros(3)
