"""A camera for a lecture's step: it shows what the step names, in a view of any size.

A small deterministic search. Each direction around the parts is tried as near as they fit; the best
one shows them large, apart, not edge-on, and hidden by nothing. Pure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from app.images.picking import is_quick, nearest_hits
from app.outside.diagram import Arrow, Dot, Eye, Item, Label, Segments
from app.outside.extent import framed, level_frame
from app.outside.options import Sight
from app.outside.screen import OutsideScreen
from renderer.camera import Camera, Floats, Size
from renderer.scene.model import Scene

# Names of other items that belong to a part.
ALSO = {
    "eye": ("e",),
    "volume": ("edges", "near", "far"),
    "image plane": ("image sphere",),
    "target": ("to target",),
    "formula": ("term w", "term u", "term v", "term d"),
}

# From behind the camera, to its right and left, and up. In front of it, its picture is mirrored.
TURNS = np.radians([*range(-100, 101, 20), -140, 140, 180])
HEIGHTS = np.radians([7.0, 15.0, 25.0, 37.0, 54.0])
USUAL = np.radians([35.0, 20.0])  # turn and height
FOV_DEG, FAR_FOV_DEG = 34.0, 14.0  # of what looks; at parallel rays, from far: they stay parallel
TRIED = 12  # directions, the best ones, for which it is computed what is hidden
# What is enough, in parts of the view's shorter side: a line, an area's side, two marks' distance.
LINE, AREA, APART = 0.3, 0.45, 0.14
SINE = 0.5  # of a line or an area with the line of sight
ANGLE = math.radians(22.0)  # between lines from one point on the screen
COVERED = 3.0  # what a mark under the covered corner costs
SLACK = 0.01  # of the distance: what is nearer than this to a surface is on it


@dataclass(frozen=True, eq=False)
class Subject:
    """Parts to be seen. spots (n, 3). lines (n, 2, 3). areas: polygons (4, 3). things (n, 8, 3):
    boxes of objects. plane: a polygon that hides what is behind it, or None. others (n, 2, 3):
    lines that must not lie along those.
    """

    spots: Floats
    lines: Floats
    areas: tuple[Floats, ...]
    things: Floats
    plane: Floats | None
    others: Floats

    @cached_property
    def points(self) -> Floats:
        """Return all points that must be in the picture, (n, 3)."""
        parts = [self.spots, self.lines, *self.areas, self.things]
        return np.concatenate([part.reshape(-1, 3) for part in parts])

    @cached_property
    def ways(self) -> Floats:
        """Return the lines' directions, unit vectors (n, 3)."""
        return _units(self.lines[:, 1] - self.lines[:, 0])

    @cached_property
    def normals(self) -> list[Floats]:
        """Return the areas' normals, unit vectors."""
        return [_units(np.cross(area[1] - area[0], area[2] - area[0])) for area in self.areas]


