"""Places for the labels of the outside view: next to their points, where they cover nothing.

Each label takes the best of a few places around its point, one after another; places of the frame
before are kept as long as they are good, so that labels do not jump while the view turns. Pure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from app.outside.projected import Primitive, Shape, Strokes, Text
from renderer.memo import same

Floats = NDArray[np.float64]
Spot = tuple[float, float]
Label = tuple[str, str, int]  # name, role, how many before it have both
Edges = tuple[float, float, float, float]  # left, top, right, bottom

# Places: turned away from the label's own direction, and farther out in heights of the text.
TURNS = np.radians([0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180])
FARTHER = (0.0, 0.8, 1.8)
# What a place costs: for half a turn, for a height farther out, outside the view or under a tool,
# on another label, on a mark, for a height of a line in the text, on the image plane.
TURNED, OUT, OUTSIDE, LABEL, MARK, CROSSED, ON_PLANE = 1.2, 0.8, 60.0, 40.0, 6.0, 1.6, 0.5
JUMP_PX = 60.0  # a point that has moved farther since the frame before has jumped
KEPT = 1.0  # by which another place must be better than the present one
SPACE = 0.12  # around a text, in its heights


@dataclass(frozen=True)
class Box:
    """The size of a text, and the space between it and its point, in pixels."""

    width: float
    height: float
    room: float


@dataclass(frozen=True, eq=False)
class _Ground:
    """Obstacles for labels. lines (n, 2, 2) with weights (n,). marks: boxes (n, 4) of heads
    and dots. plane: the image plane's corners (m, 2). Boxes are left, top, right, bottom.
    """

    lines: Floats
    weights: Floats
    marks: Floats
    plane: Floats


@dataclass
class LabelPlacer:
    """Places the labels of one view. Its memory are the places of the frame before."""

    _chosen: dict[Label, tuple[Spot, int]] = field(default_factory=dict)
    _key: tuple[object, ...] = ()
    _size: tuple[float, float] = (0.0, 0.0)
    _centers: list[Spot] = field(default_factory=list)

    def place(
        self,
        primitives: Sequence[Primitive],
        boxes: tuple[Box, ...],
        size: tuple[float, float],
        tools: tuple[Edges, ...] = (),
    ) -> list[Spot]:
        """Return the centres of the texts among the primitives, in their order. Does nothing if all
        is as in the last call.

        boxes: of those texts. size: of the view. tools: boxes that no text may be under.
        """
        key = primitives, boxes, size, tools
        if size != self._size:
            self._chosen, self._size = {}, size
        if not same(key, self._key):
            self._key, self._centers = key, self._placed(primitives, boxes, size, tools)
        return self._centers

    def _placed(
        self,
        primitives: Sequence[Primitive],
        boxes: tuple[Box, ...],
        size: tuple[float, float],
        tools: tuple[Edges, ...],
    ) -> list[Spot]:
        texts = [part for part in primitives if isinstance(part, Text)]
        ground, taken = _ground(primitives), np.zeros((0, 4))
        under = np.reshape(tools, (-1, 4))
        labels = _labels(texts)
        before = self._chosen if self._is_moving(labels, texts) else {}
        centers: dict[int, Spot] = {}
        self._chosen = {}
        for number in sorted(range(len(texts)), key=lambda k: not texts[k].strong):
            text, box, label = texts[number], boxes[number], labels[number]
            places = _places(text, box)
            half = np.array([box.width, box.height]) / 2
            wide = half + SPACE * box.height
            around = np.concatenate([places - wide, places + wide], axis=1)
            costs = _preferences() + _costs(around, box, ground, taken, under, size)
            if label in before:
                costs[before[label][1]] -= KEPT
            best = int(costs.argmin())
            self._chosen[label] = text.at, best
            place = places[best]
            if (np.minimum(text.at, np.subtract(size, text.at)) > 0).all():  # of a point in sight
                place = np.clip(place, wide, np.maximum(np.subtract(size, wide), wide))
            centers[number] = float(place[0]), float(place[1])
            taken = np.vstack([taken, [*(place - wide), *(place + wide)]])
        return [centers[number] for number in range(len(texts))]

    def _is_moving(self, labels: Sequence[Label], texts: Sequence[Text]) -> bool:
        """Return True if the view moves smoothly: otherwise the places of before mean nothing."""
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


def _places(text: Text, box: Box) -> Floats:
    """Return the centres of a label's places, (n, 2): the text's box touches a circle around the
    point from outside.
    """
    dx, dy = text.toward
    turned = math.atan2(dy, dx) + TURNS
    ways = np.stack([np.cos(turned), np.sin(turned)], axis=1)
    reach = box.room + np.abs(ways) @ [box.width / 2, box.height / 2]
    out = np.array(FARTHER)[:, None] * box.height + reach
    return np.asarray(text.at) + (out[..., None] * ways).reshape(-1, 2)


def _preferences() -> Floats:
    turned = TURNED * np.abs(TURNS) / math.pi
    return (OUT * np.array(FARTHER)[:, None] + turned).ravel()


def _ground(primitives: Iterable[Primitive]) -> _Ground:
    lines, weights, marks, plane = [], [], [], np.zeros((0, 2))
    for part in primitives:
        if isinstance(part, Strokes):
            if part.name == "image plane":
                plane = part.points[:, 0]
            if part.role == "grid":
                continue
            is_spot = (part.points[:, 0] == part.points[:, 1]).all(axis=1)
            for spot in part.points[is_spot, 0]:
                marks.append([*(spot - part.width_px / 2), *(spot + part.width_px / 2)])
            lines.append(part.points[~is_spot])
            weights.append(np.full(len(lines[-1]), part.opacity))
        elif isinstance(part, Shape) and part.opacity >= 0.5:  # heads, and the marked pixel
            marks.append([*part.points.min(axis=0), *part.points.max(axis=0)])
    return _Ground(
        np.concatenate(lines or [np.zeros((0, 2, 2))]),
        np.concatenate(weights or [np.zeros(0)]),
        np.reshape(marks, (-1, 4)),
        plane,
    )


def _costs(
    around: Floats,
    box: Box,
    ground: _Ground,
    taken: Floats,
    tools: Floats,
    size: tuple[float, float],
) -> Floats:
    """Return what boxes (n, 4) of one label cost."""
    area = float(np.prod(around[0, 2:] - around[0, :2]))
    inside = _overlap(around, np.array([[0.0, 0.0, *size]]))[:, 0] / area
    costs = OUTSIDE * (1 - inside) + OUTSIDE * (_overlap(around, tools) / area).sum(axis=1)
    met = _overlap(around, taken) / area
    costs += LABEL * met.sum(axis=1) + MARK * (_overlap(around, ground.marks) > 0).sum(axis=1)
    low, high = around[:, :2].min(axis=0), around[:, 2:].max(axis=0)
    ends = ground.lines
    near = ((ends.max(axis=1) > low) & (ends.min(axis=1) < high)).all(axis=1)
    lengths = _inside(ends[near], around) / box.height
    costs += CROSSED * lengths @ ground.weights[near]
    if len(ground.plane) == 4:
        costs += ON_PLANE * _in_polygon((around[:, :2] + around[:, 2:]) / 2, ground.plane)
    return costs


def _overlap(boxes: Floats, others: Floats) -> Floats:
    """Return the common areas of boxes (n, 4) and others (m, 4), (n, m)."""
    low = np.maximum(boxes[:, None, :2], others[:, :2])
    high = np.minimum(boxes[:, None, 2:], others[:, 2:])
    return np.prod(np.maximum(high - low, 0.0), axis=2)


def _inside(lines: Floats, boxes: Floats) -> Floats:
    """Return the lengths of lines (m, 2, 2) inside boxes (n, 4), (n, m). Source: Liang and Barsky
    1984.
    """
    start, way = lines[:, 0], lines[:, 1] - lines[:, 0]
    with np.errstate(all="ignore"):
        one = (boxes[:, None, :2] - start) / way
        two = (boxes[:, None, 2:] - start) / way
    low = np.nan_to_num(np.minimum(one, two), nan=-np.inf).max(axis=2)
    high = np.nan_to_num(np.maximum(one, two), nan=np.inf).min(axis=2)
    share = np.minimum(high, 1.0) - np.maximum(low, 0.0)
    return np.maximum(share, 0.0) * np.linalg.norm(way, axis=1)


def _in_polygon(points: Floats, corners: Floats) -> NDArray[np.bool_]:
    """Return whether points (n, 2) are inside a convex polygon (m, 2)."""
    sides, from_ = np.roll(corners, -1, axis=0) - corners, points[:, None] - corners
    turns = sides[:, 0] * from_[..., 1] - sides[:, 1] * from_[..., 0]
    inside: NDArray[np.bool_] = np.abs(np.sign(turns).sum(axis=1)) == len(corners)
    return inside
