"""A camera's geometry in the world: its image plane, its view volume, its pixels.

Pure. In the image, (x, y) are coordinates on the image plane in units of u and v; t is the ray
parameter. Arrays of points have a shape that ends in 3.

Rays behind a lens do not pass through their pixels on the image plane; some may miss it altogether.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size, has_pixel

MOST_GRID_LINES = 32
STEPS = (1, 2, 5)  # times a power of ten: pixels from one line of the grid to the next
CURVE = 32  # parts of a curved side


def point_at(camera: Camera, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Floats:
    """Return world points (..., 3) at parameter t of the rays through (x, y) of the image plane;
    NaN outside the lens.
    """
    x, y, t = (np.asarray(part, float) for part in (x, y, t))
    if not camera.is_parallel:
        return np.asarray(camera.eye) + t[..., None] * directions(camera, x, y)
    across = x[..., None] * np.asarray(camera.u) + y[..., None] * np.asarray(camera.v)
    return np.asarray(camera.eye) + across - t[..., None] * np.asarray(camera.w)


def directions(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the world directions (..., 3) of the rays through (x, y), as Camera.direction() does.

    Those behind a lens take iterations, and do not change while the camera moves: they are kept.
    """
    if camera.lens is None:
        return camera.direction(x, y)
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    return _ways(_optics(camera), x.shape, x.tobytes(), y.tobytes()) @ camera.basis.T


def _optics(camera: Camera) -> Camera:
    """Return a camera with the same lens and viewport, at the origin."""
    return Camera(viewport=camera.viewport, distance=camera.distance, lens=camera.lens)


@lru_cache(maxsize=512)
def _ways(optics: Camera, shape: tuple[int, ...], x: bytes, y: bytes) -> Floats:
    return optics.direction(*(np.frombuffer(axis).reshape(shape) for axis in (x, y)))


def on_ray(camera: Camera, pixel: Pixel, size: Size, t: Sequence[float]) -> Floats:
    """Return the points (n, 3) of a pixel's ray at parameters t."""
    x, y = camera.image_point(*pixel, size)
    return point_at(camera, [x] * len(t), [y] * len(t), t)


def plane_parameter(camera: Camera) -> float:
    """Return the ray parameter on the image plane."""
    return 0.0 if camera.is_parallel else 1.0


def plane_corners(camera: Camera) -> Floats:
    """Return the image plane's corners, (4, 3): upper left, upper right, lower right, lower left in
    the camera's image.
    """
    left, right, bottom, top = camera.viewport
    corners = [left, right, right, left], [top, top, bottom, bottom]
    return point_at(camera.pinhole, *corners, plane_parameter(camera))


def image_point(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the world points (..., 3) at (x, y) on the image plane, ignoring a lens."""
    return point_at(camera.pinhole, x, y, plane_parameter(camera))


def border(camera: Camera, parts: int = CURVE) -> Floats:
    """Return points (x, y) around the visible region, (4 parts, 2): on the viewport's sides, or on
    the lens's edge if that is nearer. They begin at the upper left and go to the right.

    parts: the number of parts per side; 1 for the corners only.
    """
    return _border(_optics(camera), parts)


@lru_cache(maxsize=64)
def _border(optics: Camera, parts: int) -> Floats:
    left, right, bottom, top = optics.viewport
    corners = np.array([[left, top], [right, top], [right, bottom], [left, bottom]])
    share = (np.arange(parts) / parts)[:, None]
    after = np.roll(corners, -1, axis=0)
    frame = np.concatenate(
        [(1 - share) * start + share * end for start, end in zip(corners, after, strict=True)]
    )
    # A lens's visible region is connected around its axis: search for its edge from there.
    middle = np.array([min(max(0.0, left), right), min(max(0.0, bottom), top)])
    low, high = np.zeros(len(frame)), np.ones(len(frame))

    def is_seen(share: Floats) -> NDArray[np.bool_]:
        x, y = (middle + share[:, None] * (frame - middle)).T
        return np.isfinite(optics.direction(x, y)[:, 0])

    low[is_seen(high)] = 1.0
    for _ in range(0 if low.all() else 24):
        seen = is_seen((low + high) / 2)
        low, high = np.where(seen, (low + high) / 2, low), np.where(seen, high, (low + high) / 2)
    found = middle + low[:, None] * (frame - middle)
    found.flags.writeable = False
    return found


def grid_step(size: Size, most: int = MOST_GRID_LINES) -> int:
    """Return the number of pixels between the grid's lines, so that no side has more than
    `most` parts.
    """
    least = max(size) / max(1, min(most, MOST_GRID_LINES))
    steps = (step * 10**power for power in itertools.count() for step in STEPS)
    return next(step for step in steps if step >= least)


def grid(camera: Camera, size: Size, most: int = MOST_GRID_LINES) -> Floats:
    """Return the pixel grid's inner lines on the image plane, (n, 2, 3).

    size: the image's size. most: the largest number of parts per side.
    """
    left, right, bottom, top = camera.viewport
    step = grid_step(size, most)
    x = left + np.arange(step, size[0], step) / size[0] * (right - left)
    y = top - np.arange(step, size[1], step) / size[1] * (top - bottom)
    down = image_point(camera, x[:, None], np.array([top, bottom]))
    across = image_point(camera, np.array([left, right]), y[:, None])
    return np.concatenate([down, across])


def pixel_corners(camera: Camera, pixel: Pixel, size: Size) -> Floats:
    """Return a pixel's corners on the image, (4, 3), in the order of plane_corners()."""
    rows = np.array([-0.5, -0.5, 0.5, 0.5]) + pixel[0]
    columns = np.array([-0.5, 0.5, 0.5, -0.5]) + pixel[1]
    x, y = camera.image_point(rows, columns, size)
    return image_point(camera, x, y)


def bundle_pixels(size: Size, counts: tuple[int, int]) -> NDArray[np.int64]:
    """Return the pixels (n, 2) of a bundle of rows x columns rays: those in the middles of equal
    parts of the image.
    """
    sides = [(min(count, side), side) for count, side in zip(counts, size[::-1], strict=True)]
    rows, columns = (((np.arange(n) + 0.5) * side / max(n, 1)).astype(int) for n, side in sides)
    return np.stack(np.meshgrid(rows, columns, indexing="ij"), axis=-1).reshape(-1, 2)


def pixel_seen(camera: Camera, size: Size, origin: Floats, direction: Floats) -> Pixel | None:
    """Return the pixel of the image plane that a ray from elsewhere meets, or None."""
    back = camera.camera_from_world[2]
    depth = 0.0 if camera.is_parallel else camera.distance
    with np.errstate(all="ignore"):
        t = -(back[:3] @ origin + back[3] + depth) / (back[:3] @ direction)
        row, column, _ = camera.pinhole.project(origin + t * direction, size)
    if not (t > 0 and np.isfinite([row, column]).all()):
        return None
    pixel = round(float(row)), round(float(column))
    return pixel if has_pixel(size, pixel) else None
