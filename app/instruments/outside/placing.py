"""Places for the labels of the outside view: next to their points, where they cover nothing.

Each label in turn takes the best of a few places around its point. Places from the previous picture
are kept while they are good, so that labels do not jump while the view turns. Pure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Floats

from .projected import Primitive, Shape, Strokes, Text

Spot = tuple[float, float]
Sums = NDArray[np.float32]
Label = tuple[str, str, int]  # name, role, number of earlier labels with both

# Places: turns from the label's own direction, and distances in heights of the text.
TURNS = np.radians([0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180])
FARTHER = (0.0, 0.8, 1.8)
# Costs of a place: half a turn, a height farther out, outside the view,
# on another label, on a mark, a line through the text, per height of the text.
TURNED, OUT, OUTSIDE, LABEL, MARK, CROSSED = 1.2, 0.8, 60.0, 40.0, 18.0, 3.0
CELL = 0.15  # the size of a grid cell, in heights of a text
DOT = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1]), axis=-1).reshape(-1, 2)  # times the radius
# Places along a line, as many as turns: shares of its length, on both sides of it; and the costs of
# the other side, and of the distance from the middle.
SHARES = np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.2])
OTHER_SIDE, SLID = 0.4, 1.0
ALONG = 1.5  # space to a line, relative to that to a point: arrows have wide heads
JUMP_PX = 60.0  # a point that has moved farther since the previous picture has jumped
KEPT = 1.0  # the advantage that another place must have over the current one
SPACE = 0.12  # around a text, in its heights


@dataclass(frozen=True)
class Box:
    """The size of a text, and the space between it and its point, in pixels."""

    width: float
    height: float
    room: float


@dataclass
class LabelPlacer:
    """A placer of one view's labels, which remembers their places in the previous picture."""

    _chosen: dict[Label, tuple[Spot, int]] = field(default_factory=dict)
    _size: tuple[float, float] = (0.0, 0.0)

    def place(
        self,
        primitives: Sequence[Primitive],
        boxes: Sequence[Box],
        size: tuple[float, float],
    ) -> list[Spot]:
        """Return the centres of the texts among the primitives, in their order.

        boxes: the boxes of those texts. size: the view's size.
        """
        if size != self._size:
            self._chosen, self._size = {}, size
        texts = [part for part in primitives if isinstance(part, Text)]
        labels = _labels(texts)
        before = self._chosen if self._is_moving(labels, texts) else {}
        self._chosen = {}
        if not texts:
            return []
        found = [_places(text, box) for text, box in zip(texts, boxes, strict=True)]
        places, preferences = (np.stack(parts) for parts in zip(*found, strict=True))
        wide = np.array([(box.width, box.height) for box in boxes]) / 2
        wide += SPACE * np.array([[box.height] for box in boxes])
        around = np.concatenate([places - wide[:, None], places + wide[:, None]], axis=2)
        areas = (around[:, :1, 2:] - around[:, :1, :2]).prod(axis=2)  # all have one size
        inside = _overlap(around, np.array([(0.0, 0.0, *size)]))[..., 0] / areas
        costs = preferences + OUTSIDE * (1 - inside)
        height = max(box.height for box in boxes)
        costs += _covered(around / (CELL * height), _sums(primitives, height, size))
        centers: list[Spot] = [(0.0, 0.0)] * len(texts)
        taken = np.zeros((len(texts), 4))
        order = sorted(range(len(texts)), key=lambda k: (not texts[k].fixed, not texts[k].strong))
        for number in order:
            text, label, of_text = texts[number], labels[number], around[number]
            cost = costs[number] + LABEL * _overlap(of_text, taken).sum(axis=1) / areas[number]
            if label in before:
                cost[before[label][1]] -= KEPT
            best = 0 if text.fixed else int(cost.round(3).argmin())  # equal: the first
            self._chosen[label] = text.at, best
            x, y = places[number, best].tolist()
            (far_x, far_y), (wide_x, wide_y) = size, wide[number].tolist()
            if 0 < text.at[0] < far_x and 0 < text.at[1] < far_y:  # its point is in sight
                x = min(max(x, wide_x), max(far_x - wide_x, wide_x))
                y = min(max(y, wide_y), max(far_y - wide_y, wide_y))
            centers[number] = x, y
            taken[number] = x - wide_x, y - wide_y, x + wide_x, y + wide_y
        return centers

    def _is_moving(self, labels: Sequence[Label], texts: Sequence[Text]) -> bool:
        """Return True if the view moves smoothly; otherwise the previous places are useless."""
        ways = [
            math.dist(self._chosen[label][0], text.at)
            for label, text in zip(labels, texts, strict=True)
            if label in self._chosen
        ]
        return 0 < max(ways, default=0.0) < JUMP_PX


