"""A camera as formats hold it that pose it by a rotation and a place: by unit vectors.

Owns what of u, v and w such a pose can hold, and what the viewport holds instead.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats, listed
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import PosedCamera
from renderer.errors import LucidaError

STRAIGHT = 1e-9  # a cosine below this moves no point of a picture by 1e-6 pixels
REMEDY = "orthonormalize it: Camera > Keep orthonormal, or camera.orthonormalized()"


def rigid(camera: Camera, target: str) -> Camera:
    """The camera with the same rays whose u, v and w are unit vectors at right angles.

    The lengths of u and v go to the viewport. So does, in perspective, what w leans: the image
    plane then lies beside the eye's axis. near and far count along the new w. target: who asks,
    for the error. Raises LucidaError for a left-handed basis, for u and v that are not at right
    angles, and for a parallel camera that looks askance on its image plane.
    """
    u, v, w = (np.asarray(vector) for vector in (camera.u, camera.v, camera.w))
    if camera.determinant < 0:
        problem = f"{listed(w)} is left-handed with u and v, a mirror that {target} has not"
        raise LucidaError("w", problem, "negate u, which mirrors the picture")
    width, height = float(np.linalg.norm(u)), float(np.linalg.norm(v))
    u, v = u / width, v / height
    if abs(u @ v) > STRAIGHT:
        problem = f"{listed(camera.v)} is not at right angles to u = {listed(camera.u)}"
        raise LucidaError("v", f"{problem}, which {target} cannot hold", REMEDY)
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
    return replace(
        camera,
        u=tuple(u.tolist()),
        v=tuple(v.tolist()),
        w=tuple(back.tolist()),
        distance=camera.distance * length,
        viewport=(left * width - x, right * width - x, bottom * height - y, top * height - y),
        near=None if camera.near is None else camera.near * length,
        far=None if camera.far is None else camera.far * length,
    )


def sized(posed: PosedCamera, options: Options) -> tuple[Camera, Size | None]:
    """The camera for the size of its image, and that size: its own, or the one that was asked
    for; None where neither is known."""
    size = posed.size or options.size
    camera = posed.camera.fitted(size) if posed.fit and size is not None else posed.camera
    return camera, size


def known_size(size: Size | None, target: str) -> Size:
    """Raises LucidaError where the format needs one and none is known."""
    if size is None:
        raise LucidaError("size", f"is not known, and {target} needs one", "give --size WxH")
    return size


def pose_of(camera: Camera) -> Floats:
    """The matrix with the columns u, v, w and eye; (4, 4)."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = camera.basis, camera.eye
    return pose


def rotation_of(quaternion: Sequence[float]) -> Floats:
    """The rotation matrix of a quaternion (w, x, y, z) of any length. Raises LucidaError for 0."""
    length = math.hypot(*quaternion)
    if not length > 1e-9:
        problem = f"{listed(quaternion)} is no rotation"
        raise LucidaError("quaternion", problem, "give w, x, y, z of length 1")
    w, x, y, z = (part / length for part in quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


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
