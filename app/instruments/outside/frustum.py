"""A camera as a solid thing in the world: its image plane, its view volume, its pixels.

Pure; knows nothing of drawing. In the image, (x, y) are coordinates on the image plane in units of
u and v; t is the ray parameter. Shapes of points end in 3.

A camera with a lens has its image on the plane as long as all of its rays meet that plane; another
one has it on a sphere around the eye, whose radius is `distance`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens

MOST_GRID_LINES = 32
STEPS = (1, 2, 5)  # times a power of ten: pixels from one line of the grid to the next
STEEPEST_DEG = 80.0  # from the axis: rays that are steeper meet the image plane too far away
CURVE = 32  # parts of a side of what is curved


def point_at(camera: Camera, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Floats:
    """Return world points (..., 3) at parameter t of the rays through (x, y) of the image plane;
    NaN outside of the lens.
    """
    if camera.lens is not None:
        along = ways(camera, x, y) @ camera.basis.T
        return np.asarray(camera.eye) + np.asarray(t, float)[..., None] * along
    x, y, t = (np.asarray(part, float)[..., None] for part in (x, y, t))
    across = x * np.asarray(camera.u) + y * np.asarray(camera.v)
    eye, w = np.asarray(camera.eye), np.asarray(camera.w)
    if camera.is_parallel:
        return eye + across - t * w
    return eye + t * (across - camera.distance * w)


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


def has_plane(camera: Camera) -> bool:
    """Return True if all rays meet the image plane, so that the image is on it."""
    return camera.lens is None or _is_flat(camera.lens, camera.viewport, camera.distance)


def image_point(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the world points (..., 3) of the image that shows them at (x, y): on the image plane,
    or on the sphere; there NaN outside of the lens.
    """
    if has_plane(camera):
        return point_at(camera.pinhole, x, y, plane_parameter(camera))
    return point_at(camera, x, y, _plane_or_sphere(camera, x, y))


