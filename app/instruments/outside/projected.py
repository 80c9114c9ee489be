"""A diagram on the screen: its items, clipped and projected by the outside camera.

Painting and SVG both start from these primitives, which have no colours yet. Pure. Positions and
depths are as in screen.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.checks import Floats

from .diagram import Arrow, Dot, Eye, Face, Item, Label, Role, Segments, polyline
from .screen import OutsideScreen

CIRCLE = 28  # corners of a round shape
HEAD = 4.2  # the least length of an arrow's head, in widths of its shaft
_ANGLES = np.arange(CIRCLE)[:, None] * (2 * math.pi / CIRCLE)
_COSINES, _SINES = np.cos(_ANGLES), np.sin(_ANGLES)
_AXES = np.eye(3)


class Strokes(NamedTuple):
    """Segments of one kind. A segment of zero length is a disc.

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
    """A text next to a point. toward: the unit direction from `at` to the text. strong: True for
    bold. fixed: True to keep that direction. line: the ends (2, 2) of a line that the text may be
    along. lit: see Label.
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
    """Project the visible items in their order. Arrows with nearer tips come later, and so cover
    the others.

    The lines of all items are clipped and projected together: for the few lines of one item,
    NumPy's calls would take longer than the arithmetic.
    """
    items, parts = list(items), list[Segments | Primitive]()
    arrows = [item for item in items if isinstance(item, Arrow)]
    arrows.sort(key=lambda one: -screen.homogeneous(one.end)[2])
    farthest_first = iter(arrows)
    for item in items:
        if isinstance(item, Arrow):
            parts += _arrow(next(farthest_first), screen)
        elif isinstance(item, Segments):
            parts.append(item)
        elif isinstance(item, Face):
            points, depth = screen.polygon(item.corners)
            if len(points) >= 3:
                parts.append(
                    Shape(item.name, item.role, points, depth, item.opacity, item.hidden,
                          item.on_plane, item.layer)
                )  # fmt: skip
        elif isinstance(item, Label):
            parts += _label(item, screen)
        elif isinstance(item, Eye):
            parts += _eye(item, screen)
        else:
            parts += _disc(item, screen)
    lines = iter(_lines([part for part in parts if isinstance(part, Segments)], screen))
    return [
        one for part in parts for one in (next(lines) if isinstance(part, Segments) else [part])
    ]


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


def _disc(item: Dot, screen: OutsideScreen) -> list[Primitive]:
    _, at, depth, visible = screen.seen(np.array([[item.point, item.point]]))
    width_px = 2 * item.radius * screen.symbol_px
    return [
        Strokes(item.name, item.role, at, depth, np.zeros(1), width_px, 1.0, item.hidden,
                item.on_plane, False, item.layer)
    ] if visible.all() else []  # fmt: skip


def _arrow(item: Arrow, screen: OutsideScreen) -> list[Segments | Primitive]:
    """Return an arrow's shaft, and a cone if its tip is visible.

    The cone's outline is the hull of its tip and its base. It covers the shaft if the tip points to
    the viewer; otherwise the shaft covers the cone.
    """
    start, end = np.asarray(item.start, float), np.asarray(item.end, float)
    length = math.dist(start, end)
    if length <= 0:
        return []
    tip, cone = screen.seen(end), list[Primitive]()
    if tip.visible:
        axis = (end - start) / length
        size = screen.symbol_px * screen.px_world(float(tip.spots[2]))
        wide = HEAD * item.width * screen.unit_px / screen.symbol_px  # for thick lines
        head = min(max(item.head, wide) * size, 0.45 * length)
        end = end - head * axis
        base = screen.seen(end + 0.36 * head * _circle(axis))
        towards = float(axis @ screen.toward_viewer(end)) > 0
        if base.visible.all():
            depth, layer = float(tip.depth), item.layer + (1 if towards else 0)
            hull = _hull([tip.points.tolist(), *base.points.tolist()])
            cone += _filled(f"{item.name} head", item.role, hull, depth, layer)
            if not towards:
                cone += _filled(f"{item.name} base", item.role, base.points, depth, layer, -0.35)
    ends, dashed = np.array([[start, end]]), item.dashed
    shaft = Segments(item.name, item.role, ends, item.width, dashed=dashed, layer=item.layer)
    return [shaft, *cone]


def _filled(
    name: str, role: Role, points: Floats, depth: float, layer: int, tint: float = 0.0
) -> list[Primitive]:
    """Return a polygon with a smooth edge."""
    count = len(points)
    ends, depths = polyline(points, closed=True), np.full((count, 2), depth)
    return [
        Shape(name, role, points, depths[:, 0], 1.0, 0.45, False, layer, tint),
        Strokes(name, role, ends, depths, np.zeros(count), 1.0, 1.0, 0.45, False, False,
                layer, tint),
    ]  # fmt: skip


def _eye(item: Eye, screen: OutsideScreen) -> list[Primitive]:
    """Return a white ball of constant size on the screen, with iris and pupil along its gaze.

    Each is left out if the ball's edge would cut it: seen from the side it would be a wedge.
    """
    out = _disc(Dot("eye", "eye", item.point, item.radius, layer=item.layer), screen)
    viewer = screen.toward_viewer(np.asarray(item.point, float))
    gaze = np.asarray(item.gaze, float) / np.linalg.norm(item.gaze)
    _, at, depth, visible = screen.seen(item.point)
    if not visible or gaze @ viewer <= 0:
        return out
    across = np.asarray(screen.camera.u, float)
    across = across - (across @ viewer) * viewer
    across = across / np.linalg.norm(across)
    up = np.cross(viewer, across)
    if up @ np.asarray(screen.camera.v) < 0:
        up = -up
    radius_px = item.radius * screen.symbol_px
    for name, angle, tint, layer in (("iris", 40.0, -0.62, 1), ("pupil", 20.0, -0.97, 2)):
        angle = math.radians(angle)
        ring = math.cos(angle) * gaze + math.sin(angle) * _circle(gaze)
        x, y, z = ring @ across, ring @ up, ring @ viewer
        if (z > 0).all():
            points = at + radius_px * 0.97 * np.stack([x, -y], axis=1)
            out += _filled(name, "eye", points, float(depth), item.layer + layer, tint)
    return out


def _label(item: Label, screen: OutsideScreen) -> list[Primitive]:
    away = item.point if item.away is None else item.away
    line = () if item.line is None else item.line
    spots, points, _, visible = screen.seen(np.array([item.point, away, *line]))
    if not visible[0]:
        return []
    dx, dy = 0.0, 1.0
    if item.away is not None:
        # The direction on the screen, even if the other end is behind the outside camera's eye.
        (x, y, t, _), (x_away, y_away, t_away, _) = spots[:2].tolist()
        over = 0.0 if screen.camera.is_parallel else (t - t_away) / t
        x, y = x - x_away - over * x, y - y_away - over * y
        length = math.hypot(x, y)
        size = length if screen.camera.is_parallel else length / t
        if size < item.least * screen.symbol_px:
            return []
        if length > 0:
            dx, dy = x / length, y / length
    x, y = points[0].tolist()
    has_line = item.line is not None and bool(visible[2:].all())
    return [
        Text(item.name, item.role, item.text, (x, y), (dx, dy), item.strong, item.fixed,
             points[2:] if has_line else None, item.lit)
    ]  # fmt: skip


def _circle(axis: Floats) -> Floats:
    """Return a unit circle around an axis, (CIRCLE, 3)."""
    first = np.cross(axis, _AXES[int(np.abs(axis).argmin())])
    first = first / math.hypot(*first.tolist())
    return _COSINES * first + _SINES * np.cross(axis, first)


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
