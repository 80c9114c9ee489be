"""Which places of a drawing are on the page and not hidden by the scene, by a picture's depths.

Pure. Positions are in pixels of the page; depths are s: 1 / t in perspective, t in parallel
projection (screen.py).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Size = tuple[int, int]

BEHIND = 1.001  # times the scene's t, as the window's picture has it


class Hidden:
    """t: (height, width), the scene's ray parameters, infinity for none; None: nothing is hidden.

    A place is hidden where the scene is nearer in all of the nine pixels around it: an object's own
    edge is between pixels of it and others, and must be seen.
    """

    def __init__(self, t: NDArray[np.float32] | None, parallel: bool) -> None:
        self._parallel = parallel
        self._around: NDArray[np.float32] | None = None
        self._t: NDArray[np.float32] | None = None
        if t is not None:
            height, width = t.shape
            wide = np.pad(np.where(np.isnan(t), np.inf, t), 1, mode="edge")
            self._around = np.array(
                [wide[i : i + height, j : j + width] for i in range(3) for j in range(3)]
            )
            self._t = self._around.max(axis=0)

    def at(self, points: Floats, depth: Floats) -> Bools:
        """Return whether each place (n, 2) with its depth s (n,) is hidden by the scene. False off
        the page.
        """
        return self._behind(points, depth, self._t, BEHIND)

    def partly(self, points: Floats, depth: Floats) -> Bools:
        """Return whether the scene is nearer in any of the nine pixels around each place."""
        nearest = None if self._around is None else self._around.min(axis=0)
        return self._behind(points, depth, nearest, 1.0)

    def _behind(
        self, points: Floats, depth: Floats, t_of_page: NDArray[np.float32] | None, factor: float
    ) -> Bools:
        if t_of_page is None or not len(points):
            return np.zeros(len(points), bool)
        height, width = t_of_page.shape
        column, row = np.floor(np.clip(np.nan_to_num(points, nan=-1.0), -1, 1e6)).astype(int).T
        inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
        scene = t_of_page[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
        with np.errstate(all="ignore"):
            t = depth if self._parallel else np.where(depth > 0, 1 / depth, np.inf)
        found: Bools = inside & (t > factor * scene)
        return found


def clipped(
    points: Floats, depth: Floats, size: Size, margin: float = 0.0
) -> tuple[Floats, Floats, NDArray[np.int64]]:
    """Segments (n, 2, 2) and depths (n, 2) cut at the page's edge, and which they were.

    margin: by which the page is larger. Source: Liang and Barsky 1984.
    """
    low, high = np.zeros(len(points)), np.ones(len(points))
    along = points[:, 1] - points[:, 0]
    with np.errstate(all="ignore"):
        for axis in range(2):
            for sign, edge in ((-1.0, -margin), (1.0, size[axis] + margin)):
                way = sign * along[:, axis]
                room = sign * (edge - points[:, 0, axis])
                cut = room / way
                low = np.where(way < 0, np.maximum(low, cut), low)
                high = np.where(way > 0, np.minimum(high, cut), high)
                high = np.where((way == 0) & (room < 0), -1.0, high)
    kept = low < high
    low, high = low[kept, None], high[kept, None]
    start, along = points[kept, 0], along[kept]
    deeper = (depth[kept, 1] - depth[kept, 0])[:, None]
    first = depth[kept, :1]
    # An end that is not cut keeps its very numbers: lines are joined by them.
    ends = np.where(low == 0, start, start + low * along)
    others = np.where(high == 1, points[kept, 1], start + high * along)
    depths = np.concatenate([first + low * deeper, first + high * deeper], axis=1)
    return np.stack([ends, others], axis=1), depths, np.flatnonzero(kept).astype(np.int64)


def cut_polygon(points: Floats, size: Size) -> Floats:
    """A convex polygon (n, 2) cut at the page's edge. Source: Sutherland and Hodgman 1974."""
    for axis in range(2):
        for sign, edge in ((1.0, 0.0), (-1.0, float(size[axis]))):
            if not len(points):
                return points
            here = sign * (points[:, axis] - edge)
            after, there = np.roll(points, -1, axis=0), np.roll(here, -1)
            parts = []
            for k in range(len(points)):
                if here[k] >= 0:
                    parts.append(points[k])
                if (here[k] >= 0) != (there[k] >= 0):
                    parts.append(
                        points[k] + here[k] / (here[k] - there[k]) * (after[k] - points[k])
                    )
            points = np.array(parts).reshape(-1, 2)
    return points


def divided(points: Floats, depth: Floats, hidden: Hidden) -> tuple[Floats, Bools]:
    """Segments (n, 2, 2) in pieces that are wholly seen or wholly hidden, to about a pixel, and
    whether each piece is hidden."""
    if not len(points):
        return points, np.zeros(0, bool)
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    counts = np.maximum(np.ceil(lengths), 1).astype(int)
    of = np.repeat(np.arange(len(points)), counts)
    first = np.cumsum(counts) - counts
    place = np.arange(len(of)) - first[of]
    part = (place + 0.5) / counts[of]
    spots = points[of, 0] + part[:, None] * (points[of, 1] - points[of, 0])
    deep = depth[of, 0] + part * (depth[of, 1] - depth[of, 0])
    behind = hidden.at(spots, deep)
    begins = np.ones(len(of), bool)
    begins[1:] = (of[1:] != of[:-1]) | (behind[1:] != behind[:-1])
    start = np.flatnonzero(begins)
    last = np.append(start[1:], len(of)) - 1
    of, behind = of[start], behind[start]
    low, high = place[start] / counts[of], (place[last] + 1) / counts[of]
    along = points[of, 1] - points[of, 0]
    ends = np.where((low == 0)[:, None], points[of, 0], points[of, 0] + low[:, None] * along)
    others = np.where((high == 1)[:, None], points[of, 1], points[of, 0] + high[:, None] * along)
    return np.stack([ends, others], axis=1), behind


def runs_of(values: Bools) -> Iterator[tuple[int, int, bool]]:
    """(first, one past the last, value) of each run of equal values."""
    changes = np.flatnonzero(values[1:] != values[:-1]) + 1
    bounds = [0, *changes.tolist(), len(values)]
    for start, end in pairwise(bounds):
        if end > start:
            yield start, end, bool(values[start])
