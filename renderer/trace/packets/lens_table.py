"""What a lens does to an image's tiles: for each, a pinhole camera of its own.

A lens bends rays, but all of them start at the eye. Within a tile they differ little from a pinhole
camera's, if it looks at the tile's middle and its image is fitted to the tile's pixels: a frame.
There, pixels are next to the places of a grid; the exact places are stored, and their edge
functions evaluated, so that nothing of this is an approximation. A tile whose rays fit into no frame
(of a small panorama) is divided among the six faces of a cube.

Does not depend on eye and basis: made once for a lens and a size.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Size

TILE, SQUARE = 16, 4  # pixels, as in tile.py
_PIXELS = TILE * TILE
_STEEPEST = 0.35  # the least cosine between a frame's axis and its rays
_BAND_PIXELS = 1 << 18  # to be computed at once
_KEPT_BYTES = 1 << 28

F32 = NDArray[np.float32]
F64 = NDArray[np.float64]


class LensTable(NamedTuple):
    """The frames of an image's tiles, row by row.

    first: int64, the first frame of each tile, and the number of all. turn: float64, 9 a frame: the
    matrix, by rows, from the pinhole's camera coordinates (view.py) to the frame's. back: its
    inverse. bounds: float32, 4 a frame: least x, largest x, least y, largest y that a tile's first,
    last ... pixels have. least_ahead: of each frame. right, down: float32, 256 a frame, 16 a square:
    a pixel's place in the frame, relative to its square's first place on the grid. ahead: the
    same for the frame's Z of a ray's direction; NaN for pixels that are outside of the lens, of the
    image, or in another frame.
    """

    first: NDArray[np.int64]
    turn: F64
    back: F64
    bounds: F32
    least_ahead: F32
    right: F32
    down: F32
    ahead: F32


class SeenLens(NamedTuple):
    """A LensTable, and the numbers of the pinhole camera for it: those of PacketView."""

    first: NDArray[np.int64]
    turn: F64
    back: F64
    bounds: F32
    least_ahead: F32
    right: F32
    down: F32
    ahead: F32
    rows: F64
    ray: F64


_tables: OrderedDict[tuple, LensTable] = OrderedDict()
_lock = threading.Lock()


def lens_table(camera: Camera, size: Size) -> LensTable:
    """Return the table of a camera with a lens. The last ones are kept."""
    key = camera.lens, camera.viewport, camera.distance, tuple(size)
    with _lock:
        if key in _tables:
            _tables.move_to_end(key)
            return _tables[key]
    plain = Camera(viewport=camera.viewport, distance=camera.distance, lens=camera.lens)
    table = _table(plain, size)
    with _lock:
        _tables[key] = table
        while len(_tables) > 1 and sum(map(_bytes, _tables.values())) > _KEPT_BYTES:
            _tables.popitem(last=False)
    return table


def _bytes(table: LensTable) -> int:
    return sum(part.nbytes for part in table)


def _table(camera: Camera, size: Size) -> LensTable:
    width, height = size
    left, right, bottom, top = camera.viewport
    across, down = (right - left) / width, (bottom - top) / height
    # From the pinhole's camera coordinates to points (x, y, z) with the basis of the camera, where
    # z is forwards and the image plane at distance 1.
    pinhole = np.array([[across, 0, (left + right) / 2], [0, down, (bottom + top) / 2], [0, 0, 1]])
    pinhole[:2] /= camera.distance
    parts = [_frames(rays, pinhole) for rays in _tile_rays(camera, size)]
    first = np.concatenate([[0], *(part[0] for part in parts)]).cumsum()
    return LensTable(
        first, *(np.concatenate(part) for part in zip(*(p[1:] for p in parts), strict=True))
    )


def _tile_rays(camera: Camera, size: Size) -> Iterator[F64]:
    """Yield the directions of some tiles' pixels: (tiles, 256, 3), square by square, in units as of
    `pinhole`; NaN outside of the lens and of the image."""
    width, height = size
    across = -(-width // TILE)
    band = max(1, _BAND_PIXELS // (across * _PIXELS)) * TILE
    turn = np.array([1, 1, -1]) / camera.distance
    for top in range(0, height, band):
        rows = min(band, height - top)
        down = -(-rows // TILE)
        rays = np.full((down * TILE, across * TILE, 3), np.nan)
        i, j = np.arange(top, top + rows)[:, None], np.arange(width)
        rays[:rows, :width] = camera.ray(i, j, size).direction * turn
        yield by_squares(rays.reshape(down, TILE, across, TILE, 3).swapaxes(1, 2))


def by_squares(tiles: F64) -> F64:
    """Return the pixels of tiles (..., 16, 16, n) in the order of squares (tiles, 256, n)."""
    squares = TILE // SQUARE
    parts = tiles.reshape(-1, squares, SQUARE, squares, SQUARE, tiles.shape[-1])
    return parts.swapaxes(2, 3).reshape(-1, _PIXELS, tiles.shape[-1])


# The places of a tile's pixels on the grid, (256, 2), and of their squares' first ones.
_GRID = by_squares(np.stack(np.meshgrid(np.arange(TILE), np.arange(TILE)), -1).astype(float)[None])[
    0
]
_FIRST = _GRID // SQUARE * SQUARE


def _frames(rays: F64, pinhole: F64) -> tuple[NDArray, ...]:
    """Return the number of frames of each tile, and the parts of a LensTable for them."""
    unit = rays / np.linalg.norm(rays, axis=2, keepdims=True)
    is_seen = np.isfinite(unit[..., 0])
    axis = np.where(is_seen[..., None], unit, 0).sum(axis=1)
    length = np.linalg.norm(axis, axis=1, keepdims=True)
    axis = np.where(length > 0, axis / np.where(length > 0, length, 1), [0, 0, 1])
    cosine = np.where(is_seen, np.einsum("tpk,tk->tp", unit, axis), 1).min(axis=1)
    count = np.ones(len(rays), np.int64)
    for tile in np.flatnonzero(cosine < _STEEPEST)[::-1]:
        faces, face_axes = _by_faces(rays[tile])
        count[tile] = len(faces)
        rays = np.concatenate([rays[:tile], faces, rays[tile + 1 :]])
        axis = np.concatenate([axis[:tile], face_axes, axis[tile + 1 :]])
    return count, *_fitted(rays, axis, pinhole)


def _by_faces(rays: F64) -> tuple[F64, F64]:
    """Return a tile's rays, divided among the faces of a cube, and the faces' axes."""
    largest = np.abs(rays).argmax(axis=1)
    value = np.take_along_axis(rays, largest[:, None], 1)[:, 0]
    face = np.where(np.isfinite(value), 2 * largest + (value > 0), -1)
    used = np.unique(face[face >= 0])
    axes = np.eye(3)[used // 2] * np.where(used % 2, 1, -1)[:, None]
    return np.where((face == used[:, None])[..., None], rays, np.nan), axes


def _fitted(rays: F64, axis: F64, pinhole: F64) -> tuple[NDArray, ...]:
    """Return the frames of tiles' rays around their axes: a LensTable without `first`."""
    # Right, down and ahead are of the image's orientation: left-handed, as z is forwards.
    helper = np.where(np.abs(axis[:, 1:2]) < 0.8, [0.0, -1.0, 0.0], [1.0, 0.0, 0.0])
    right = np.cross(axis, helper)
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    turned = np.stack([right, np.cross(right, axis), axis], axis=1)
    local = rays @ turned.swapaxes(1, 2)
    ahead = local[..., 2]
    is_seen = ahead > 0
    place = np.where(is_seen[..., None], local[..., :2] / np.where(is_seen, ahead, 1)[..., None], 0)
    # The affine map of places to the grid that fits best.
    weight = is_seen / np.maximum(is_seen.sum(axis=1, keepdims=True), 1)
    middle, middle_grid = weight[:, None] @ place, weight @ _GRID
    place -= middle
    offset = weight[..., None] * (_GRID - middle_grid[:, None])
    spread = (place * weight[..., None]).swapaxes(1, 2) @ place
    volume = np.linalg.det(spread)
    is_flat = volume <= 1e-9 * np.trace(spread, axis1=1, axis2=2) ** 2
    spread[is_flat] = np.eye(2)
    fit = offset.swapaxes(1, 2) @ place @ np.linalg.inv(spread)
    fit[is_flat | (np.linalg.det(fit) <= 0)] = np.eye(2) / max(np.abs(np.diag(pinhole)[:2]))
    image = np.zeros_like(turned)
    image[:, :2, :2], image[:, 2, 2] = fit, 1
    image[:, :2, 2] = middle_grid - (fit @ middle.swapaxes(1, 2))[..., 0]
    turn = image @ turned @ pinhole
    at = place @ fit.swapaxes(1, 2) + middle_grid[:, None]
    away = np.where(is_seen[..., None], at - _GRID, 0)
    low, high = away.min(axis=1), away.max(axis=1) + (TILE - 1)
    bounds = np.stack([low, high], axis=2)
    bounds += np.array([-2e-7, 2e-7]) * np.abs(bounds)
    at = np.where(is_seen[..., None], at - _FIRST, 0)
    parts = (
        turn,
        np.linalg.inv(turn),
        bounds,
        np.where(is_seen, ahead, np.inf).min(axis=1),
        at[..., 0],
        at[..., 1],
        np.where(is_seen, ahead, np.nan),
    )
    kinds = (np.float64,) * 2 + (np.float32,) * 5
    return tuple(part.astype(kind).reshape(-1) for part, kind in zip(parts, kinds, strict=True))
