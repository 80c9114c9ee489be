"""The pinhole images by which a rasterizer draws the image of a lens.

No projection matrix describes a lens. A rasterizer therefore draws pinhole images, called faces:
one if it contains the lens's whole image, otherwise up to six faces of a cube around the eye. Each
pixel of the lens's image looks up the texel of a face in which its ray ends.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .camera import Camera
from .checks import Floats
from .image_plane import LARGEST_KEPT, Size
from .lenses import Lens

WIDEST = 2.0  # one pinhole image reaches to this tangent: 63 degrees from its axis
MOST_SIDE, MOST_TEXELS = 8192, 1 << 25  # limits for a face, and for all faces

# The face number of pixels where the lens shows nothing.
OUTSIDE = -1
# The cube's faces, as columns u, v, w in units of the camera's.
_AHEAD = np.eye(3)
_CUBE = tuple(
    np.column_stack([np.cross(v, -np.array(look)), v, -np.array(look)]).astype(float)
    for look, v in (
        ((1, 0, 0), (0, 1, 0)),
        ((-1, 0, 0), (0, 1, 0)),
        ((0, 1, 0), (0, 0, 1)),
        ((0, -1, 0), (0, 0, -1)),
        ((0, 0, 1), (0, 1, 0)),
        ((0, 0, -1), (0, 1, 0)),
    )
)


class Face(NamedTuple):
    """A pinhole image. camera: its pinhole camera, of the same eye.

    unit: (3,). A face's ray parameter t is t * stretch along the lens's ray through the same point,
    with the stretch |unit * (x, y, 1)| of the point (x, y) on the face's plane at distance 1.
    """

    camera: Camera
    size: Size
    unit: tuple[float, float, float]

    @property
    def plane(self) -> tuple[float, float, float, float]:
        """The middle (x, y) of the image on the plane at distance 1, and a pixel's steps there."""
        left, right, bottom, top = (edge / self.camera.distance for edge in self.camera.viewport)
        steps = (right - left) / self.size[0], (top - bottom) / self.size[1]
        return (left + right) / 2, (bottom + top) / 2, *steps

    def stretch(self, i: NDArray[Any], j: NDArray[Any]) -> Floats:
        """Return the stretch at rows and columns of the face, which may be fractional."""
        x, y = (part / self.camera.distance for part in self.camera.image_point(i, j, self.size))
        right, up, ahead = self.unit
        stretch: Floats = np.sqrt((right * x) ** 2 + (up * y) ** 2 + ahead**2)
        return stretch


class Faces(NamedTuple):
    """The faces of an image. positions: read-only float32 (height, width, 3): each pixel's place on
    its face, in texels from the face's middle, x right and y up, and the face's number or OUTSIDE.
    """

    faces: tuple[Face, ...]
    positions: NDArray[np.float32]

    def place(self, number: int, i: NDArray[Any], j: NDArray[Any]) -> tuple[Floats, Floats]:
        """Return the fractional rows and columns of pixels (i, j) on their face `number`."""
        (width, height), position = self.faces[number].size, self.positions[i, j].astype(float)
        return (height - 1) / 2 - position[:, 1], position[:, 0] + (width - 1) / 2

    def texel(self, number: int, i: NDArray[Any], j: NDArray[Any]) -> tuple[Floats, Floats]:
        """Return rows and columns of the texels that pixels (i, j) look up on it, as in
        lens.glsl.
        """
        (width, height), position = self.faces[number].size, self.positions[i, j]
        row = np.floor(np.float32(height / 2) - position[:, 1])
        column = np.floor(np.float32(width / 2) + position[:, 0])
        return row.clip(0, height - 1).astype(float), column.clip(0, width - 1).astype(float)


class _Part(NamedTuple):
    """A face in units of the camera's basis. turn: (3, 3), its u, v, w as columns. viewport: on the
    plane at distance 1.
    """

    turn: Floats
    viewport: tuple[float, float, float, float]
    size: Size