def _labels(texts: Sequence[Text]) -> list[Label]:
    """Return names of texts that stay the same from frame to frame."""
    names = [(text.name, text.role) for text in texts]
    return [(*name, names[:number].count(name)) for number, name in enumerate(names)]


def _places(text: Text, box: Box) -> tuple[Floats, Floats]:
    """Return the centres of a label's places (n, 2), and their costs (n,). The text's box touches a
    circle around the point from outside, or a line.
    """
    if text.line is None or not (way := text.line[1] - text.line[0]).any():
        starts, room = np.array([text.at]), box.room
        angles, costs = math.atan2(*text.toward[::-1]) + TURNS, TURNED * np.abs(TURNS) / math.pi
    else:
        starts = np.repeat(text.line[0] + SHARES[:, None] * way, 2, axis=0)
        room = ALONG * box.room
        normal = math.atan2(way[0], -way[1])
        if math.cos(normal) * text.toward[0] + math.sin(normal) * text.toward[1] < 0:
            normal += math.pi
        angles = normal + np.tile([0.0, math.pi], len(SHARES))
        slid = np.repeat(SLID * np.abs(SHARES - 0.5), 2)
        costs = slid + np.tile([0.0, OTHER_SIDE], len(SHARES))
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    reach = room + np.abs(ways) @ (box.width / 2, box.height / 2)
    out = np.add.outer(np.multiply(FARTHER, box.height), reach)
    places = starts + out[..., None] * ways
    return places.reshape(-1, 2), np.add.outer(np.multiply(OUT, FARTHER), costs).ravel()


def _sums(primitives: Iterable[Primitive], height: float, size: tuple[float, float]) -> Sums:
    """Return a summed-area table (Crow 1984) of everything that labels should not cover: lines, by
    their lengths in heights of a text, dots, and arrowheads.
    """
    strokes = [part for part in primitives if isinstance(part, Strokes)]
    ends = np.concatenate([np.zeros((0, 2, 2)), *(part.points for part in strokes)])
    looks = np.array([(part.opacity, part.width_px / 2) for part in strokes]).reshape(-1, 2)
    opacity, radius = np.repeat(looks, [len(part.points) for part in strokes], axis=0).T
    ways = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(ways, axis=1)
    cell_px = CELL * height
    counts = np.maximum(np.ceil(lengths / cell_px), 1).astype(int)
    of = np.repeat(np.arange(len(ends)), counts)
    place = np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)
    is_dot = lengths == 0
    dots = ends[is_dot, :1] + radius[is_dot, None, None] * DOT
    shapes = [part for part in primitives if isinstance(part, Shape)]
    marks = [part.points for part in shapes if part.opacity >= 0.5]  # heads, and the marked pixel
    spots = [ends[of, 0] + ((place + 0.5) / counts[of])[:, None] * ways[of], *dots, *marks]
    weights = [(CROSSED * opacity * lengths / counts / height)[of]]
    weights += [np.full(len(corners), MARK / len(corners)) for corners in spots[1:]]
    columns, rows = (math.ceil(side / cell_px) for side in size)
    column, row = np.floor(np.concatenate(spots) / cell_px).astype(int).T
    inside = (column >= 0) & (row >= 0) & (column < columns) & (row < rows)
    cells, values = (row * columns + column)[inside], np.concatenate(weights)[inside]
    sums = np.zeros((rows + 1, columns + 1), np.float32)
    sums[1:, 1:] = np.bincount(cells, values, rows * columns).reshape(rows, columns)
    for axis in (0, 1):
        sums.cumsum(axis=axis, out=sums)
    return sums


def _covered(boxes: Floats, sums: Sums) -> Sums:
    """Return the sums over all cells that boxes (..., 4), in cells, touch."""
    most = np.array(sums.shape[::-1] * 2) - 1
    edges = np.concatenate([np.floor(boxes[..., :2]), np.ceil(boxes[..., 2:])], axis=-1)
    left, top, right, bottom = np.moveaxis(np.clip(edges, 0, most).astype(int), -1, 0)
    found: Sums = sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left]
    return found


def _overlap(boxes: Floats, others: Floats) -> Floats:
    """Return the areas (..., m) that boxes (..., 4) share with others (m, 4)."""
    left, top, right, bottom = (boxes[..., side, None] for side in range(4))
    wide = np.minimum(right, others[:, 2]) - np.maximum(left, others[:, 0])
    high = np.minimum(bottom, others[:, 3]) - np.maximum(top, others[:, 1])
    return np.maximum(wide, 0.0) * np.maximum(high, 0.0)
