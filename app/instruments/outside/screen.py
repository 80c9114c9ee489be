"""The screen of the outside camera: projection from the world to pixels, with clipping.

The projection is float64. Pure. Positions are in pixels from the upper left corner, x to the right,
y down. Depths are s: 1 / t in perspective, t in parallel projection. s is affine on the screen.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.raster.overlay import Plane, plane_on_screen

from .frustum import plane_corners

GUARD = 4.0  # things farther out than this many images from the middle are cut off
NEAREST = 1e-4  # the least distance to the outside camera, relative to that of the scene


class Seen(NamedTuple):
    """Points on the screen.

    spots (..., 4): see homogeneous(). points (..., 2), depth (...): see on_screen(). visible (...):
    True for visible points.
    """

    spots: Floats
    points: Floats
    depth: Floats
    visible: NDArray[np.bool_]


class OutsideScreen:
    """The outside camera and its image of `size` pixels.

    near: the least t that is drawn. unit_px: the width of a line. symbol_px: the factor for the
    sizes of heads, dots and the eye; unit_px if not given.
    """

    def __init__(
        self,
        camera: Camera,
        size: Size,
        near: float = 1e-6,
        unit_px: float = 1.0,
        symbol_px: float | None = None,
    ) -> None:
        self.camera, self.size, self.unit_px = camera, size, unit_px
        self.symbol_px = unit_px if symbol_px is None else symbol_px
        self.near = max(near, 1e-30)
        self._matrix = camera.image_from_world(size)
        self._middle = np.asarray(size, float) / 2
        # Half-spaces of (X, Y, T, 1) that are drawn: beyond near, inside the guard.
        x, y = GUARD * self._middle
        weight = (0.0, 1.0) if camera.is_parallel else (1.0, 0.0)
        self._planes = np.array(
            [
                (0, 0, 1, -self.near),
                (1, 0, x * weight[0], x * weight[1]),
                (-1, 0, x * weight[0], x * weight[1]),
                (0, 1, y * weight[0], y * weight[1]),
                (0, -1, y * weight[0], y * weight[1]),
            ]
        )

    def homogeneous(self, points: Floats) -> Floats:
        """Return (X, Y, T, 1) of world points (..., 3). In perspective X and Y are times T."""
        points = np.asarray(points, float)
        out = np.ones((*points.shape[:-1], 4))
        out[..., :3] = points @ self._matrix[:, :3].T + self._matrix[:, 3]
        return out

    def on_screen(self, spots: Floats) -> tuple[Floats, Floats]:
        """Return pixels (..., 2) and depths (...) of points from homogeneous() with T > 0."""
        t = spots[..., 2]
        if self.camera.is_parallel:
            return spots[..., :2] + self._middle, t
        return spots[..., :2] / t[..., None] + self._middle, 1 / t

    def segments(self, world: Floats) -> tuple[Floats, Floats, NDArray[np.int64]]:
        """Clip segments (n, 2, 3). Return points (m, 2, 2), depths (m, 2) and the segments' numbers
        (m,).
        """
        spots = self.homogeneous(np.reshape(world, (-1, 2, 3)))
        spots[~np.isfinite(spots).all(axis=(1, 2))] = 0.0
        spots, numbers = cut_segments(spots, self._planes)
        return *self.on_screen(spots), numbers

    def polygon(self, world: Floats) -> tuple[Floats, Floats]:
        """Clip a convex polygon (n, 3). Return points (m, 2) and depths (m,)."""
        spots = self.homogeneous(world)
        if not np.isfinite(spots).all():
            spots = spots[:0]
        return self.on_screen(cut_polygon(spots, self._planes))

    def seen(self, world: Floats) -> Seen:
        """Project points (..., 3). Only `spots` is meaningful for invisible ones."""
        spots = self.homogeneous(world)
        with np.errstate(all="ignore"):
            visible = (spots @ self._planes.T >= 0).all(axis=-1)  # NaN is never visible
            return Seen(spots, *self.on_screen(spots), visible)

    def px_world(self, t: float) -> float:
        """Return a pixel's width in world units at a distance t in front of the camera."""
        camera = self.camera
        step = (camera.viewport[1] - camera.viewport[0]) / self.size[0]
        length = step * math.hypot(*camera.u)
        return length if camera.is_parallel else length * t

    def toward_viewer(self, point: Floats) -> Floats:
        """Return the unit vector from a point to the outside camera's eye."""
        camera = self.camera
        way = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye) - point
        length = math.hypot(*way.tolist())
        return way / length if length > 0 else np.asarray(camera.w) / np.linalg.norm(camera.w)


def image_plane(camera: Camera, looking: Camera, size: Size) -> Plane | None:
    """Return a camera's image plane in the picture of another one, of `size`; None if it is seen
    edge-on.
    """
    corners = plane_corners(camera)[[0, 1, 3]]
    behind = corners[0] + np.asarray(camera.w)  # the side from which it is upright
    return plane_on_screen(looking, size, corners, behind)


def cut_segments(segments: Floats, planes: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Return the parts of segments (n, 2, k) inside all half-spaces plane @ point >= 0, and the
    numbers of the segments.

    Source: Cyrus and Beck 1978.
    """
    inside = segments @ planes.T
    if (inside >= 0).all():
        return segments, np.arange(len(segments))
    start, end = inside[:, 0], inside[:, 1]
    with np.errstate(all="ignore"):
        cut = start / (start - end)
    low = np.where((start < 0) & (end >= 0), cut, 0.0).max(axis=1)
    high = np.where((end < 0) & (start >= 0), cut, 1.0).min(axis=1)
    kept = np.flatnonzero((low <= high) & ~((start < 0) & (end < 0)).any(axis=1)).astype(np.int64)
    segments, low, high = segments[kept], low[kept, None], high[kept, None]
    along = segments[:, 1] - segments[:, 0]
    # An end that is not cut keeps its exact numbers, by which lines are joined.
    last = np.where(high == 1, segments[:, 1], segments[:, 0] + high * along)
    return np.stack([segments[:, 0] + low * along, last], axis=1), kept


def cut_polygon(corners: Floats, planes: Floats) -> Floats:
    """Return the part of a convex polygon (n, k) inside all half-spaces plane @ point >= 0.

    Source: Sutherland and Hodgman 1974.
    """
    for plane in planes:
        here = corners @ plane
        if (here >= 0).all():
            continue
        after = np.roll(corners, -1, axis=0)
        there = after @ plane
        parts = []
        for k in range(len(corners)):
            if here[k] >= 0:
                parts.append(corners[k])
            if (here[k] >= 0) != (there[k] >= 0):
                part = here[k] / (here[k] - there[k])
                parts.append(corners[k] + part * (after[k] - corners[k]))
        corners = np.reshape(parts, (-1, corners.shape[1]))
    return corners
