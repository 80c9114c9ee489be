"""Lens distortion: how far a lens moves the corners of an image from where a pinhole puts them.

The formulas hold on the plane at distance 1, with x to the right and y down. Nothing is drawn with
them. Sources: OpenCV's documentation, "Camera calibration" and "Fisheye camera model"; COLMAP's
documentation, "Camera Models".
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from renderer.camera import Size
from renderer.camera_checks import Floats
from renderer.camera_formats.posed import Distortion
from renderer.intrinsics import pixel_offset

# OpenCV's coefficients, in the order of its vectors; a fisheye has k1 to k4.
NAMES = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY")
COUNTS = (4, 5, 8, 12, 14)  # allowed lengths of a vector
FISHEYE_NAMES = ("k1", "k2", "k3", "k4")
_OPENCV_NAMES = {"k": "k1", "sx1": "s1", "sy1": "s3"}  # by COLMAP's


def lens(
    model: str,
    coefficients: Mapping[str, float],
    K: Floats,
    size: Size,
    pixel_origin: str = "corner",
    fisheye: bool = False,
    quartic: bool = False,
) -> Distortion | None:
    """Return an image's distortion; None if there is none. A fisheye distorts even if its
    coefficients are all 0.

    K: (3, 3). fisheye, quartic: as for distorted().
    """
    if not fisheye and not any(coefficients.values()):
        return None  # return early: there may be 100,000 frames
    corners = np.array([(x, y, 1) for x in (0, size[0]) for y in (0, size[1])])
    corners = corners - np.array([1, 1, 0]) * pixel_offset(pixel_origin)
    known = {_OPENCV_NAMES.get(name, name): value for name, value in coefficients.items()}
    with np.errstate(all="ignore"):  # polynomials may overflow far outside the lens's picture
        x, y, scale = np.linalg.solve(K, corners.T)
        x, y = x / scale, y / scale
        moved = np.array(distorted(x, y, known, fisheye, quartic)) - (x, y)
        corner_px = float(np.hypot(*(K[:2, :2] @ moved / K[2, 2])).max())
    if corner_px == 0 and not any(coefficients.values()):
        return None
    return Distortion(
        model, dict(coefficients), corner_px if math.isfinite(corner_px) else math.inf
    )


def distorted(
    x: Floats, y: Floats, c: Mapping[str, float], fisheye: bool = False, quartic: bool = False
) -> tuple[Floats, Floats]:
    """Return a point distorted by OpenCV's model, of which the others are parts.

    The model has a quotient of polynomials of r^2, tangential terms, thin prisms and a tilted
    sensor. Those of NAMES that are missing are 0. With omega, it is the field-of-view model.
    fisheye: replace r, the tangent of the angle to the axis, by the angle before everything else
    (Kannala and Brandt). quartic: k4 is the numerator's last term, as in every fisheye.
    """
    r = np.hypot(x, y)
    if omega := c.get("omega"):
        scale = np.where(r > 0, np.arctan(2 * r * math.tan(omega / 2)) / (r * omega), 1.0)
        return scale * x, scale * y
    if fisheye:
        scale = np.where(r > 0, np.arctan(r) / r, 1.0)
        x, y = scale * x, scale * y
    above = 4 if fisheye or quartic else 3
    k1_to_k6 = [c.get(f"k{n}", 0.0) for n in range(1, 7)]
    p1, p2, s1, s2, s3, s4, tilt_x, tilt_y = (
        c.get(name, 0.0) for name in (*NAMES[2:4], *NAMES[8:])
    )
    r2 = x * x + y * y
    radial = _series(r2, k1_to_k6[:above]) / _series(r2, k1_to_k6[above:])
    x, y = (
        x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r2 * r2,
        y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r2 * r2,
    )
    return _tilted(x, y, tilt_x, tilt_y) if tilt_x or tilt_y else (x, y)


def _series(square: Floats, coefficients: list[float]) -> Floats:
    """Return 1 + k1 s + k2 s^2 + ..."""
    total = np.zeros_like(square)
    for coefficient in reversed(coefficients):
        total = (total + coefficient) * square
    return 1.0 + total


def _tilted(x: Floats, y: Floats, tilt_x: float, tilt_y: float) -> tuple[Floats, Floats]:
    """Return a point on a sensor rotated about both axes by angles in radians (Scheimpflug)."""
    cx, sx, cy, sy = math.cos(tilt_x), math.sin(tilt_x), math.cos(tilt_y), math.sin(tilt_y)
    about_y, about_x = (
        [[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]],
        [[1, 0, 0], [0, cx, sx], [0, -sx, cx]],
    )
    turned = np.array(about_y) @ about_x
    onto = [[turned[2, 2], 0, -turned[0, 2]], [0, turned[2, 2], -turned[1, 2]], [0, 0, 1]]
    a, b, scale = onto @ turned @ (x, y, np.ones_like(x))
    return a / scale, b / scale
