"""A diagram on the screen: each of its items clipped and projected by the outside camera.

Painting and SVG both start from these primitives. Pure; knows nothing of colours. Positions and
depths are as in screen.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Arrow, Dot, Eye, Face, Item, Label, Role, Segments, polyline
from app.outside.screen import OutsideScreen

Floats = NDArray[np.float64]

CIRCLE = 28  # corners of what is round
_ANGLES = np.arange(CIRCLE)[:, None] * (2 * math.pi / CIRCLE)
_COSINES, _SINES = np.cos(_ANGLES), np.sin(_ANGLES)


@dataclass(frozen=True, eq=False)
class Strokes:
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


@dataclass(frozen=True, eq=False)
class Shape:
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


@dataclass(frozen=True)
class Text:
    """A text next to a point. toward: the unit direction from `at` to the text. strong: bold."""

    name: str
    role: Role
    text: str
    at: tuple[float, float]
    toward: tuple[float, float]
    strong: bool


Primitive = Strokes | Shape | Text


def project(items: Iterable[Item], screen: OutsideScreen) -> list[Primitive]:
    """Project items in their order, without the invisible ones. Among arrows, those whose tip is
    nearer come later, and so cover the others.
    """
    out: list[Primitive] = []
    ordered = _farthest_arrow_first(list(items), screen)
    lines = iter(_all_lines([item for item in ordered if isinstance(item, Segments)], screen))
    for item in ordered:
        if isinstance(item, Segments):
            out += next(lines)
        elif isinstance(item, Face):
            points, depth = screen.polygon(item.corners)
            if len(points) >= 3:
                out.append(
                    Shape(item.name, item.role, points, depth, item.opacity, item.hidden,
                          item.on_plane, item.layer)
                )  # fmt: skip
        elif isinstance(item, Arrow):
            out += _arrow(item, screen)
        elif isinstance(item, Dot):
            out += _disc(item, screen)
        elif isinstance(item, Eye):
            out += _eye(item, screen)
        else:
            out += _label(item, screen)
    return out


def _farthest_arrow_first(items: list[Item], screen: OutsideScreen) -> list[Item]:
    """Return the items with their arrows sorted among their places (painter's order)."""
    arrows = [item for item in items if isinstance(item, Arrow)]
    arrows.sort(key=lambda arrow: -float(screen.homogeneous(arrow.end)[2]))
    ordered = iter(arrows)
    return [next(ordered) if isinstance(item, Arrow) else item for item in items]


def _all_lines(items: Sequence[Segments], screen: OutsideScreen) -> list[list[Primitive]]:
    """Return the lines of each item. Projected together, because many have one segment."""
    if not items:
        return []
    counts = [len(item.segments) for item in items]
    ends = np.cumsum(counts)
    points, depth, numbers = screen.segments(np.concatenate([item.segments for item in items]))
    bounds = [0, *np.searchsorted(numbers, ends).tolist()]
    return [
        _lines(item, points[low:high], depth[low:high], numbers[low:high], screen)
        for item, low, high in zip(items, bounds[:-1], bounds[1:], strict=True)
    ]


def _lines(
    item: Segments, points: Floats, depth: Floats, numbers: NDArray[np.int64], screen: OutsideScreen
) -> list[Primitive]:
    """Return the lines of an item. points, depth, numbers: from OutsideScreen.segments()."""
    if not len(points):
        return []
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    joined = np.zeros(len(points), bool)
    joined[1:] = (np.diff(numbers) == 1) & (points[1:, 0] == points[:-1, 1]).all(axis=1)
    run = np.cumsum(lengths) - lengths
    before = run - run[np.maximum.accumulate(np.where(joined, 0, np.arange(len(points))))]
    return [
        Strokes(item.name, item.role, points, depth, before, item.width * screen.unit_px,
                item.opacity, item.hidden, item.on_plane, item.dashed, item.layer)
    ]  # fmt: skip


def _disc(item: Dot, screen: OutsideScreen) -> list[Primitive]:
    found = screen.spots(item.point)
    if found is None:
        return []
    points, depth = np.tile(found[0], (1, 2, 1)), np.full((1, 2), found[1])
    width_px = 2 * item.radius * screen.symbol_px
    return [
        Strokes(item.name, item.role, points, depth, np.zeros(1), width_px, 1.0, 0.45,
                item.on_plane, False, item.layer)
    ]  # fmt: skip


def _arrow(item: Arrow, screen: OutsideScreen) -> list[Primitive]:
    """Return a shaft and a cone, whose outline is the hull of its tip and its base.

    The cone covers the shaft if its tip points to the viewer; otherwise the shaft covers the cone.
    """
    start, end = np.asarray(item.start, float), np.asarray(item.end, float)
    length = float(np.linalg.norm(end - start))
    if length <= 0:
        return []
    axis = (end - start) / length
    cone, found = list[Primitive](), screen.spots(end)
    if found is not None:
        head = min(item.head * screen.symbol_px * screen.px_world(end), 0.45 * length)
        base = end - head * axis
        ring = base + 0.36 * head * _circle(axis)
        towards = float(axis @ screen.toward_viewer(base)) > 0
        layer = item.layer + (1 if towards else 0)
        corners = screen.spots(np.vstack([end, ring]))
        if corners is not None:
            points, depth = corners[0], float(found[1])
            cone = _filled(f"{item.name} head", item.role, _hull(points), depth, layer)
            if not towards:
                cone += _filled(f"{item.name} base", item.role, points[1:], depth, layer, -0.35)
        end = base
    shaft = Segments(
        item.name, item.role, np.array([[start, end]]), item.width, dashed=item.dashed,
        layer=item.layer,
    )  # fmt: skip
    return [*_all_lines([shaft], screen)[0], *cone]


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
    """Return a white ball of constant size on the screen, with iris and pupil where it looks.

    Each is left out where the ball's edge would cut it: seen from the side it would be a wedge.
    """
    found = screen.spots(item.point)
    if found is None:
        return []
    at, depth = found
    out = _disc(Dot("eye", "eye", item.point, item.radius, layer=item.layer), screen)
    viewer = screen.toward_viewer(np.asarray(item.point, float))
    across = np.asarray(screen.camera.u, float)
    across = across - (across @ viewer) * viewer
    across = across / np.linalg.norm(across)
    up = _cross(viewer, across)
    if up @ np.asarray(screen.camera.v) < 0:
        up = -up
    gaze = np.asarray(item.gaze, float) / np.linalg.norm(item.gaze)
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
    found = screen.spots(item.point)
    if found is None:
        return []
    at, toward = found[0], np.array([0.0, 1.0])
    if item.away is not None:
        # The direction on the screen, even if the other end is behind the outside camera's eye.
        there, here = screen.homogeneous(item.point), screen.homogeneous(item.away)
        way = there[:2] - here[:2]
        if not screen.camera.is_parallel:
            way = way - (there[2] - here[2]) * there[:2] / there[2]
        length = float(np.linalg.norm(way))
        size = length if screen.camera.is_parallel else length / there[2]
        if size < item.least * screen.symbol_px:
            return []
        toward = way / length if length > 0 else toward
    x, y = at.tolist()
    dx, dy = toward.tolist()
    return [Text(item.name, item.role, item.text, (x, y), (dx, dy), item.strong)]


def _circle(axis: Floats) -> Floats:
    """Return a unit circle around an axis, (CIRCLE, 3)."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = _cross(axis, helper)
    first = first / np.linalg.norm(first)
    return _COSINES * first + _SINES * _cross(axis, first)


def _cross(a: Floats, b: Floats) -> Floats:
    """Return the cross product of two vectors (3,). NumPy's own takes ten times as long for one."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def _hull(points: Floats) -> Floats:
    """Return the convex hull of points (n, 2), in order. Source: Andrew 1979, monotone chain."""
    ordered = sorted(map(tuple, points.tolist()))

    def chain(spots: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
        out: list[tuple[float, float]] = []
        for x, y in spots:
            while len(out) > 1:
                (ax, ay), (bx, by) = out[-2], out[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0:
                    break
                out.pop()
            out.append((x, y))
        return out[:-1]

    return np.array(chain(ordered) + chain(reversed(ordered)) or ordered[:1])
