"""A camera as a solid thing in the world: its image plane, its view volume, its pixels.

Pure; knows nothing of drawing. In the image, (x, y) are coordinates on the image plane in units of
u and v; t is the ray parameter. Shapes of points end in 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.state.options import Pixel
from renderer.camera import Camera

Floats = NDArray[np.float64]
Size = tuple[int, int]

MOST_GRID_LINES = 32
STEPS = (1, 2, 5)  # times a power of ten: pixels from one line of the grid to the next


def point_at(camera: Camera, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Floats:
    """Return world points (..., 3) at parameter t of the rays through (x, y) of the image plane."""
    x, y, t = np.broadcast_arrays(*(np.asarray(part, float)[..., None] for part in (x, y, t)))
    across = x * np.asarray(camera.u) + y * np.asarray(camera.v)
    eye, w = np.asarray(camera.eye), np.asarray(camera.w)
    if camera.is_parallel:
        return eye + across - t * w
    return eye + t * (across - camera.distance * w)


def plane_parameter(camera: Camera) -> float:
    """Return the ray parameter on the image plane."""
    return 0.0 if camera.is_parallel else 1.0


def rectangle(camera: Camera, t: float) -> Floats:
    """Return the viewport's corners at parameter t, (4, 3): upper left, upper right, lower
    right, lower left in the camera's image.
    """
    left, right, bottom, top = camera.viewport
    return point_at(camera, [left, right, right, left], [top, top, bottom, bottom], t)


def plane_corners(camera: Camera) -> Floats:
    """Return the image plane's corners, (4, 3), in the order of rectangle()."""
    return rectangle(camera, plane_parameter(camera))


def grid_step(size: Size, most: int = MOST_GRID_LINES) -> int:
    """Return the number of pixels between the grid's lines, so that no side has more than
    `most` parts.
    """
    least = max(size) / max(1, min(most, MOST_GRID_LINES))
    power = 1
    while True:
        for step in STEPS:
            if step * power >= least:
                return step * power
        power *= 10


def grid(camera: Camera, size: Size, most: int = MOST_GRID_LINES) -> Floats:
    """Return the pixel grid's inner lines on the image plane, (n, 2, 3).

    size: of the image. most: parts of a side.
    """
    left, right, bottom, top = camera.viewport
    step, t = grid_step(size, most), plane_parameter(camera)
    x = left + np.arange(step, size[0], step) / size[0] * (right - left)
    y = top - np.arange(step, size[1], step) / size[1] * (top - bottom)
    columns = np.stack([point_at(camera, x, top, t), point_at(camera, x, bottom, t)], axis=1)
    rows = np.stack([point_at(camera, left, y, t), point_at(camera, right, y, t)], axis=1)
    return np.concatenate([columns, rows])


def pixel_corners(camera: Camera, pixel: Pixel, size: Size) -> Floats:
    """Return a pixel's corners on the image plane, (4, 3), in the order of rectangle()."""
    rows = np.array([-0.5, -0.5, 0.5, 0.5]) + pixel[0]
    columns = np.array([-0.5, 0.5, 0.5, -0.5]) + pixel[1]
    x, y = camera.image_point(rows, columns, size)
    return point_at(camera, x, y, plane_parameter(camera))


def bundle_pixels(size: Size, counts: tuple[int, int]) -> NDArray[np.int64]:
    """Return the pixels, (n, 2), of a bundle of rows x columns rays: those in the middles of as
    many equal parts of the image.
    """
    rows, columns = (
        np.unique(
            ((np.arange(min(count, side)) + 0.5) * side / max(1, min(count, side))).astype(int)
        )
        for count, side in zip(counts, (size[1], size[0]), strict=True)
    )
    return np.stack(np.meshgrid(rows, columns, indexing="ij"), axis=-1).reshape(-1, 2)


def pixel_seen(
    camera: Camera,
    size: Size,
    origin: Floats,
    direction: Floats,
    hidden_at: Callable[[], float] | None = None,
) -> Pixel | None:
    """Return the pixel of the image plane that a ray from elsewhere meets, or None.

    hidden_at: returns the ray parameter from which the scene hides what is behind it. Called only
    if the ray meets the image plane.
    """
    corners = plane_corners(camera)
    edges = np.column_stack([corners[1] - corners[0], corners[3] - corners[0], -direction])
    with np.errstate(all="ignore"):
        scale = np.linalg.norm(edges, axis=0)
        if not (scale > 0).all() or abs(np.linalg.det(edges / scale)) < 1e-9:
            return None
        x, y, t = np.linalg.solve(edges / scale, origin - corners[0]) / scale
    if not (t > 0 and 0 <= x < 1 and 0 <= y < 1):
        return None
    if hidden_at is not None and t >= hidden_at():
        return None
    return min(math.floor(y * size[1]), size[1] - 1), min(math.floor(x * size[0]), size[0] - 1)
