"""A diagram on the screen: each of its items clipped and projected by the camera that looks.

Owns the way from the world to pixels, in float64, for painting and for SVG alike. Pure; knows
nothing of colours. Positions are in pixels from the upper left corner, x right, y down. Depths are
s: 1 / t in perspective, t in parallel projection, which are affine on the screen.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Arrow, Dot, Eye, Face, Item, Label, Lines, Role
from renderer.camera import Camera
from renderer.raster.overlay import screen_from_world

Floats = NDArray[np.float64]
Size = tuple[int, int]

GUARD = 4.0  # times the image, from its middle: what is farther out is cut off
NEAREST = 1e-4  # of the distance to the scene: what is nearer to the looking camera is cut off
CIRCLE = 28  # corners of what is round


@dataclass(frozen=True, eq=False)
class Strokes:
    """Segments of one kind. points (n, 2, 2), depth (n, 2). before (n,): pixels of the line before
    each. width_px. A segment of no length is a disc of that diameter."""

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
    """toward: the unit direction in which the text stands off from `at`. strong: see Label."""

    name: str
    role: Role
    text: str
    at: tuple[float, float]
    toward: tuple[float, float]
    strong: bool


Primitive = Strokes | Shape | Text


class Screen:
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
        """Of segments (n, 2, 3): those to be seen, as points (m, 2, 2), depths (m, 2), and which
        they were (m,)."""
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
        """A convex polygon (n, 3), cut to what is to be seen: points (m, 2), depths (m,).
        Source: Sutherland and Hodgman 1974."""
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


def project(items: Iterable[Item], screen: Screen) -> list[Primitive]:
    """The items on the screen, in their order, but for arrows: where they meet, the one whose tip
    is nearer is over the others. What is not to be seen is left out."""
    out: list[Primitive] = []
    for item in _farthest_arrow_first(list(items), screen):
        if isinstance(item, Lines):
            out += _lines(item, screen)
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
            out += _disc(item.name, item.role, item.point, 2 * item.radius, screen, item.layer,
                         item.on_plane)  # fmt: skip
        elif isinstance(item, Eye):
            out += _eye(item, screen)
        else:
            out += _label(item, screen)
    return out


def _farthest_arrow_first(items: list[Item], screen: Screen) -> list[Item]:
    """The items with their arrows exchanged among their places (painter's order)."""
    arrows = [item for item in items if isinstance(item, Arrow)]
    arrows.sort(key=lambda arrow: -float(screen.homogeneous(arrow.end)[2]))
    ordered = iter(arrows)
    return [next(ordered) if isinstance(item, Arrow) else item for item in items]


def _lines(item: Lines, screen: Screen) -> list[Primitive]:
    points, depth, numbers = screen.segments(item.segments)
    if not len(points):
        return []
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    joined = np.zeros(len(points), bool)
    joined[1:] = (np.diff(numbers) == 1) & (points[1:, 0] == points[:-1, 1]).all(axis=1)
    run = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    starts = np.maximum.accumulate(np.where(joined, 0, np.arange(len(points))))
    before = run - run[starts]
    return [
        Strokes(item.name, item.role, points, depth, before, item.width * screen.unit_px,
                item.opacity, item.hidden, item.on_plane, item.dashed, item.layer)
    ]  # fmt: skip


def _disc(
    name: str,
    role: Role,
    point: Floats,
    width: float,
    screen: Screen,
    layer: int,
    on_plane: bool = False,
    tint: float = 0.0,
) -> list[Primitive]:
    found = screen.spot(point)
    if found is None:
        return []
    at, depth = found
    points, depths = np.array([[at, at]]), np.array([[depth, depth]])
    width_px = width * screen.symbol_px
    return [
        Strokes(name, role, points, depths, np.zeros(1), width_px, 1.0, 0.45, on_plane, False,
                layer, tint)
    ]  # fmt: skip


def _arrow(item: Arrow, screen: Screen) -> list[Primitive]:
    """A shaft and a cone, whose outline is the hull of its tip and its base. The cone is over the
    shaft where its tip points to the viewer, else under it."""
    start, end = np.asarray(item.start, float), np.asarray(item.end, float)
    length = float(np.linalg.norm(end - start))
    if length <= 0:
        return []
    axis = (end - start) / length
    shaft_end, cone = end, []
    found = screen.spot(end)
    if found is not None:
        head = min(item.head * screen.symbol_px * screen.px_world(end), 0.45 * length)
        base = end - head * axis
        ring = base + 0.36 * head * _circle(axis)
        towards = float(axis @ screen.toward_viewer(base)) > 0
        layer = item.layer + (1 if towards else 0)
        spots = [spot[0] for spot in map(screen.spot, (end, *ring)) if spot is not None]
        if len(spots) == 1 + CIRCLE:
            points = np.array(spots)
            hull = _hull(points)
            depth = np.full(len(hull), found[1])
            cone = _filled(f"{item.name} head", item.role, hull, depth, layer)
            if not towards:
                inner = np.full(CIRCLE, found[1])
                cone += _filled(f"{item.name} base", item.role, points[1:], inner, layer, -0.35)
        shaft_end = base
    shaft = Lines(
        item.name, item.role, np.array([[start, shaft_end]]), item.width, layer=item.layer
    )
    return [*_lines(shaft, screen), *cone]


def _filled(
    name: str, role: Role, points: Floats, depth: Floats, layer: int, tint: float = 0.0
) -> list[Primitive]:
    """A polygon with a smooth edge."""
    ends = np.stack([points, np.roll(points, -1, axis=0)], axis=1)
    depths = np.stack([depth, np.roll(depth, -1)], axis=1)
    return [
        Shape(name, role, points, depth, 1.0, 0.45, False, layer, tint),
        Strokes(name, role, ends, depths, np.zeros(len(ends)), 1.0, 1.0, 0.45, False, False,
                layer, tint),
    ]  # fmt: skip


def _eye(item: Eye, screen: Screen) -> list[Primitive]:
    """A white ball of one size on the screen, with iris and pupil where it looks."""
    found = screen.spot(item.point)
    if found is None:
        return []
    at, depth = found
    out = _disc("eye", "eye", item.point, 2 * item.radius, screen, item.layer)
    viewer = screen.toward_viewer(np.asarray(item.point, float))
    across = np.asarray(screen.camera.u, float)
    across = across - (across @ viewer) * viewer
    across = across / np.linalg.norm(across)
    up = np.cross(viewer, across)
    if up @ np.asarray(screen.camera.v) < 0:
        up = -up
    gaze = np.asarray(item.gaze, float) / np.linalg.norm(item.gaze)
    radius_px = item.radius * screen.symbol_px
    for name, angle, tint, layer in (("iris", 40.0, -0.62, 5), ("pupil", 20.0, -0.97, 6)):
        angle = math.radians(angle)
        ring = math.cos(angle) * gaze + math.sin(angle) * _circle(gaze)
        x, y, z = ring @ across, ring @ up, ring @ viewer
        if (z <= 0).all():
            continue
        # What is round the limb is drawn on it.
        limb = np.where(z < 0, 1 / np.maximum(np.hypot(x, y), 1e-9), 1.0)
        points = at + radius_px * 0.97 * np.stack([x * limb, -y * limb], axis=1)
        hull = _hull(points)
        depths = np.full(len(hull), depth)
        out += _filled(name, "eye", hull, depths, item.layer + layer - 4, tint)
    return out


def _label(item: Label, screen: Screen) -> list[Primitive]:
    found = screen.spot(item.point)
    if found is None:
        return []
    at, toward = found[0], np.array([0.0, 1.0])
    if item.away is not None:
        # The direction on the screen, also where the other end is behind the eye that looks.
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
    """A unit circle round an axis, (CIRCLE, 3)."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = np.cross(axis, helper)
    first = first / np.linalg.norm(first)
    second = np.cross(axis, first)
    angles = np.arange(CIRCLE) * (2 * math.pi / CIRCLE)
    return np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second


def _hull(points: Floats) -> Floats:
    """The convex hull of points (n, 2), in order. Source: Andrew 1979, monotone chain."""
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
