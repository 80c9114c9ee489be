"""Lens distortion: how far a lens moves the corners of an image from where a pinhole puts them.

The formulas hold on the plane at distance 1, with x to the right and y down. Nothing is drawn with
them. Sources: OpenCV's documentation, "Camera calibration" and "Fisheye camera model".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from renderer.camera import Size
from renderer.camera_checks import Floats
from renderer.camera_formats.posed import Distortion
from renderer.intrinsics import pixel_offset

Coefficients = Mapping[str, float]
Bend = Callable[[Floats, Floats, Coefficients], tuple[Floats, Floats]]

# OpenCV's coefficients, in the order of its vectors; a fisheye has k1 to k4.
NAMES = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY")
COUNTS = (4, 5, 8, 12, 14)  # allowed lengths of a vector
FISHEYE_NAMES = ("k1", "k2", "k3", "k4")


def lens(
    model: str, coefficients: Coefficients, bend: Bend, K: Floats, size: Size, pixel_origin: str
) -> Distortion | None:
    """Return an image's distortion; None if there is none. A fisheye distorts even if its
    coefficients are all 0.

    K: (3, 3). size: (width, height).
    """
    if bend is not fisheye and not any(coefficients.values()):
        return None  # return early: there may be 100,000 frames
    width, height = size
    offset = pixel_offset(pixel_origin)
    corners = np.array([(x, y, 1) for x in (0, width) for y in (0, height)]) - (offset, offset, 0)
    with np.errstate(all="ignore"):
        x, y, scale = np.linalg.solve(K, corners.T)
        x, y = x / scale, y / scale
        bent_x, bent_y = bend(x, y, coefficients)
        moved = K[:2, :2] @ (bent_x - x, bent_y - y) / K[2, 2]
        corner_px = float(np.hypot(*moved).max())
    if corner_px == 0 and not any(coefficients.values()):
        return None
    return Distortion(
        model, dict(coefficients), corner_px if math.isfinite(corner_px) else math.inf
    )


def radial_tangential(
    x: Floats,
    y: Floats,
    c: Coefficients,
    above: tuple[str, ...] = ("k1", "k2", "k3"),
    below: tuple[str, ...] = ("k4", "k5", "k6"),
) -> tuple[Floats, Floats]:
    """Return a point distorted by OpenCV's model.

    The model has a quotient of polynomials of r^2, tangential terms, thin prisms and a tilted
    sensor. Those of NAMES that are missing are 0. above, below: the names of the quotient's terms.
    """
    r2 = x * x + y * y
    p1, p2, s1, s2, s3, s4, tilt_x, tilt_y = (
        c.get(name, 0.0) for name in ("p1", "p2", "s1", "s2", "s3", "s4", "tauX", "tauY")
    )
    radial = _series(r2, above, c) / _series(r2, below, c)
    bent_x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r2 * r2
    bent_y = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r2 * r2
    if tilt_x or tilt_y:
        bent_x, bent_y = _tilted(bent_x, bent_y, tilt_x, tilt_y)
    return bent_x, bent_y


def fisheye(x: Floats, y: Floats, c: Coefficients) -> tuple[Floats, Floats]:
    """Return a point distorted by the model of Kannala and Brandt.

    The distance from the centre is a polynomial of the angle; without coefficients it is the angle
    itself (equidistant).
    """
    r = np.hypot(x, y)
    angle = np.arctan(r)
    scale = np.divide(angle * _series(angle**2, FISHEYE_NAMES, c), r, np.ones_like(r), where=r > 0)
    return x * scale, y * scale


def _series(square: Floats, names: tuple[str, ...], c: Coefficients) -> Floats:
    """Return 1 + k1 s + k2 s^2 + ..."""
    total = np.zeros_like(square)
    for name in reversed(names):
        total = (total + c.get(name, 0.0)) * square
    return 1.0 + total


def _tilted(x: Floats, y: Floats, tilt_x: float, tilt_y: float) -> tuple[Floats, Floats]:
    """Return a point on a sensor rotated about both axes by angles in radians (Scheimpflug)."""
    cx, sx, cy, sy = math.cos(tilt_x), math.sin(tilt_x), math.cos(tilt_y), math.sin(tilt_y)
    turned = np.array([[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]]) @ [
        [1, 0, 0],
        [0, cx, sx],
        [0, -sx, cx],
    ]
    onto = [[turned[2, 2], 0, -turned[0, 2]], [0, turned[2, 2], -turned[1, 2]], [0, 0, 1]]
    a, b, scale = onto @ turned @ (x, y, np.ones_like(x))
    return a / scale, b / scale
