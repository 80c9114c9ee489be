"""The tiles of a lens's image, each with its own pinhole camera.

A lens bends rays, but all of them start at the eye. Within a tile, they differ little from the rays
of the tile's frame, a pinhole camera that looks at the tile's middle and whose image is fitted to
the tile's pixels. Pixels are near a grid in it. Edge functions are evaluated at their exact places,
which are stored, so the result is exact. A tile whose rays spread too far for one frame (in a small
panorama) is divided among the six faces of a cube.

The table does not depend on eye and basis, so it is made once for a lens and a size.
"""

from __future__ import annotations

import math
import threading
from collections import OrderedDict
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.trace.arguments.image import Rows
from lucida.renderer.trace.compile.compiled import inlined, kernel
from lucida.renderer.trace.threads.thread_pool import CANCELLED, NEXT, Control

TILE, SQUARE = 16, 4  # pixels, as in tile.py
_PIXELS = TILE * TILE
_STEEPEST = 0.35  # the least cosine between a frame's axis and its rays
_BAND_PIXELS = 1 << 18  # pixels whose rays are computed at once
_ALL = -1  # instead of a face of the cube
_KEPT_BYTES = 1 << 28

F32 = NDArray[np.float32]
F64 = NDArray[np.float64]


class LensTable(NamedTuple):
    """The frames of an image's tiles, row by row.

    first: int64, the first frame of each tile, and the number of all frames.
    turn: float64, 9 a frame: the matrix, by rows, from the camera coordinates of the pinhole
        camera without the lens (view.py) to the frame's.
    back: its inverse.
    bounds: float32, 4 a frame: the least x of the tile's first column if all pixels had the largest
        displacement to the left; the largest x of the last one if to the right; y likewise.
    least_ahead: float32, the least `ahead` of a frame.
    right, down: float32, 256 a frame, 16 a square: a pixel's place in the frame, relative to its
        square's first place on the grid.
    ahead: float32, the frame's Z of a pixel's direction; NaN for pixels outside the lens or the
        image, or in another frame of the tile.
    """

    first: NDArray[np.int64]
    turn: F64
    back: F64
    bounds: F32
    least_ahead: F32
    right: F32
    down: F32
    ahead: F32


# A table with the types of all tables, for compiling kernels.
NO_FRAMES = LensTable(
    np.zeros(2, np.int64), *(np.empty(0, kind) for kind in ["f8"] * 2 + ["f4"] * 5)
)
_tables: OrderedDict[tuple, LensTable] = OrderedDict()
_lock = threading.Lock()


def lens_table(camera: Camera, rows: Rows, control: Control) -> LensTable | None:
    """Return the table of some rows of a camera with a lens; None if it was cancelled. The latest
    tables are kept.

    control: that of the image.
    """
    key = camera.lens, camera.viewport, camera.distance, rows
    with _lock:
        if key in _tables:
            _tables.move_to_end(key)
            return _tables[key]
    plain = Camera(viewport=camera.viewport, distance=camera.distance, lens=camera.lens)
    bands: list[tuple[NDArray[Any], ...]] = []
    for rays in _bands(plain, rows):
        if bands and control[NEXT] >= CANCELLED:
            return None
        bands.append(_frames(rays, _pinhole(plain, rows.size)))
    counts, *parts = (np.concatenate(part) for part in zip(*bands, strict=True))
    first = np.concatenate([[0], counts.cumsum()])
    table = LensTable(first, *(part.reshape(-1) for part in parts))
    with _lock:
        _tables[key] = table
        while len(_tables) > 1 and sum(map(_bytes, _tables.values())) > _KEPT_BYTES:
            _tables.popitem(last=False)
    return table


def _bytes(table: LensTable) -> int:
    return sum(part.nbytes for part in table)


def _pinhole(camera: Camera, size: Size) -> F64:
    """Return the matrix from the pinhole's camera coordinates to lens coordinates: in units of u
    and v, with z forwards, and the image plane at distance 1.
    """
    left, right, bottom, top = camera.viewport
    across, down = (right - left) / size[0], (bottom - top) / size[1]
    x, y = (left + right) / 2, (bottom + top) / 2
    scale = np.array([camera.distance, camera.distance, 1])
    return np.array([[across, 0, x], [0, down, y], [0, 0, 1]]) / scale[:, None]


