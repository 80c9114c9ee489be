"""Conversion between the camera of computer vision, K, R and t, and the camera of graphics.

K [R | t] maps a world point to a pixel: K is (3, 3) in pixels, upper triangular, with axes x to the
right, y down and z forward; R and t are camera_from_world. The position of pixel (0, 0) is a
convention, which differs between sources. Integers are at the pixels' centres (OpenCV), or at their
corners, with centres at .5 (COLMAP, and most renderers).
Source: Hartley and Zisserman, Multiple View Geometry, "Camera models".
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.system.errors import LucidaError

from .checks import LARGEST, Floats, listed

PixelOrigin = Literal["center", "corner"]
Axes = Literal["opencv", "opengl"]

SKEWED = 1e-9  # relative to fx; smaller skews are rounding
IGNORE = "calibrate without"
_OFFSET = {"center": 0.5, "corner": 0.0}
_FLIP = np.diag([1.0, -1.0, -1.0])  # converts between y down, z forward and y up, z back


class Intrinsics(NamedTuple):
    """K (3, 3) in pixels, and camera_from_world as R (3, 3), a rotation, and t (3,)."""

    K: Floats
    R: Floats
    t: Floats


@np.errstate(all="ignore")  # Camera's own checks reject overflows
def camera_fields(
    K: ArrayLike,
    camera_from_world: ArrayLike,
    size: tuple[int, int],
    axes: str,
    pixel_origin: str,
) -> dict[str, Any]:
    """Return the fields of the Camera with these intrinsics and this pose, at distance 1.

    camera_from_world: (3, 4) or (4, 4), any affine map. size: (width, height). A negative focal
    length mirrors the image. Raises LucidaError.
    """
    k = matrix("K", K, (3, 3))
    pose = matrix("camera_from_world", camera_from_world, (3, 4), (4, 4))
    if axes not in get_args(Axes):
        raise LucidaError(
            "axes", f"{axes!r} is unknown", f"give one of {', '.join(get_args(Axes))}"
        )
    if k[1, 0] or k[2, 0] or k[2, 1] or not k[2, 2]:
        problem = f"its rows {', '.join(map(listed, k))} are not [fx s cx], [0 fy cy], [0 0 1]"
        raise LucidaError("K", problem, "give it row by row")
    (fx, skew, cx), (_, fy, cy), _ = (k / k[2, 2]).tolist()
    viewport = viewport_of(fx, fy, cx, cy, size, pixel_origin)
    linear = pose[:3, :3] if axes == "opencv" else _FLIP @ pose[:3, :3]
    try:
        across, down, forward = np.linalg.inv(linear).T
        eye = 0.0 - np.linalg.solve(pose[:3, :3], pose[:3, 3])  # avoids -0
    except np.linalg.LinAlgError:
        problem = f"its rows {', '.join(map(listed, pose[:3, :3]))} have no inverse"
        raise LucidaError("camera_from_world", problem, "give a rotation") from None
    return {
        "eye": eye.tolist(),
        "u": (np.sign(fx) * across).tolist(),
        "v": (np.sign(fy) * (skew / fx * across - down)).tolist(),
        "w": (0.0 - forward).tolist(),
        "distance": 1.0,
        "viewport": viewport,
    }


def check_for_lens(K: Floats) -> None:
    """Raise LucidaError for a skew or a mirror in K, which would have to come after the lens."""
    if not (K[0, 0] > 0 and K[1, 1] > 0 and abs(K[0, 1]) <= SKEWED * K[0, 0]):
        what = "mirrors the image" if K[0, 0] < 0 or K[1, 1] < 0 else f"has the skew {K[0, 1]:g}"
        raise LucidaError("K", f"{what} of a lens, which is not supported", IGNORE)


def viewport_of(
    fx: float, fy: float, cx: float, cy: float, size: tuple[int, int], pixel_origin: str
) -> tuple[float, float, float, float]:
    """Return left, right, bottom and top, at distance 1, of an image with these intrinsics.

    size: (width, height). Raises LucidaError.
    """
    if not (fx and fy):
        raise LucidaError("K", f"its focal lengths are {fx:g} and {fy:g}", "give them in pixels")
    offset, (width, height) = pixel_offset(pixel_origin), size
    left, right = (-cx - offset) / abs(fx), (width - cx - offset) / abs(fx)
    return left, right, -(height - cy - offset) / abs(fy), (cy + offset) / abs(fy)


def decomposed(pixel_to_direction: Floats, eye: ArrayLike, pixel_origin: str) -> Intrinsics:
    """Return K, R and t of a camera, given the map from pixels to ray directions.

    The ray through the point (x, y) of the image, in pixels from the corner of its first pixel, has
    the direction pixel_to_direction @ (x, y, 1). K's diagonal is positive, except that K[0, 0] of a
    mirrored image is negative.
    """
    from_corner = np.array(
        [[1, 0, pixel_offset(pixel_origin)], [0, 1, pixel_offset(pixel_origin)], [0, 0, 1]]
    )
    m = np.linalg.inv(pixel_to_direction @ from_corner)
    # RQ decomposition, by QR of the reversed rows: m = upper triangular times orthogonal.
    q, r = np.linalg.qr(m[::-1].T)
    k, rotation = r.T[::-1, ::-1], q.T[::-1]
    signs = np.sign(np.diag(k))
    k, rotation = k * signs, signs[:, None] * rotation
    if np.linalg.det(rotation) < 0:  # a mirrored image: keep R a rotation
        k[:, 0], rotation[0] = -k[:, 0], -rotation[0]
    return Intrinsics(k / k[2, 2], rotation, -rotation @ np.asarray(eye, float))


@np.errstate(all="ignore")
def as_camera_from_world(world_from_camera: ArrayLike) -> Floats:
    """Return the inverse of a pose, (4, 4). Raises LucidaError."""
    pose = np.eye(4)
    given = matrix("world_from_camera", world_from_camera, (3, 4), (4, 4))
    pose[:3] = given[:3]
    try:
        return np.asarray(np.linalg.inv(pose), np.float64)
    except np.linalg.LinAlgError:
        problem = f"its rows {', '.join(map(listed, given[:3]))} have no inverse"
        raise LucidaError("world_from_camera", problem, "give a rotation") from None


def matrix(name: str, value: ArrayLike, *shapes: tuple[int, ...]) -> Floats:
    """Return a matrix of finite numbers with one of these shapes. Raises LucidaError naming it."""
    try:
        entries = np.asarray(value)
    except (TypeError, ValueError, OverflowError):
        entries = np.array("")
    if entries.dtype.kind not in "iuf":  # rejects texts that look like numbers, too
        raise LucidaError(name, "is not a matrix of numbers", "give its rows")
    found: Floats = entries.astype(np.float64)
    if found.shape not in shapes:
        wanted = " or ".join(" x ".join(map(str, shape)) for shape in shapes)
        raise LucidaError(name, f"has the shape {found.shape}", f"give {wanted} numbers")
    if not np.isfinite(found).all():
        raise LucidaError(name, "has a number that is not finite", "give finite numbers")
    if (largest := float(np.abs(found).max(initial=0.0))) > LARGEST:
        problem = f"has the number {largest:g}, which is too large"
        raise LucidaError(name, problem, f"stay within {LARGEST:g}")
    return found


def pixel_offset(pixel_origin: str) -> float:
    """Return the offset that measures a coordinate from the corner of the image's first pixel.

    Raises LucidaError.
    """
    if pixel_origin not in _OFFSET:
        raise LucidaError(
            "pixel_origin", f"{pixel_origin!r} is unknown", "give 'center' or 'corner'"
        )
    return _OFFSET[pixel_origin]
