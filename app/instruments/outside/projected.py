"""A diagram on the screen: each of its items clipped and projected by the outside camera.

Painting and SVG both start from these primitives, which have no colours yet. Pure. Positions and
depths are as in screen.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.checks import Floats, cross

from .diagram import (
    Arrow,
    Dot,
    Eye,
    Face,
    Item,
    Label,
    Role,
    Segments,
    polyline,
)
from .screen import OutsideScreen, Seen

CIRCLE = 28  # corners of what is round
HEAD = 4.2  # the least length of an arrow's head, in widths of its shaft
_ANGLES = np.arange(CIRCLE)[:, None] * (2 * math.pi / CIRCLE)
_COSINES, _SINES = np.cos(_ANGLES), np.sin(_ANGLES)
_AXES = np.eye(3)
_NOTHING = np.zeros(0)


class Strokes(NamedTuple):
    """Segments of one kind. A segment of no length is a disc.

    points (n, 2, 2). depth (n, 2). before (n,): the length of the line before each, in pixels.
    """

    name: str
    role: Role
    points: Floats
    depth: Floats
    before: Floats
    width_px: float
    opacity: float = 1.0
    hidden: float = 1.0
    on_plane: bool = False
    dashed: bool = False
    layer: int = 1
    tint: float = 0.0  # 1: white, -1: black


class Shape(NamedTuple):
    """A filled convex polygon: points (n, 2), depth (n,)."""

    name: str
    role: Role
    points: Floats
    depth: Floats
    opacity: float = 1.0
    hidden: float = 1.0
    on_plane: bool = False
    layer: int = 0
    tint: float = 0.0


class Text(NamedTuple):
    """A text next to a point. toward: the unit direction from `at` to the text. strong: bold.
    fixed: in that direction only. line: the ends (2, 2) of a line that the text may be along. lit:
    see Label.
    """

    name: str
    role: Role
    text: str
    at: tuple[float, float]
    toward: tuple[float, float]
    strong: bool
    fixed: bool = False
    line: Floats | None = None
    lit: bool = False


Primitive = Strokes | Shape | Text


def project(items: Iterable[Item], screen: OutsideScreen) -> list[Primitive]:
    """Project items in their order, without the invisible ones. Among arrows, those whose tip is
    nearer come later, and so cover the others.

    The points of all items are projected together, and so are the lines: for the few of one item,
    NumPy's calls would take longer than the arithmetic.
    """
    items = list(items)
    given = [_points(item) for item in items]
    seen = screen.seen(np.concatenate([_NOTHING, *given]).reshape(-1, 3))
    first = [0, *accumulate(len(points) // 3 for points in given)]
    arrows = iter(_arrows(items, first, seen, screen))
    parts = [
        (part, low, high)
        for item, (low, high) in zip(items, pairwise(first), strict=True)
        for part in (next(arrows) if isinstance(item, Arrow) else (item,))
    ]
    lines = iter(_lines([part for part, *_ in parts if isinstance(part, Segments)], screen))
    out: list[Primitive] = []
    for part, low, high in parts:
        if isinstance(part, Segments):
            out += next(lines)
        elif isinstance(part, (Strokes, Shape)):
            out.append(part)
        elif isinstance(part, Face):
            points, depth = seen.points[low:high], seen.depth[low:high]
            if not seen.visible[low:high].all():
                points, depth = screen.polygon(part.corners)
            if len(points) >= 3:
                out.append(
                    Shape(part.name, part.role, points, depth, part.opacity, part.hidden,
                          part.on_plane, part.layer)
                )  # fmt: skip
        elif not seen.visible[low]:
            continue
        elif isinstance(part, Label):
            out += _label(part, low, high, seen, screen)
        elif isinstance(part, Eye):
            out += _eye(part, seen.points[low:high], seen.depth[low:high], screen)
        else:
            out += _disc(part, seen.points[low:high], seen.depth[low:high], screen)
    return out


def _points(item: Item) -> Floats:
    """Return the points of an item that are projected as they are, one after another: (3 n,)."""
    if isinstance(item, Segments):
        return _NOTHING
    if isinstance(item, Face):
        return np.ravel(item.corners)
    if isinstance(item, Arrow):
        return item.end
    if isinstance(item, Label):
        away = item.point if item.away is None else item.away
        return np.concatenate([item.point, away, *(() if item.line is None else item.line)])
    return item.point


def _lines(items: Sequence[Segments], screen: OutsideScreen) -> list[list[Primitive]]:
    """Return the lines of each item."""
    if not items:
        return []
    ends = np.cumsum([len(item.segments) for item in items])
    points, depth, numbers = screen.segments(np.concatenate([item.segments for item in items]))
    bounds = [0, *np.searchsorted(numbers, ends).tolist()]
    begins = np.ones(len(points) + 1, bool)
    begins[1:-1] = (np.diff(numbers) != 1) | (points[1:, 0] != points[:-1, 1]).any(axis=1)
    begins[bounds] = True
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    run = np.cumsum(lengths) - lengths
    starts = np.maximum.accumulate(np.where(begins[:-1], np.arange(len(points)), 0))
    before = run - run[starts]
    return [
        [
            Strokes(item.name, item.role, points[low:high], depth[low:high], before[low:high],
                    item.width * screen.unit_px, item.opacity, item.hidden, item.on_plane,
                    item.dashed, item.layer)
        ] if low < high else []
        for item, (low, high) in zip(items, pairwise(bounds), strict=True)
    ]  # fmt: skip


def _disc(item: Dot, at: Floats, depth: Floats, screen: OutsideScreen) -> list[Primitive]:
    points, depths = np.stack([at, at], axis=1), np.stack([depth, depth], axis=1)
    width_px = 2 * item.radius * screen.symbol_px
    return [
        Strokes(item.name, item.role, points, depths, np.zeros(1), width_px, 1.0, item.hidden,
                item.on_plane, False, item.layer)
    ]  # fmt: skip


def _arrows(
    items: Iterable[Item], first: Iterable[int], seen: Seen, screen: OutsideScreen
) -> list[list[Segments | Strokes | Shape]]:
    """Return each arrow's shaft, and a cone if its tip is visible: the farthest tip first.

    A cone's outline is the hull of its tip and its base. The cone covers the shaft if its tip
    points to the viewer; otherwise the shaft covers the cone.

    first: the number of each item's first point. seen: the points.
    """
    arrows = [(item, k) for item, k in zip(items, first, strict=False) if isinstance(item, Arrow)]
    arrows.sort(key=lambda pair: -seen.spots[pair[1], 2])
    out: list[list[Segments | Strokes | Shape]] = [[] for _ in arrows]
    cones, rings = [], [_NOTHING.reshape(0, 3)]
    for parts, (item, k) in zip(out, arrows, strict=True):
        start, end = np.asarray(item.start, float), np.asarray(item.end, float)
        length = math.dist(start, end)
        if length <= 0:
            continue
        if seen.visible[k]:
            axis = (end - start) / length
            size = screen.symbol_px * screen.px_world(float(seen.spots[k, 2]))
            wide = HEAD * item.width * screen.unit_px / screen.symbol_px  # of thick lines
            head = min(max(item.head, wide) * size, 0.45 * length)
            end = end - head * axis
            rings.append(end + 0.36 * head * _circle(axis))
            towards = float(axis @ screen.toward_viewer(end)) > 0
            cones.append((item, parts, k, towards))
        shaft = np.array([[start, end]])
        parts.append(
            Segments(item.name, item.role, shaft, item.width, dashed=item.dashed, layer=item.layer)
        )
    bases = screen.seen(np.concatenate(rings))
    for number, (item, parts, k, towards) in enumerate(cones):
        ring = slice(number * CIRCLE, (number + 1) * CIRCLE)
        if bases.visible[ring].all():
            points, depth = bases.points[ring], float(seen.depth[k])
            layer = item.layer + (1 if towards else 0)
            hull = _hull([*seen.points[k : k + 1].tolist(), *points.tolist()])
            parts += _filled(f"{item.name} head", item.role, hull, depth, layer)
            if not towards:
                parts += _filled(f"{item.name} base", item.role, points, depth, layer, -0.35)
    return out


def _filled(
    name: str, role: Role, points: Floats, depth: float, layer: int, tint: float = 0.0
) -> list[Strokes | Shape]:
    """Return a polygon with a smooth edge."""
    count = len(points)
    ends, depths = polyline(points, closed=True), np.full((count, 2), depth)
    return [
        Shape(name, role, points, depths[:, 0], 1.0, 0.45, False, layer, tint),
        Strokes(name, role, ends, depths, np.zeros(count), 1.0, 1.0, 0.45, False, False,
                layer, tint),
    ]  # fmt: skip


def _eye(item: Eye, at: Floats, depth: Floats, screen: OutsideScreen) -> list[Primitive]:
    """Return a white ball of constant size on the screen, with iris and pupil where it looks.

    Each is left out where the ball's edge would cut it: seen from the side it would be a wedge.
    """
    out = _disc(Dot("eye", "eye", item.point, item.radius, layer=item.layer), at, depth, screen)
    viewer = screen.toward_viewer(np.asarray(item.point, float))
    gaze = np.asarray(item.gaze, float) / np.linalg.norm(item.gaze)
    if gaze @ viewer <= 0:
        return out
    across = np.asarray(screen.camera.u, float)
    across = across - (across @ viewer) * viewer
    across = across / np.linalg.norm(across)
    up = _cross(viewer, across)
    if up @ np.asarray(screen.camera.v) < 0:
        up = -up
    radius_px = item.radius * screen.symbol_px
    for name, angle, tint, layer in (("iris", 40.0, -0.62, 1), ("pupil", 20.0, -0.97, 2)):
        angle = math.radians(angle)
        ring = math.cos(angle) * gaze + math.sin(angle) * _circle(gaze)
        x, y, z = ring @ across, ring @ up, ring @ viewer
        if (z > 0).all():
            points = at + radius_px * 0.97 * np.stack([x, -y], axis=1)
            out += _filled(name, "eye", points, float(depth[0]), item.layer + layer, tint)
    return out


def _label(item: Label, first: int, end: int, seen: Seen, screen: OutsideScreen) -> list[Primitive]:
    """Return a text. seen: its point, `away` and the ends of its line, from `first` to `end`."""
    dx, dy = 0.0, 1.0
    if item.away is not None:
        # The direction on the screen, even if the other end is behind the outside camera's eye.
        (x, y, t, _), (x_away, y_away, t_away, _) = seen.spots[first : first + 2].tolist()
        over = 0.0 if screen.camera.is_parallel else (t - t_away) / t
        x, y = x - x_away - over * x, y - y_away - over * y
        length = math.hypot(x, y)
        size = length if screen.camera.is_parallel else length / t
        if size < item.least * screen.symbol_px:
            return []
        if length > 0:
            dx, dy = x / length, y / length
    x, y = seen.points[first].tolist()
    ends = slice(first + 2, end)
    has_line = item.line is not None and bool(seen.visible[ends].all())
    return [
        Text(item.name, item.role, item.text, (x, y), (dx, dy), item.strong, item.fixed,
             seen.points[ends] if has_line else None, item.lit)
    ]  # fmt: skip


def _circle(axis: Floats) -> Floats:
    """Return a unit circle around an axis, (CIRCLE, 3)."""
    first = _cross(axis, _AXES[int(np.abs(axis).argmin())])
    first = first / math.hypot(*first.tolist())
    return _COSINES * first + _SINES * _cross(axis, first)


def _cross(a: Floats, b: Floats) -> Floats:
    """Return the cross product of two vectors (3,). NumPy's own takes ten times as long for one."""
    return np.array(cross(a.tolist(), b.tolist()))


def _hull(points: list[list[float]]) -> Floats:
    """Return the convex hull of points (x, y), in order. Source: Andrew 1979, monotone chain."""
    ordered = sorted(points)

    def chain(spots: Iterable[list[float]]) -> list[list[float]]:
        out: list[list[float]] = []
        for x, y in spots:
            while len(out) > 1:
                (ax, ay), (bx, by) = out[-2], out[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0:
                    break
                out.pop()
            out.append([x, y])
        return out[:-1]

    return np.array(chain(ordered) + chain(reversed(ordered)) or ordered[:1])
