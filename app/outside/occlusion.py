"""Visibility in a vector drawing: what is on the page, and what the scene hides there.

Pure. Positions are in pixels of the page; depths are s: 1 / t in perspective, t in parallel
projection (screen.py).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.outside.screen import cut_polygon, cut_segments

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Size = tuple[int, int]

BEHIND = 1.001  # times the scene's t, as the window's picture has it


class Hidden:
    """The depths of a page, which tell what is hidden.

    t: (height, width), the scene's ray parameters, infinity for none; None: nothing is hidden. A
    place is hidden if the scene is nearer in all nine pixels around it: an object's own edge lies
    between its pixels and others, and must stay visible.
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
) -> tuple[Floats, Floats]:
    """Cut segments (n, 2, 2) with depths (n, 2) at the edge of the page.

    margin: by which the page is larger.
    """
    rows = np.concatenate([points, depth[..., None]], axis=-1)
    found, _ = cut_segments(_rows(rows), _page(size, margin))
    return found[..., :2], found[..., 2]


def on_page(points: Floats, size: Size) -> Floats:
    """Return the part of a convex polygon (n, 2) on the page."""
    depth = np.zeros((len(points), 1))
    return cut_polygon(_rows(np.hstack([points, depth])), _page(size, 0.0))[:, :2]


def _rows(places: Floats) -> Floats:
    """Return (x, y, s, 1) of (x, y, s)."""
    return np.concatenate([places, np.ones((*places.shape[:-1], 1))], axis=-1)


def _page(size: Size, margin: float) -> Floats:
    """Return the half-spaces of (x, y, s, 1) that bound the page."""
    width, height = size
    return np.array(
        [
            (1, 0, 0, margin),
            (-1, 0, 0, width + margin),
            (0, 1, 0, margin),
            (0, -1, 0, height + margin),
        ]
    )


def divided(points: Floats, depth: Floats, hidden: Hidden) -> tuple[Floats, Bools]:
    """Divide segments (n, 2, 2) where they become hidden or visible, to about a pixel. Return the
    pieces, and whether each is hidden.
    """
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
