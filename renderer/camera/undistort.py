"""Undistorted photographs, as a pinhole camera at the same place would have taken them.

The pinhole keeps the lens's focal lengths and principal point; its image is as large as the
photograph fills without a gap.
Source: COLMAP's image_undistorter, with its defaults (src/colmap/image/undistortion.cc).
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens

_SCALES = 0.2, 2.0  # the least and the most by which an image's sides change
_BLOCK = 1 << 20  # pixels resampled at a time, to bound the temporary memory


def undistorted_camera(camera: Camera, lens: Lens, size: Size) -> tuple[Camera, Size]:
    """Return the pinhole without the lens, and the size of its image.

    camera: as if it had no lens. size: (width, height) of the photograph.
    """
    (left, right, bottom, top), (width, height) = camera.viewport, size
    units = (right - left) / width, (top - bottom) / height

    def reached(axis: int, i: ArrayLike, j: ArrayLike) -> Floats:
        """Return the places of pixels' ideal points, in pixels from the principal point."""
        x, y = camera.image_point(i, j, size)
        place = lens.direction(x / camera.distance, -y / camera.distance)
        with np.errstate(all="ignore"):
            ideal = place[axis] / np.where(place[2] > 0, place[2], np.nan) * camera.distance
        return ideal[np.isfinite(ideal)] / units[axis]

    rows, columns = np.arange(height), np.arange(width)
    cx, cy = -left / (right - left) * width, top / (top - bottom) * height
    near_x = -reached(0, rows, 0).max(initial=-math.inf)
    near_y = -reached(1, 0, columns).max(initial=-math.inf)
    far_x = reached(0, rows, width - 1).min(initial=math.inf)
    far_y = reached(1, height - 1, columns).min(initial=math.inf)
    scales = (
        1 / max(_ratio(cx, near_x), _ratio(width - 0.5 - cx, far_x)),
        1 / max(_ratio(cy, near_y), _ratio(height - 0.5 - cy, far_y)),
    )
    new = tuple(
        max(1, int(min(max(scale, _SCALES[0]), _SCALES[1]) * side))
        for scale, side in zip(scales, size, strict=True)
    )
    wider, higher = new[0] / width, new[1] / height
    viewport = (left * wider, right * wider, bottom * higher, top * higher)
    return replace(camera, viewport=viewport), (new[0], new[1])


def _ratio(own: float, ideal: float) -> float:
    """Return how much of a pinhole's side the photograph has; the least, if it shows it all."""
    least = 1 / _SCALES[1]
    return max(own / ideal, least) if own > 0 and ideal > 0 else least


def undistorted(
    photograph: NDArray[np.uint8], camera: Camera, lens: Lens, size: Size
) -> NDArray[np.uint8]:
    """Return a photograph as the pinhole sees it: uint8 (height, width, channels).

    photograph: uint8 (height, width, channels), row 0 at the top. camera, size: the photograph's,
    as for undistorted_camera(). Each pixel is interpolated between four; what lies outside of the
    photograph is 0.
    """
    target, (width, height) = undistorted_camera(camera, lens, size)
    columns, rows = _places(target, (width, height), camera, lens, photograph.shape[1::-1])
    found = np.zeros((height * width, photograph.shape[2]), np.uint8)
    for start in range(0, len(found), _BLOCK):
        part = slice(start, start + _BLOCK)
        found[part] = _interpolated(photograph, columns[part], rows[part])
    return found.reshape(height, width, -1)


@lru_cache(maxsize=2)
def _places(
    target: Camera, target_size: Size, camera: Camera, lens: Lens, size: Size
) -> tuple[Floats, Floats]:
    """Return for each pixel of the pinhole its place in the photograph: columns and rows, with
    pixels' centres at integers; NaN outside of the lens.
    """
    target, camera = (replace(each, eye=(0.0, 0.0, 0.0)) for each in (target, camera))
    seen = replace(camera, lens=lens).project(target.rays(target_size).direction, size)
    return seen.column.ravel(), seen.row.ravel()


def _interpolated(
    photograph: NDArray[np.uint8], columns: Floats, rows: Floats
) -> NDArray[np.uint8]:
    height, width, _ = photograph.shape
    inside = (columns >= 0) & (columns <= width - 1) & (rows >= 0) & (rows <= height - 1)
    columns, rows = np.where(inside, columns, 0.0), np.where(inside, rows, 0.0)
    j, i = columns.astype(np.int32), rows.astype(np.int32)
    next_j, next_i = np.minimum(j + 1, width - 1), np.minimum(i + 1, height - 1)
    right, below = ((x % 1).astype(np.float32)[:, None] for x in (columns, rows))
    above = photograph[i, j] * (1 - right) + photograph[i, next_j] * right
    under = photograph[next_i, j] * (1 - right) + photograph[next_i, next_j] * right
    mixed = above * (1 - below) + under * below
    return np.where(inside[:, None], np.rint(mixed), 0).astype(np.uint8)
