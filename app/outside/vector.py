"""A diagram as a vector drawing: lines, areas, arcs and letters in groups, for SVG and for zooming.

Owns what becomes of projected primitives and outlines: cut at the page's edge, divided where they
pass behind objects or the live image, which is the only thing in it that has pixels. Lines are
divided by the depths of a picture of the scene, to about a pixel; areas are not, the later one lies
over the earlier (painter's order). Pure; knows nothing of files.

Positions and widths are in pixels of the page, from its upper left corner, x right, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Role
from app.outside.image_bitmap import Standing, plane_t, standing
from app.outside.occlusion import Hidden, clipped, cut_polygon, divided, runs_of
from app.outside.outlines import Edges, Ellipse, Outline
from app.outside.projected import Primitive, Shape, Strokes, Text
from renderer.camera import Camera
from renderer.raster.overlay import Plane

Floats = NDArray[np.float64]
Size = tuple[int, int]
Color = tuple[float, float, float]  # red, green, blue as on the screen, 0 to 1
Group = Literal[
    "outlines", "frustum", "image plane", "more", "rays", "marks", "basis", "eye", "letters"
]

GROUPS: tuple[Group, ...] = (  # in the order in which they are drawn
    *("outlines", "frustum", "image plane", "more"),
    *("rays", "marks", "basis", "eye", "letters"),
)
GROUP_OF: dict[Role, Group] = {
    **{"volume": "frustum", "plane": "image plane", "grid": "image plane", "ray": "rays"},
    **{"u": "basis", "v": "basis", "w": "basis", "eye": "eye", "mark": "marks"},
    **{"text": "letters", "extra": "more", "other": "more", "pose": "more"},
}
LETTER_PX, STRONG_PX = 16.0, 24.0  # a label's and a vector's name, in units of symbols
ROOM, STRONG_ROOM = 13.0, 7.0  # from a point to its text, likewise
WIDE = 0.56  # of a letter, in parts of its size
OUTLINE, SHARP = 1.5, 0.8  # widths of outlines and of sharp edges, in units of lines
STEPS = 720  # places of an ellipse at which it is looked whether it is seen
SHORTEST_PX = 2.0  # of an outline's pieces between hidden ones


@dataclass(frozen=True, eq=False)
class VectorLine:
    """Through points (n, 2)."""

    group: Group
    name: str
    points: Floats
    color: Color
    width: float
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Area:
    """A filled polygon, (n, 2)."""

    group: Group
    name: str
    points: Floats
    color: Color
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Spot:
    """A filled disc."""

    group: Group
    name: str
    center: tuple[float, float]
    radius: float
    color: Color
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Arc:
    """Part of an ellipse, from one of its angles to a larger one, in radians; 2 pi apart for all of
    it.
    """

    group: Group
    name: str
    ellipse: Ellipse
    start: float
    end: float
    color: Color
    width: float


@dataclass(frozen=True)
class Letters:
    """A text with the middle of its box at center; size: of its font. strong: bold."""

    group: Group
    name: str
    center: tuple[float, float]
    size: float
    text: str
    color: Color
    strong: bool


Part = VectorLine | Area | Spot | Arc | Letters


@dataclass(frozen=True, eq=False)
class Drawing:
    """parts: in the order in which they are drawn, those of a group together. unit: the width of a
    line that teaches. notes: what a reader should know. standing: the live image, over the outlines
    and under all other parts."""

    size: Size
    background: Color
    parts: tuple[Part, ...]
    unit: float
    notes: tuple[str, ...] = ()
    standing: Standing | None = None


@dataclass(frozen=True, eq=False)
class PlaneImage:
    """The picture on the image plane: its pixels (height, width, 3), as displayed."""

    pixels: NDArray[np.uint8]
    plane: Plane
    opacity: float


@dataclass(frozen=True)
class Paint:
    """color: of a role, with a tint (1: white, -1: black). outline: of objects."""

    color: Callable[[Role, float], Color]
    outline: Color
    background: Color


def drawing(
    primitives: Sequence[Primitive],
    found: Iterable[Outline],
    paint: Paint,
    camera: Camera,
    size: Size,
    t: NDArray[np.float32] | None = None,
    unit: float = 1.0,
    symbol: float = 1.0,
    left_out: Sequence[str] = (),
    image: PlaneImage | None = None,
) -> Drawing:
    """The drawing of a page of `size` = (width, height).

    t: (height, width), the scene's ray parameter at each pixel of the page, infinity for none;
    None: not known, nothing is hidden. camera: the one that looks. unit, symbol: the widths of
    lines, the sizes of what has one. left_out: names of objects without an outline. image: hides
    what is behind it, but for the objects' outlines, over which it lies.
    """
    hidden = behind = Hidden(t, camera.is_parallel)
    stands = None
    if image is not None:
        stands = standing(image.pixels, image.plane, size, hidden, image.opacity)
        before = plane_t(image.plane, size, camera.is_parallel)
        behind = Hidden(before if t is None else np.minimum(t, before), camera.is_parallel)
    parts: list[Part] = []
    for outline in found:
        parts += _outline(outline, hidden, paint, size, unit)
    ordered = sorted(
        enumerate(primitives), key=lambda pair: (getattr(pair[1], "layer", 9), pair[0])
    )
    smooth = _edges_of_shapes(primitives)
    for number, primitive in ordered:
        if isinstance(primitive, Text):
            parts.append(_letters(primitive, paint, symbol))
        elif isinstance(primitive, Shape):
            parts += _area(primitive, hidden if primitive.on_plane else behind, paint, size)
        elif number not in smooth:
            parts += _strokes(primitive, hidden if primitive.on_plane else behind, paint, size)
    parts.sort(key=lambda part: GROUPS.index(part.group))  # stable
    notes = ["Hidden parts of lines are dashed." if t is not None else "Nothing is hidden."]
    if left_out:
        notes.append(f"Without an outline, for too many triangles: {', '.join(left_out)}.")
    return Drawing(size, paint.background, tuple(parts), unit, tuple(notes), stands)


def _edges_of_shapes(primitives: Sequence[Primitive]) -> set[int]:
    """The numbers of strokes that only make a shape's edge smooth on pixels."""
    return {
        number + 1
        for number, (shape, edge) in enumerate(pairwise(primitives))
        if isinstance(shape, Shape)
        and isinstance(edge, Strokes)
        and edge.name == shape.name
        and (edge.width_px, edge.layer, edge.tint) == (1.0, shape.layer, shape.tint)
        and not edge.on_plane
    }


