"""The image plane: the places of pixels on it, their rays, and the directions seen by a lens.

Points (x, y) are in units of the camera's u and v, directions in units of u, v and w.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .checks import Floats, arrays_text
from .lenses import Lens
from .pixels import Pixel

Size = tuple[int, int]
Part = tuple[slice, slice]  # rows, columns
WHOLE: Part = slice(None), slice(None)
Viewport = tuple[float, float, float, float]

LARGEST_KEPT = 1 << 21  # pixels whose directions through a lens are kept: 48 MB


def has_pixel(size: Size, pixel: Pixel) -> bool:
    """Return True if an image of (width, height) has the pixel (row, column)."""
    return 0 <= pixel[0] < size[1] and 0 <= pixel[1] < size[0]


class Ray(NamedTuple):
    """A half-line: r(t) = origin + t * direction, t > 0. The direction is not normalised."""

    origin: Floats
    direction: Floats

    def __repr__(self) -> str:
        return arrays_text(self)


class Projected(NamedTuple):
    """The positions of points in the image; see Camera.project."""

    row: Floats
    column: Floats
    parameter: Floats

    def __repr__(self) -> str:
        return arrays_text(self)


def image_point(
    i: ArrayLike, j: ArrayLike, viewport: Viewport, size: Size
) -> tuple[Floats, Floats]:
    """Return (x, y) of the centre of pixel (i, j); see Camera.image_point()."""
    width, height = size
    left, right, bottom, top = viewport
    x = left + (np.asarray(j, float) + 0.5) / width * (right - left)
    y = top - (np.asarray(i, float) + 0.5) / height * (top - bottom)
    return x, y


def seen_through(lens: Lens, x: Floats, y: Floats, distance: float) -> Floats:
    """Return the directions (..., 3) through a lens at points; NaN outside it."""
    right, down, ahead = lens.direction(x / distance, -y / distance)
    return np.stack([right, -down, -ahead], axis=-1) * distance


def all_seen_through(lens: Lens, viewport: Viewport, distance: float, size: Size) -> Floats:
    """Return the directions of all pixels: read-only float64 (height, width, 3).

    They are computed once for a camera, unless there are more than LARGEST_KEPT.
    """
    is_kept = size[0] * size[1] <= LARGEST_KEPT
    compute = _all_seen_through if is_kept else _all_seen_through.__wrapped__
    return compute(lens, viewport, distance, size)


@lru_cache(maxsize=2)
def _all_seen_through(lens: Lens, viewport: Viewport, distance: float, size: Size) -> Floats:
    x, y = image_point(np.arange(size[1])[:, None], np.arange(size[0]), viewport, size)
    directions = seen_through(lens, x, y, distance)
    directions.flags.writeable = False
    return directions


def points_across(lens: Lens, axis: int, low: float, high: float, distance: float) -> Floats:
    """Return points (2, 129) of the line y = 0 (axis 0) or x = 0 (axis 1), from low to high, within
    the lens.
    """
    ends = sorted((1 - 2 * axis) * end * distance for end in lens.ends(axis))
    points = np.zeros((2, 129))
    points[axis] = np.linspace(max(low, ends[0]), min(high, ends[1]), points.shape[1])
    return points


def summed_angle_deg(directions: Floats) -> float:
    """Return the sum of the angles between neighbours of directions (n, 3), without those that
    are NaN.
    """
    directions = directions[np.isfinite(directions[:, 0])]
    one, other = directions[:-1], directions[1:]
    sines = np.linalg.norm(np.cross(one, other), axis=-1)
    return math.degrees(np.arctan2(sines, (one * other).sum(axis=-1)).sum())