def subject_of(items: Iterable[Item], see: Sequence[Sight], things: Floats) -> Subject:
    """Return the named parts of a diagram. An object that a mark is on is shown as a whole.

    things (n, 8, 3): boxes of the scene's objects.
    """
    names = {also for name in see for also in (name, *ALSO.get(name, ()))}
    spots, lines, areas, others = [], [], [], []
    plane: Floats | None = None
    for item in items:
        if isinstance(item, Segments) and not len(item.segments):
            continue
        is_closed = isinstance(item, Segments) and bool(
            (item.segments[-1, 1] == item.segments[0, 0]).all()
        )
        if isinstance(item, Segments) and item.name == "image plane":
            plane = item.segments[:, 0]
        if item.name not in names:
            if isinstance(item, Segments) and item.name == "edges":
                others += [*item.segments]
        elif isinstance(item, (Dot, Eye, Label)):
            spots.append(np.asarray(item.point, float))
        elif isinstance(item, Arrow):
            lines.append(np.array([item.start, item.end], float))
        elif isinstance(item, Segments) and is_closed:
            around = item.segments[:, 0]
            areas.append(around[:: max(len(around) // 4, 1)][:4])  # four of a curve's points
        elif isinstance(item, Segments):
            lines += [*item.segments]
    marks: Floats = np.unique(np.round(np.array(spots, float).reshape(-1, 3), 9), axis=0)
    inside = [_is_on_one(box, marks) for box in things]
    boxes = things if "scene" in names else things[np.array(inside, bool)]
    lines_, others_ = (np.reshape(part, (-1, 2, 3)) for part in (lines, others))
    return Subject(marks, lines_, tuple(areas), boxes, plane, others_)


def teaching_camera(
    subject: Subject,
    scene: Scene,
    home: Camera,
    size: Size,
    margin: tuple[float, float],
    corner: float = 0.0,
) -> Camera:
    """Return the camera that shows the subject best in a view of `size`.

    home: the camera in the scene; it looks from near it. margin: see extent.MARGIN. corner: the
    side of a square in the upper right corner that is covered, in pixels.
    """
    right, up, back = level_frame(home)
    tried: list[tuple[float, int, Camera]] = []
    for number, (turn, height) in enumerate((t, h) for t in TURNS for h in HEIGHTS):
        level = math.sin(turn) * right + math.cos(turn) * back
        toward = math.cos(height) * level + math.sin(height) * up
        looking = seeing(subject, toward, home, size, margin)
        off = (np.abs([turn, height] - USUAL) / (1.2, 0.5)) ** 2
        worth = _worth(subject, looking, size, corner) - float(off.sum())
        tried.append((worth - 1.5 * (abs(turn) > math.pi / 2), -number, looking))
    tried.sort(reverse=True)
    if not is_quick(scene):
        return tried[0][2]
    best = max(tried[:TRIED], key=lambda one: one[0] + _seen(subject, scene, one[2]))
    return best[2]


def seeing(
    subject: Subject, toward: Floats, home: Camera, size: Size, margin: tuple[float, float]
) -> Camera:
    """Return the camera in a direction that shows all of the subject as large as possible."""
    fov = FAR_FOV_DEG if home.is_parallel else FOV_DEG
    return framed(subject.points, toward, size[0] / size[1], margin=margin, fov_y_deg=fov)


def is_in_sight(subject: Subject, looking: Camera, size: Size) -> bool:
    """Return True if the camera's picture has all of the subject."""
    found = OutsideScreen(looking.fitted(size), size).spots(subject.points)
    return found is not None and bool(((found[0] >= 0) & (found[0] <= size)).all())


def _worth(subject: Subject, looking: Camera, size: Size, corner: float) -> float:
    """Return how large the parts are on the screen, how far from edge-on, and how far apart."""
    screen, side = OutsideScreen(looking, size), min(size)

    def at(points: Floats) -> Floats:
        return screen.on_screen(screen.homogeneous(points))[0]

    worth, lines, eye = 0.0, at(subject.lines), np.asarray(looking.eye)
    lengths = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
    worth += float(_log(lengths / (LINE * side)).sum())
    sight = _units(subject.lines.mean(axis=1) - eye)
    sines = np.sqrt(np.maximum(1 - (subject.ways * sight).sum(axis=1) ** 2, 0))
    worth += float(_log(np.minimum(sines / SINE, 1)).sum())
    for area, normal in zip(subject.areas, subject.normals, strict=True):
        x, y = at(area).T
        size_px = math.sqrt(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)
        sine = abs(float(normal @ _units(area.mean(axis=0) - eye)))
        worth += 2 * float(_log(np.array(size_px / (AREA * side))))
        worth += 2 * float(_log(np.array(min(sine / SINE, 1))))
    ends = np.concatenate([at(subject.spots), lines.reshape(-1, 2)])
    worth -= COVERED * ((ends[:, 0] > size[0] - corner) & (ends[:, 1] < corner)).sum()
    marks = np.concatenate([at(subject.spots), lines[:, 1], *map(at, subject.areas[:1])])
    gaps = np.linalg.norm(marks[:, None] - marks, axis=2)[np.triu_indices(len(marks), 1)]
    worth += float(_log(np.minimum(gaps / (APART * side), 1)).sum())
    return worth + _angles(np.concatenate([lines, at(subject.others)]), len(lines))


def _angles(lines: Floats, count: int) -> float:
    """Return a penalty for lines (n, 2, 2) on the screen that lie along the first `count`."""
    ways = _units(lines[:, 1] - lines[:, 0])
    angles = np.arccos(np.clip(ways[:count] @ ways.T, -1, 1))
    return float(_log(np.minimum(angles / ANGLE, 1))[np.triu_indices(count, 1, len(ways))].sum())


def _seen(subject: Subject, scene: Scene, looking: Camera) -> float:
    """Return a penalty for what is hidden, by the scene or by the image plane."""
    eye = np.asarray(looking.eye)
    parts = np.array([0.25, 0.5, 0.75, 1.0])[:, None]
    groups = [spot[None] for spot in subject.spots]
    groups += [start + parts * (end - start) for start, end in subject.lines]
    for a, b, _, d in subject.areas:
        x, y = np.meshgrid([0.1, 0.5, 0.9], [0.1, 0.5, 0.9])
        groups.append(a + x.reshape(-1, 1) * (b - a) + y.reshape(-1, 1) * (d - a))
    groups += [box.mean(axis=0)[None] for box in subject.things]
    points = np.concatenate(groups)
    slack = np.full(len(points), SLACK)
    if len(subject.things):  # an object's own surface does not hide it
        half = np.linalg.norm(np.ptp(subject.things, axis=1), axis=1) / 2
        slack[-len(half) :] = half / np.linalg.norm(points[-len(half) :] - eye, axis=1)
    t, _ = nearest_hits(scene, eye, points - eye)
    if subject.plane is not None:
        t = np.minimum(t, _on_plane(subject.plane, eye, points - eye))
    visible = t >= 1 - slack
    ends = np.cumsum([len(group) for group in groups])[:-1]
    shares = np.array([share.mean() for share in np.split(visible, ends)])
    return 2 * float(_log(np.maximum(shares, 0.05)).sum())


def _on_plane(plane: Floats, origin: Floats, directions: Floats) -> Floats:
    """Return t at which rays meet a parallelogram (4, 3), infinity where they do not."""
    one, two = plane[1] - plane[0], plane[3] - plane[0]
    normal = np.cross(one, two)
    with np.errstate(all="ignore"):
        t = (plane[0] - origin) @ normal / (directions @ normal)
        at = origin + t[:, None] * directions - plane[0]
        x, y = at @ one / (one @ one), at @ two / (two @ two)
    inside = (x >= 0) & (x <= 1) & (y >= 0) & (y <= 1) & (t > 0)
    return np.where(inside, t, np.inf)


def _is_on_one(box: Floats, marks: Floats) -> bool:
    """Return True if one of the points (n, 3) is in a box (8, 3), or nearly so."""
    first, sides = box[0], box[[4, 2, 1]] - box[0]
    with np.errstate(all="ignore"):
        at = np.nan_to_num((marks - first) @ sides.T / (sides**2).sum(axis=1))
    return bool(((at > -0.02) & (at < 1.02)).all(axis=1).any())


def _log(parts: Floats) -> Floats:
    """Return logarithms: small parts cost more than large ones gain; beyond 1 there is little."""
    found = np.log(np.maximum(parts, 0.01))
    return np.where(found > 0, 0.15 * found, found)


def _units(vectors: Floats) -> Floats:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)