def looked_up_faces(camera: Camera, size: Size, enlargement: int = 1) -> Faces:
    """Return the faces for an image of a camera with a lens, with about `enlargement` texels per
    pixel at the lens's middle along a side, but no more than MOST_TEXELS.
    """
    assert camera.lens is not None
    kept = _kept if size[0] * size[1] <= LARGEST_KEPT else _kept_large
    parts, positions = kept(camera.lens, camera.viewport, camera.distance, size, enlargement)
    return Faces(tuple(_face(camera, part) for part in parts), positions)


def _face(camera: Camera, part: _Part) -> Face:
    assert camera.lens is not None
    u, v, w = (tuple(column.tolist()) for column in (camera.basis @ part.turn).T)
    left, right, bottom, top = (camera.distance * edge for edge in part.viewport)
    unit = np.abs(part.turn.T) @ camera.lens.length(*np.eye(3))
    pinhole = replace(camera.pinhole, u=u, v=v, w=w, viewport=(left, right, bottom, top))
    return Face(pinhole, part.size, tuple(unit.tolist()))


def _directions(
    lens: Lens, viewport: tuple[float, float, float, float], distance: float, size: Size
) -> Floats:
    camera = Camera(viewport=viewport, distance=distance, lens=lens)
    return camera.lens_directions(size)


def _looked_up(
    lens: Lens,
    viewport: tuple[float, float, float, float],
    distance: float,
    size: Size,
    enlargement: int,
) -> tuple[tuple[_Part, ...], NDArray[np.float32]]:
    directions = _directions(lens, viewport, distance, size)
    positions = np.zeros((size[1], size[0], 3), np.float32)
    seen = np.isfinite(directions[..., 0])
    positions[~seen, 2] = OUTSIDE
    if not seen.any():
        return (), positions
    left, right, bottom, top = viewport
    pixel = np.array([(right - left) / size[0], (top - bottom) / size[1]]) / distance
    groups = _groups(directions, seen)
    planes = []
    for turn, mine in groups:
        place = turn.T @ (directions if mine.all() else directions[mine]).reshape(-1, 3).T
        planes.append(place[:2] / -place[2])  # rows x and y
    lows = [plane.min(axis=1) for plane in planes]
    spans = np.array([plane.max(axis=1) - low for plane, low in zip(planes, lows, strict=True)])
    texel = pixel / enlargement
    texel *= max(1.0, *(spans / texel / (MOST_SIDE - 2)).ravel())
    texel *= max(1.0, math.sqrt((np.ceil(spans / texel) + 1).prod(axis=1).sum() / MOST_TEXELS))
    parts = []
    for number, ((turn, mine), plane, low, span) in enumerate(
        zip(groups, planes, lows, spans, strict=True)
    ):
        width, height = (int(side) + 1 for side in np.ceil(span / texel))
        first = low - texel / 2
        last = first + texel * (width, height)
        box = float(first[0]), float(last[0]), float(first[1]), float(last[1])
        parts.append(_Part(turn, box, (width, height)))
        for k in range(2):
            positions[..., k][mine] = (plane[k] - (first[k] + last[k]) / 2) / texel[k]
        positions[..., 2][mine] = number
    positions.flags.writeable = False
    return tuple(parts), positions


_kept = lru_cache(maxsize=3)(_looked_up)
_kept_large = lru_cache(maxsize=1)(_looked_up)  # up to 100 MB at 3840 x 2160


def _groups(directions: Floats, seen: NDArray[np.bool_]) -> list[tuple[Floats, NDArray[np.bool_]]]:
    """Return the faces' bases in units of the camera's, each with the mask of its pixels."""
    x, y, z = np.moveaxis(directions, -1, 0)
    across, up, along = abs(x), abs(y), abs(z)
    inside = (across <= WIDEST * -z) & (up <= WIDEST * -z)
    if np.count_nonzero(inside) == np.count_nonzero(seen):
        return [(_AHEAD, seen)]
    by_x = (across >= up) & (across >= along)
    by_y = ~by_x & (up >= along)
    by_z = seen & ~by_x & ~by_y
    sides = by_x & (x > 0), by_x & (x <= 0), by_y & (y > 0), by_y & (y <= 0), by_z & (z > 0)
    groups = zip(_CUBE, (*sides, by_z & (z <= 0)), strict=True)
    return [(turn, mine) for turn, mine in groups if mine.any()]
