"""The exact extent of a sphere's projection on the image plane."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from renderer.camera import Camera, Floats, Size

NEAREST = 1e-9  # of the largest parameter: points closer to the eye's plane are clipped
ROUNDING_PX = 1e-6  # a centre that lies on the edge counts


class Extent(NamedTuple):
    """left, right, bottom, top on the image plane, in units of u and v; infinite if an object
    reaches around the eye.
    """

    left: float
    right: float
    bottom: float
    top: float


NOTHING = Extent(math.inf, -math.inf, math.inf, -math.inf)
EVERYTHING = Extent(-math.inf, math.inf, -math.inf, math.inf)


def sphere_extent(center: Floats, radius: float, camera: Camera) -> Extent:
    """Return the extent of a sphere in world space.

    Any basis is legal: in camera coordinates the sphere is an ellipsoid.

    Source: Hartley and Zisserman, Multiple View Geometry, "The action of a projective camera on
    quadrics": the outline's dual conic touches the extent's four lines.
    """
    linear = camera.camera_from_world[:3, :3]
    x, y, z = linear @ (center - camera.eye)
    reach_x, reach_y, reach_z = radius * np.linalg.norm(linear, axis=1)
    unit = 1.0 if camera.is_parallel else camera.distance
    if _is_outside((-z - reach_z) / unit, (-z + reach_z) / unit, camera):
        return NOTHING
    if camera.is_parallel:
        return Extent(x - reach_x, x + reach_x, y - reach_y, y + reach_y)
    if -z <= reach_z * (1 + NEAREST):
        return EVERYTHING
    image = np.diag([1.0, 1.0, -1.0 / unit])
    middle = image @ (x, y, z)
    outline = image @ (radius * linear)
    conic = outline @ outline.T - np.outer(middle, middle)
    sides = []
    for k in (0, 1):
        a, b, c = conic[2, 2], conic[k, 2], conic[k, k]
        root = math.sqrt(max(0.0, b * b - a * c))
        sides += sorted([(b - root) / a, (b + root) / a])
    return Extent(*sides)


def pixels_of(extent: Extent, camera: Camera, size: Size) -> tuple[range, range]:
    """Return the rows and columns whose pixel centres are within an extent; see
    Camera.image_point.
    """
    width, height = size
    left, right, bottom, top = camera.viewport
    columns = whole_within(
        (extent.left - left) / (right - left) * width - 0.5,
        (extent.right - left) / (right - left) * width - 0.5,
        width,
    )
    rows = whole_within(
        (top - extent.top) / (top - bottom) * height - 0.5,
        (top - extent.bottom) / (top - bottom) * height - 0.5,
        height,
    )
    return (rows, columns) if rows and columns else (range(0), range(0))


def _is_outside(t_low: float, t_high: float, camera: Camera) -> bool:
    """Return True if ray parameters from t_low to t_high are all behind the eye, or clipped."""
    t_min, t_max = camera.t_range
    return t_high <= t_min or t_low >= t_max


def whole_within(low: float, high: float, count: int) -> range:
    """Return the whole numbers from low to high that are within 0 to count - 1."""
    first = math.ceil(min(max(low - ROUNDING_PX, 0.0), count))
    last = math.floor(max(min(high + ROUNDING_PX, count - 1.0), -1.0))
    return range(first, max(first, last + 1))
