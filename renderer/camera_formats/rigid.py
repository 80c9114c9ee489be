"""A camera as formats hold it that pose it by a rotation and a place: by unit vectors.

Owns what of u, v and w such a pose can hold, and what the viewport holds instead.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from renderer.camera import Camera
from renderer.camera_checks import Floats, listed
from renderer.errors import LucidaError

STRAIGHT = 1e-6  # a cosine below this is float32's rounding: at right angles, and made so
REMEDY = "orthonormalize it: Camera > Keep orthonormal, or camera.orthonormalized()"


def rigid(camera: Camera, target: str) -> Camera:
    """The camera with the same rays whose u, v and w are unit vectors at right angles.

    The lengths of u and v go to the viewport. So does, in perspective, what w leans: the image
    plane then lies beside the eye's axis. near and far count along the new w. A parallel camera's
    eye goes to the viewport's middle. target: who asks,
    for the error. Raises LucidaError for a left-handed basis, for u and v that are not at right
    angles, and for a parallel camera that looks askance on its image plane.
    """
    u, v, w = (np.asarray(vector) for vector in (camera.u, camera.v, camera.w))
    if camera.determinant < 0:
        problem = f"{listed(u)} is left-handed with v and w, a mirror that {target} has not"
        raise LucidaError("u", problem, "negate u, which mirrors the picture")
    width, height = float(np.linalg.norm(u)), float(np.linalg.norm(v))
    u, v = u / width, v / height
    if abs(u @ v) > STRAIGHT:
        problem = f"{listed(camera.v)} is not at right angles to u = {listed(camera.u)}"
        raise LucidaError("v", f"{problem}, which {target} cannot hold", REMEDY)
    v = v - (u @ v) * u
    v /= np.linalg.norm(v)
    back = np.cross(u, v)
    lean_x, lean_y, length = (float(w @ axis) for axis in (u, v, back))
    left, right, bottom, top = camera.viewport
    x, y = lean_x * camera.distance, lean_y * camera.distance
    if camera.is_parallel:
        if np.hypot(lean_x, lean_y) > STRAIGHT * length:
            problem = (
                f"{listed(w)} is not at right angles to u and v, which {target} cannot hold in "
                "a parallel projection"
            )
            raise LucidaError("w", problem, REMEDY)
        x = y = 0.0
    straight = replace(
        camera,
        u=tuple(u.tolist()),
        v=tuple(v.tolist()),
        w=tuple(back.tolist()),
        distance=camera.distance * length,
        viewport=(left * width - x, right * width - x, bottom * height - y, top * height - y),
        near=None if camera.near is None else camera.near * length,
        far=None if camera.far is None else camera.far * length,
    )
    return centred(straight) if camera.is_parallel else straight


def centred(camera: Camera) -> Camera:
    """A parallel camera with the eye in its viewport's middle: the same rays."""
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    eye = np.asarray(camera.eye) + x * np.asarray(camera.u) + y * np.asarray(camera.v)
    viewport = left - x, right - x, bottom - y, top - y
    return replace(camera, eye=tuple(eye.tolist()), viewport=viewport)


def pose_of(camera: Camera) -> Floats:
    """The matrix with the columns u, v, w and eye; (4, 4)."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = camera.basis, camera.eye
    return pose


def rotation_of(quaternion: ArrayLike) -> Floats:
    """Return the rotation matrices (..., 3, 3) of quaternions (w, x, y, z), (..., 4), of any
    length. Raises LucidaError for 0."""
    parts = np.asarray(quaternion, float)
    length = np.linalg.norm(parts, axis=-1, keepdims=True)
    if not (length > 1e-9).all():
        wrong = parts.reshape(-1, 4)[int(np.argmin(length))]
        problem = f"{listed(wrong)} is no rotation"
        raise LucidaError("quaternion", problem, "give w, x, y, z of length 1")
    w, x, y, z = np.moveaxis(parts / length, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def quaternion_of(rotation: ArrayLike) -> list[float]:
    """(w, x, y, z), w >= 0, of a rotation matrix.

    From the largest of the four, so that nothing is divided by what is nearly 0.
    """
    m: Any = np.asarray(rotation, float)
    (a, b, c), (d, e, f), (g, h, i) = m
    squares = 1 + np.array([a + e + i, a - e - i, e - a - i, i - a - e])  # 4 w^2, 4 x^2, ...
    products = np.array(
        [
            [squares[0], h - f, c - g, d - b],
            [h - f, squares[1], b + d, c + g],
            [c - g, b + d, squares[2], f + h],
            [d - b, c + g, f + h, squares[3]],
        ]
    )  # 4 q_k q_l
    row = products[np.argmax(squares)]
    quaternion = row / np.linalg.norm(row)
    return [float(part) for part in (quaternion if quaternion[0] >= 0 else -quaternion)]