def _strokes(part: Strokes, hidden: Hidden, paint: Paint, size: Size) -> list[Part]:
    group, color = GROUP_OF[part.role], paint.color(part.role, part.tint)
    lengths = np.linalg.norm(part.points[:, 1] - part.points[:, 0], axis=1)
    out: list[Part] = []
    for spot, s in zip(part.points[lengths == 0, 0], part.depth[lengths == 0, 0], strict=True):
        radius = part.width_px / 2
        if not (-radius < spot[0] < size[0] + radius and -radius < spot[1] < size[1] + radius):
            continue
        pale = part.hidden if hidden.at(spot[None], np.array([s]))[0] else 1.0
        x, y = spot.tolist()
        out.append(Spot(group, part.name, (x, y), radius, color, part.opacity * pale))
    points, depth, _ = clipped(
        part.points[lengths > 0], part.depth[lengths > 0], size, part.width_px
    )
    points, behind = divided(points, depth, hidden)
    for value in (True, False):  # what is seen lies over what is hidden
        opacity = part.opacity * (part.hidden if value else 1.0)
        for chain in chains(points[behind == value]):
            dashed = part.dashed or value
            out.append(VectorLine(group, part.name, chain, color, part.width_px, opacity, dashed))
    return out


def _area(part: Shape, hidden: Hidden, paint: Paint, size: Size) -> list[Part]:
    points = cut_polygon(part.points, size)
    if len(points) < 3:
        return []
    opacity = part.opacity
    if opacity == 1:  # small and solid, such as an arrow's head: all of it, by its middle
        middle = part.points.mean(axis=0)[None]
        opacity *= part.hidden if hidden.at(middle, part.depth.mean(keepdims=True))[0] else 1.0
    return [
        Area(GROUP_OF[part.role], part.name, points, paint.color(part.role, part.tint), opacity)
    ]


