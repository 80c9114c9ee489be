"""Checked entries of other programs' files: numbers, sizes and poses, each by its name."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, listed, number
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin, matrix
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.files.cameras.posed import PosedCamera
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError, errors_as

# The phrases for the two pixel origins in CameraSet.taken.
ORIGIN_TOLD: dict[PixelOrigin, str] = {
    "center": "whole numbers stand at the pixels' centres",
    "corner": "whole numbers stand at the pixels' corners, centres at .5",
}

_LAST = (0.0, 0.0, 0.0, 1.0)  # row of an affine map
_ROUNDED = 1e-4  # tolerance for a rotation in float32, or with four digits


def number_of(name: str, value: object) -> float:
    """Return a finite number. A text that looks like a number is not one. Raises LucidaError."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise LucidaError(name, f"{value!r} is not a number", "give a finite number")
    return number(name, value)


def side_of(name: str, value: object) -> int:
    """Return a width or height: a whole number, perhaps written as a float. Raises LucidaError."""
    side = number_of(name, value)
    if side != int(side) or side < 1:
        raise LucidaError(name, f"{side:g} is no count of pixels", "give a whole number above 0")
    return int(side)


def size_of(name: str, width: object, height: object) -> Size:
    """Return a checked size. Raises LucidaError."""
    with errors_as(name):
        return check_size((side_of(name, width), side_of(name, height)))


def flat(name: str, value: ArrayLike, *counts: int) -> Floats:
    """Return numbers flattened to one dimension, regardless of nesting.

    counts: the allowed numbers of them; any if empty. Raises LucidaError.
    """
    try:
        entries = np.ravel(value)
    except (TypeError, ValueError):
        entries = np.array([""])
    found = matrix(name, entries, entries.shape)
    if counts and found.size not in counts:
        wanted = " or ".join(map(str, counts))
        raise LucidaError(name, f"has {found.size} numbers", f"give {wanted}")
    return found


def affine(name: str, value: ArrayLike) -> Floats:
    """Return an affine map (4, 4), from 3 x 4 or 4 x 4 numbers row by row. Raises LucidaError."""
    found = matrix(name, value, (3, 4), (4, 4), (12,), (16,)).reshape(-1, 4)
    if len(found) == 3:
        return np.vstack([found, _LAST])
    if not np.allclose(found[3], _LAST, rtol=0, atol=1e-6):
        problem = f"its last row {listed(found[3])} is not (0, 0, 0, 1)"
        turned = np.allclose(found[:, 3], _LAST, rtol=0, atol=1e-6)
        remedy = "is it transposed? give it row by row" if turned else "give an affine matrix"
        raise LucidaError(name, problem, remedy)
    return found


def is_rotation(linear: Floats) -> bool:
    """Return True if all matrices (..., 3, 3) are rotations up to rounding. A camera with any other
    matrix is kept unchanged.
    """
    products = linear @ np.swapaxes(linear, -1, -2)
    return bool(np.abs(products - np.eye(3)).max() < _ROUNDED and (np.linalg.det(linear) > 0).all())


def single(cameras: Sequence[PosedCamera], what: str) -> PosedCamera:
    """Return the camera for a file that holds only one. Raises LucidaError."""
    if len(cameras) != 1:
        problem = f"{what} holds one camera, not {len(cameras)}"
        raise LucidaError("", problem, "choose one with --frame or --image")
    return cameras[0]


def sized(posed: PosedCamera, options: Options) -> tuple[Camera, Size | None]:
    """Return the camera fitted to its image's size, and that size.

    The size is its own, or the requested one; None if neither is known.
    """
    size = posed.size or options.size
    camera = posed.camera.fitted(size) if posed.fit and size is not None else posed.camera
    return camera, size


def in_image(posed: PosedCamera, options: Options, target: str) -> tuple[Camera, Size]:
    """Like sized(), for a format that needs a size. Raises LucidaError if there is none."""
    camera, size = sized(posed, options)
    if size is None:
        raise LucidaError("size", f"is not known, and {target} needs one", "give --size WxH")
    return camera, check_size(size)
