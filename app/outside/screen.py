"""The screen of the outside camera: from the world to pixels, clipped to the visible part.

The projection is float64. Pure. Positions are in pixels from the upper left corner, x right, y
down. Depths are s: 1 / t in perspective, t in parallel projection, which are affine on the screen.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.raster.overlay import screen_from_world

Floats = NDArray[np.float64]
Size = tuple[int, int]

GUARD = 4.0  # times the image, from its middle: what is farther out is cut off
NEAREST = 1e-4  # of the distance to the scene: what is nearer to the looking camera is cut off


class OutsideScreen:
    """The camera that looks, its image of `size` pixels. near: the least t that is drawn, from
    the distance of what is looked at. unit_px: the width of a line that teaches; symbol_px: what
    the sizes of heads, dots and the eye are multiplied with, as a line's width if not given."""

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
        self._matrix = screen_from_world(camera, size)
        self._middle = np.asarray(size, float) / 2
        # Half-spaces of (X, Y, T, 1) in which things are drawn: before near, beside the guard.
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
        """(X, Y, T, 1) of world points (..., 3); X and Y are multiplied by T in perspective."""
        points = np.asarray(points, float)
        out = np.ones((*points.shape[:-1], 4))
        out[..., :3] = points @ self._matrix[:, :3].T + self._matrix[:, 3]
        return out

    def on_screen(self, spots: Floats) -> tuple[Floats, Floats]:
        """Pixels (..., 2) and depths (...) of what homogeneous() gave and T > 0."""
        t = spots[..., 2]
        if self.camera.is_parallel:
            return spots[..., :2] + self._middle, t
        return spots[..., :2] / t[..., None] + self._middle, 1 / t

    def segments(self, world: Floats) -> tuple[Floats, Floats, NDArray[np.int64]]:
        """Clip segments (n, 2, 3). Return points (m, 2, 2), depths (m, 2) and the segments' numbers
        (m,).
        """
        world = np.reshape(world, (-1, 2, 3))
        spots = self.homogeneous(world)
        spots[~np.isfinite(spots).all(axis=(1, 2))] = 0.0
        inside = spots @ self._planes.T  # (n, 2, planes)
        start, end = inside[:, 0], inside[:, 1]
        with np.errstate(all="ignore"):
            cut = start / (start - end)
        low = np.where((start < 0) & (end >= 0), cut, 0.0).max(axis=1)
        high = np.where((end < 0) & (start >= 0), cut, 1.0).min(axis=1)
        kept = (low <= high) & ~((start < 0) & (end < 0)).any(axis=1)
        spots, low, high = spots[kept], low[kept, None], high[kept, None]
        along = spots[:, 1] - spots[:, 0]
        cut_spots = np.stack([spots[:, 0] + low * along, spots[:, 0] + high * along], axis=1)
        points, depth = self.on_screen(cut_spots)
        return points, depth, np.flatnonzero(kept).astype(np.int64)

    def polygon(self, world: Floats) -> tuple[Floats, Floats]:
        """Clip a convex polygon (n, 3). Return points (m, 2) and depths (m,).

        Source: Sutherland and Hodgman 1974.
        """
        spots = self.homogeneous(world)
        if not np.isfinite(spots).all():
            spots = spots[:0]
        for plane in self._planes:
            if not len(spots):
                break
            after = np.roll(spots, -1, axis=0)
            here, there = spots @ plane, after @ plane
            parts = []
            for k in range(len(spots)):
                if here[k] >= 0:
                    parts.append(spots[k])
                if (here[k] >= 0) != (there[k] >= 0):
                    part = here[k] / (here[k] - there[k])
                    parts.append(spots[k] + part * (after[k] - spots[k]))
            spots = np.array(parts).reshape(-1, 4)
        return self.on_screen(spots)

    def spot(self, point: Floats) -> tuple[Floats, float] | None:
        """A point's pixel (2,) and depth; None where it is not to be seen."""
        spots = self.homogeneous(point)
        if not np.isfinite(spots).all() or (self._planes @ spots < 0).any():
            return None
        at, depth = self.on_screen(spots)
        return at, float(depth)

    def spots(self, points: Floats) -> Floats | None:
        """The pixels (n, 2) of points (n, 3); None unless all are to be seen."""
        spots = self.homogeneous(points)
        if not np.isfinite(spots).all() or (spots @ self._planes.T < 0).any():
            return None
        return self.on_screen(spots)[0]

    def px_world(self, point: Floats) -> float:
        """A pixel's width in world units at a point in front."""
        camera = self.camera
        step = (camera.viewport[1] - camera.viewport[0]) / self.size[0]
        length = step * float(np.linalg.norm(camera.u))
        return length if camera.is_parallel else length * float(self.homogeneous(point)[2])

    def toward_viewer(self, point: Floats) -> Floats:
        """The unit vector from a point to the eye that looks."""
        camera = self.camera
        way = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye) - point
        length = float(np.linalg.norm(way))
        return way / length if length > 0 else np.asarray(camera.w) / np.linalg.norm(camera.w)