def _letters(part: Text, paint: Paint, symbol: float) -> Letters:
    size = symbol * (STRONG_PX if part.strong else LETTER_PX)
    dx, dy = part.toward
    room = symbol * (STRONG_ROOM if part.strong else ROOM)
    # The text's box touches a circle round the point from outside.
    room += abs(dx) * WIDE * size * len(part.text) / 2 + abs(dy) * size / 2
    center = part.at[0] + dx * room, part.at[1] + dy * room
    color = paint.color(part.role, 0.0)
    return Letters("letters", part.name, center, size, part.text, color, part.strong)


def _outline(outline: Outline, hidden: Hidden, paint: Paint, size: Size, unit: float) -> list[Part]:
    form = outline.form
    if isinstance(form, Ellipse):
        arcs = _seen_arcs(form, hidden, size, OUTLINE * unit)
        return [
            Arc("outlines", outline.name, form, *arc, paint.outline, OUTLINE * unit) for arc in arcs
        ]
    out: list[Part] = []
    for sharp, width in ((True, SHARP * unit), (False, OUTLINE * unit)):
        out += [
            VectorLine("outlines", outline.name, chain, paint.outline, width)
            for chain in _seen_lines(form, form.sharp == sharp, hidden, size, width)
        ]
    return out


def _seen_lines(
    form: Edges, chosen: NDArray[np.bool_], hidden: Hidden, size: Size, width: float
) -> list[Floats]:
    points, depth, _ = clipped(form.points[chosen], form.depth[chosen], size, width)
    points, behind = divided(points, depth, hidden)
    found = chains(points[~behind])
    return [chain for chain in found if _px_long(chain) >= SHORTEST_PX]


def _px_long(points: Floats) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _seen_arcs(
    form: Ellipse, hidden: Hidden, size: Size, width: float
) -> list[tuple[float, float]]:
    """The ellipse's angles between which it is on the page and not hidden."""
    step = 2 * np.pi / STEPS
    points = form.at((np.arange(STEPS, dtype=np.float64) + 0.5) * step)
    inside = ((points > -width) & (points < np.asarray(size) + width)).all(axis=1)
    seen = inside & ~hidden.at(points, form.depth_at(points))
    if seen.all():
        return [(0.0, 2 * np.pi)]
    if not seen.any():
        return []
    turn = int(np.argmin(seen))  # begins where it is not seen
    found = []
    for start, end, value in runs_of(np.roll(seen, -turn)):
        arc = (start + turn) * step, (end + turn) * step
        if value and (arc[1] - arc[0]) * max(form.radii) >= SHORTEST_PX:
            found.append(arc)
    return found


def chains(segments: Floats) -> list[Floats]:
    """Segments (n, 2, 2) joined at their common ends to lines (m, 2), in a fixed order."""
    keys = np.round(segments * 1000).astype(np.int64).tolist()
    at: dict[tuple[int, int], list[int]] = {}
    for number, ends in enumerate(keys):
        for end in ends:
            at.setdefault(tuple(end), []).append(number)
    used = [False] * len(keys)
    out: list[Floats] = []

    def follow(number: int, end: int) -> list[list[float]]:
        """The points after an end of a segment, as far as exactly two segments meet."""
        points: list[list[float]] = []
        while True:
            place = tuple(keys[number][end])
            meeting = at[place]
            if len(meeting) != 2:
                return points
            number = meeting[0] if meeting[1] == number else meeting[1]
            if used[number]:
                return points
            used[number] = True
            end = 1 if tuple(keys[number][0]) == place else 0
            points.append(segments[number, end].tolist())

    for number in range(len(keys)):
        if used[number]:
            continue
        used[number] = True
        middle = segments[number].tolist()
        before = follow(number, 0)
        out.append(np.array([*reversed(before), *middle, *follow(number, 1)]))
    return out