def _bands(camera: Camera, seen: Rows) -> Iterator[F64]:
    """Yield the directions of the pixels in lens coordinates, some rows of tiles at a time; NaN
    outside of the lens and of the image."""
    width = seen.size[0]
    across = -(-width // TILE) * TILE
    band = max(1, _BAND_PIXELS // (across * TILE)) * TILE
    for top in range(seen.first, seen.end, band):
        rows = min(band, seen.end - top)
        rays = np.full((-(-rows // TILE) * TILE, across, 3), np.nan)
        i, j = np.arange(top, top + rows)[:, None], np.arange(width)
        rays[:rows, :width] = camera.ray(i, j, seen.size).direction * [1, 1, -1] / camera.distance
        yield rays


def _frames(rays: F64, pinhole: F64) -> tuple[NDArray[Any], ...]:
    """Return the number of frames of each tile, and the parts of a LensTable for them."""
    axis, cosine = _axes(rays)
    count = np.ones(len(axis), np.int64)
    wide = np.flatnonzero(cosine < _STEEPEST)
    count[wide] = 6
    tile, face = np.arange(len(axis)).repeat(count), np.full(count.sum(), _ALL)
    axis = axis[tile]
    face[count[tile] == 6] = np.tile(np.arange(6), len(wide))
    axis[face >= 0] = np.concatenate([np.eye(3), -np.eye(3)])[face[face >= 0]]
    # Right, down and ahead, of the image's handedness.
    helper = np.where(np.abs(axis[:, 1:2]) < 0.8, [0.0, -1.0, 0.0], [1.0, 0.0, 0.0])
    right = np.cross(axis, helper)
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    turned = np.stack([right, np.cross(right, axis), axis], axis=1)
    image, bounds, places = _fit(rays, tile, face, turned, max(np.abs(pinhole[[0, 1], [0, 1]])))
    turn = image @ turned @ pinhole
    outwards = np.array([-2e-7, 2e-7, -2e-7, 2e-7], np.float32)
    sides = bounds[:, :4] + outwards * np.abs(bounds[:, :4])
    return count, turn, np.linalg.inv(turn), sides, bounds[:, 4], *places


@kernel
def _axes(rays):
    """Return the mean direction of each tile's rays, and its least cosine with any of them."""
    across, count = rays.shape[1] // TILE, rays.shape[0] * rays.shape[1] // _PIXELS
    axis, cosine = np.zeros((count, 3)), np.ones(count)
    for tile in range(count):
        top, left = tile // across * TILE, tile % across * TILE
        x = y = z = 0.0
        for k in range(_PIXELS):
            a, b, c = _ray(rays, top, left, k)
            if not np.isnan(a):
                scale = 1 / math.sqrt(a * a + b * b + c * c)
                x, y, z = x + scale * a, y + scale * b, z + scale * c
        length = math.sqrt(x * x + y * y + z * z)
        if length == 0:
            x, y, z, length = 0.0, 0.0, 1.0, 1.0
        x, y, z = x / length, y / length, z / length
        axis[tile, 0], axis[tile, 1], axis[tile, 2] = x, y, z
        for k in range(_PIXELS):
            a, b, c = _ray(rays, top, left, k)
            if not np.isnan(a):
                along = (x * a + y * b + z * c) / math.sqrt(a * a + b * b + c * c)
                cosine[tile] = min(cosine[tile], along)
    return axis, cosine


class _Fit(NamedTuple):
    """An affine map from a frame's plane to the tile's grid. It maps (x, y) to (column, row), and
    any other point (x', y') to

    (column + a (x' - x) + b (y' - y), row + c (x' - x) + d (y' - y)).
    """

    x: float
    y: float
    column: float
    row: float
    a: float
    b: float
    c: float
    d: float


@kernel
def _fit(rays, tile, face, turned, widest):
    """Fit each frame's image to the grid. Return (image, float64 (n, 3, 3), bounds and least_ahead,
    float32 (n, 5), places, float32 (3, n, 256): right, down, ahead).

    tile, face: of each frame. turned: its right, down and ahead. widest: a pixel, for frames that
    cannot be fitted.
    """
    across, count = rays.shape[1] // TILE, len(tile)
    image, bounds = np.zeros((count, 3, 3)), np.empty((count, 5), np.float32)
    places = np.empty((3, count, _PIXELS), np.float32)
    x, y, ahead = np.empty(_PIXELS), np.empty(_PIXELS), np.empty(_PIXELS)
    for frame in range(count):
        top, left = tile[frame] // across * TILE, tile[frame] % across * TILE
        for k in range(_PIXELS):
            ray = _ray(rays, top, left, k)
            is_own = face[frame] < 0 or _face_of(ray) == face[frame]
            # NaN outside the lens, and in other frames of the tile.
            ahead[k] = _along(turned, frame, 2, ray) if is_own else np.nan
            x[k] = _along(turned, frame, 0, ray) / ahead[k]
            y[k] = _along(turned, frame, 1, ray) / ahead[k]
        fit = _affine_fit(x, y, ahead, widest)
        image[frame, 0, 0], image[frame, 0, 1] = fit.a, fit.b
        image[frame, 1, 0], image[frame, 1, 1] = fit.c, fit.d
        image[frame, 0, 2] = fit.column - fit.a * fit.x - fit.b * fit.y
        image[frame, 1, 2] = fit.row - fit.c * fit.x - fit.d * fit.y
        image[frame, 2, 2] = 1.0
        _write_places(fit, x, y, ahead, frame, bounds, places)
    return image, bounds, places


@inlined
def _affine_fit(x, y, ahead, widest):
    """Return the least squares fit of points to their pixels' columns and rows."""
    seen = 0
    mean_x = mean_y = mean_column = mean_row = 0.0
    for k in range(_PIXELS):
        if not np.isnan(ahead[k]):
            seen += 1
            mean_x, mean_y = mean_x + x[k], mean_y + y[k]
            mean_column, mean_row = mean_column + k % TILE, mean_row + k // TILE
    if seen > 0:
        mean_x, mean_y = mean_x / seen, mean_y / seen
        mean_column, mean_row = mean_column / seen, mean_row / seen
    xx = xy = yy = x_column = y_column = x_row = y_row = 0.0
    for k in range(_PIXELS):
        if not np.isnan(ahead[k]):
            dx, dy = x[k] - mean_x, y[k] - mean_y
            column, row = k % TILE - mean_column, k // TILE - mean_row
            xx, xy, yy = xx + dx * dx, xy + dx * dy, yy + dy * dy
            x_column, y_column = x_column + dx * column, y_column + dy * column
            x_row, y_row = x_row + dx * row, y_row + dy * row
    # Solve the normal equations by Cramer's rule.
    volume = xx * yy - xy * xy
    a, b = x_column * yy - y_column * xy, y_column * xx - x_column * xy
    c, d = x_row * yy - y_row * xy, y_row * xx - x_row * xy
    if volume > 1e-9 * (xx + yy) ** 2 and a * d > b * c:
        a, b, c, d = a / volume, b / volume, c / volume, d / volume
    else:
        a, b, c, d = 1 / widest, 0.0, 0.0, 1 / widest
    return _Fit(mean_x, mean_y, mean_column, mean_row, a, b, c, d)


@inlined
def _write_places(fit, x, y, ahead, frame, bounds, places):
    """Write a frame's pixels, relative to the grid, and the bounds around all of them."""
    least_x = least_y = most_x = most_y = 0.0
    least_ahead = np.inf
    for k in range(_PIXELS):
        column, row = k % TILE, k // TILE
        at = row // SQUARE * 64 + column // SQUARE * 16 + row % SQUARE * 4 + column % SQUARE
        right = down = 0.0
        if not np.isnan(ahead[k]):
            dx, dy = x[k] - fit.x, y[k] - fit.y
            right = (fit.column - column) + fit.a * dx + fit.b * dy
            down = (fit.row - row) + fit.c * dx + fit.d * dy
            least_x, most_x = min(least_x, right), max(most_x, right)
            least_y, most_y = min(least_y, down), max(most_y, down)
            least_ahead = min(least_ahead, ahead[k])
        places[0, frame, at] = right + column % SQUARE
        places[1, frame, at] = down + row % SQUARE
        places[2, frame, at] = ahead[k]
    bounds[frame, 0], bounds[frame, 1] = least_x, most_x + (TILE - 1)
    bounds[frame, 2], bounds[frame, 3] = least_y, most_y + (TILE - 1)
    bounds[frame, 4] = least_ahead


@inlined
def _ray(rays, top, left, k):
    """Return the direction of a tile's pixel."""
    i, j = top + k // TILE, left + k % TILE
    return rays[i, j, 0], rays[i, j, 1], rays[i, j, 2]


@inlined
def _along(turned, frame, axis, d):
    return (
        turned[frame, axis, 0] * d[0]
        + turned[frame, axis, 1] * d[1]
        + turned[frame, axis, 2] * d[2]
    )


@inlined
def _face_of(d):
    """Return the face of the cube that a direction passes through."""
    x, y, z = abs(d[0]), abs(d[1]), abs(d[2])
    axis = 0 if x >= y and x >= z else (1 if y >= z else 2)
    return axis + 3 if d[axis] < 0 else axis