def ideal_point(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return where the rays through (x, y) of the image meet the image plane, or the sphere: world
    points (..., 3). Without a lens, these are the points of the image.
    """
    if camera.lens is None:
        return image_point(camera, x, y)
    return point_at(camera, x, y, _plane_or_sphere(camera, x, y))


def _plane_or_sphere(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the ray parameters there. Only for a camera with a lens."""
    along = ways(camera, x, y)
    ahead = -along[..., 2] if has_plane(camera) else np.linalg.norm(along, axis=-1)
    return camera.distance / ahead


def _ways(
    lens: Lens,
    viewport: tuple[float, float, float, float],
    distance: float,
    x: ArrayLike,
    y: ArrayLike,
) -> Floats:
    """Return the rays' directions, (..., 3), in units of u, v and w."""
    return Camera(viewport=viewport, distance=distance, lens=lens).direction(x, y)


def ways(camera: Camera, x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the directions of the rays through (x, y), (..., 3), in units of u, v and w; NaN
    outside of the lens. Only for a camera with a lens.

    The last ones are kept: they stay the same while a camera moves.
    """
    assert camera.lens is not None
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    places = x.shape, x.tobytes(), y.tobytes()
    return _kept_ways(camera.lens, camera.viewport, camera.distance, *places)


@lru_cache(maxsize=512)
def _kept_ways(
    lens: Lens,
    viewport: tuple[float, float, float, float],
    distance: float,
    shape: tuple[int, ...],
    x: bytes,
    y: bytes,
) -> Floats:
    places = (np.frombuffer(axis).reshape(shape) for axis in (x, y))
    found = _ways(lens, viewport, distance, *places)
    found.flags.writeable = False
    return found


def border(camera: Camera, parts: int = CURVE) -> Floats:
    """Return points (x, y) around what the camera sees, (4 parts, 2): the viewport's sides, or
    where the lens ends before. They begin at the upper left and go to the right.

    parts: of a side, 1 for the corners.
    """
    if camera.lens is not None:
        return _border(camera.lens, camera.viewport, camera.distance, parts)
    return _frame(camera.viewport, parts)


def _frame(viewport: tuple[float, float, float, float], parts: int) -> Floats:
    left, right, bottom, top = viewport
    corners = np.array([[left, top], [right, top], [right, bottom], [left, bottom]])
    share = (np.arange(parts) / parts)[:, None]
    return np.concatenate(
        [
            (1 - share) * start + share * end
            for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        ]
    )


@lru_cache(maxsize=64)
def _border(
    lens: Lens, viewport: tuple[float, float, float, float], distance: float, parts: int
) -> Floats:
    frame = _frame(viewport, parts)
    left, right, bottom, top = viewport
    # What a lens sees is in one piece around its axis: look for its end on the way from there.
    middle = np.array([min(max(0.0, left), right), min(max(0.0, bottom), top)])

    def is_seen(points: Floats) -> NDArray[np.bool_]:
        return np.isfinite(_ways(lens, viewport, distance, *points.T)[:, 0])

    low, high = np.zeros(len(frame)), np.ones(len(frame))
    low[is_seen(frame)] = 1.0
    for _ in range(0 if low.all() else 24):
        share = (low + high) / 2
        seen = is_seen(middle + share[:, None] * (frame - middle))
        low, high = np.where(seen, share, low), np.where(seen, high, share)
    found = middle + low[:, None] * (frame - middle)
    found.flags.writeable = False
    return found


@lru_cache(maxsize=64)
def _is_flat(lens: Lens, viewport: tuple[float, float, float, float], distance: float) -> bool:
    along = _ways(lens, viewport, distance, *_border(lens, viewport, distance, CURVE).T)
    cosines = -along[:, 2] / np.linalg.norm(along, axis=1)
    return bool((cosines > math.cos(math.radians(STEEPEST_DEG))).all())


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
    """Return the pixel grid's inner lines on the image, (n, 2, 3).

    size: of the image. most: parts of a side.
    """
    left, right, bottom, top = camera.viewport
    step = grid_step(size, most)
    x = left + np.arange(step, size[0], step) / size[0] * (right - left)
    y = top - np.arange(step, size[1], step) / size[1] * (top - bottom)
    if not has_plane(camera):
        return _curved_grid(camera, x, y)
    flat = camera.pinhole
    t = plane_parameter(flat)
    columns = np.stack([point_at(flat, x, top, t), point_at(flat, x, bottom, t)], axis=1)
    rows = np.stack([point_at(flat, left, y, t), point_at(flat, right, y, t)], axis=1)
    return np.concatenate([columns, rows])


def _curved_grid(camera: Camera, x: Floats, y: Floats) -> Floats:
    """Return the lines of a grid on the sphere as short ones, as far as the lens sees them."""
    left, right, bottom, top = camera.viewport
    across, down = np.linspace(left, right, 2 * CURVE + 1), np.linspace(top, bottom, 2 * CURVE + 1)
    lines = [
        image_point(camera, *np.broadcast_arrays(x[:, None], down)),
        image_point(camera, *np.broadcast_arrays(across, y[:, None])),
    ]
    pieces = [np.stack([line[:, :-1], line[:, 1:]], axis=2).reshape(-1, 2, 3) for line in lines]
    found = np.concatenate(pieces)
    return found[np.isfinite(found).all(axis=(1, 2))]


def pixel_corners(camera: Camera, pixel: Pixel, size: Size) -> Floats:
    """Return a pixel's corners on the image, (4, 3), in the order of plane_corners()."""
    rows = np.array([-0.5, -0.5, 0.5, 0.5]) + pixel[0]
    columns = np.array([-0.5, 0.5, 0.5, -0.5]) + pixel[1]
    x, y = camera.image_point(rows, columns, size)
    return image_point(camera, x, y)


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
    camera: Camera, size: Size, origin: Floats, direction: Floats
) -> tuple[Pixel, float] | None:
    """Return the pixel of the image plane that a ray from elsewhere meets, and the ray's t there;
    None if it meets none.
    """
    found = on_plane(camera, origin, direction) if has_plane(camera) else None
    if found is None:
        return None
    x, y, t = found
    left, right, bottom, top = camera.viewport
    row = math.floor((top - y) / (top - bottom) * size[1])
    column = math.floor((x - left) / (right - left) * size[0])
    inside = 0 <= row < size[1] and 0 <= column < size[0]
    return ((row, column), t) if inside else None


def on_plane(
    camera: Camera, origin: Floats, direction: Floats
) -> tuple[float, float, float] | None:
    """Return where a ray from elsewhere meets the image plane, (x, y) in units of u and v, and the
    ray's t there; None if that is not in front of it.
    """
    columns = np.column_stack([camera.u, camera.v, -np.asarray(direction)])
    middle = image_point(camera.pinhole, 0.0, 0.0)
    with np.errstate(all="ignore"):
        scale = np.linalg.norm(columns, axis=0)
        if not (scale > 0).all() or abs(np.linalg.det(columns / scale)) < 1e-9:
            return None
        x, y, t = (np.linalg.solve(columns / scale, origin - middle) / scale).tolist()
    return (x, y, t) if t > 0 else None
