"""A diagram as a vector drawing: lines, areas, arcs and letters in groups, for SVG and for zooming.

Projected primitives and outlines are cut at the page's edge and divided where they pass behind
objects or the live image, which is the only part with pixels. Lines are divided by the depths of a
picture of the scene, to about a pixel. Areas are not: later ones cover earlier ones (painter's
order). Pure; knows nothing of files.

Positions and widths are in pixels of the page, from its upper left corner, x right, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Role, runs
from app.outside.image_bitmap import Standing, plane_t, standing
from app.outside.occlusion import Hidden, clipped, divided, on_page
from app.outside.outlines import Ellipse, Outline
from app.outside.placing import Box, LabelPlacer
from app.outside.projected import Primitive, Shape, Strokes, Text
from app.outside.screen import OutsideScreen
from renderer.raster.overlay import Plane

Floats = NDArray[np.float64]
Size = tuple[int, int]
Color = tuple[float, float, float]  # red, green, blue as displayed, 0 to 1
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
LETTER_PX, STRONG_PX = 16.0, 24.0  # the sizes of labels and of vectors' names, in symbols
ROOM, STRONG_ROOM = 13.0, 7.0  # from a point to its text, likewise
WIDE = 0.56  # a letter's width, in parts of its size
OUTLINE, SHARP = 1.5, 0.8  # the widths of outlines and of sharp edges, in widths of lines
STEPS = 720  # samples of an ellipse's visibility
SHORTEST_PX = 2.0  # shorter pieces of an outline between hidden ones are dropped
TURN = 2 * np.pi
DASHES = (5.0, 4.0)  # drawn and not drawn, in widths of lines


class Arc(NamedTuple):
    """A part of an ellipse, between two of its angles in radians."""

    ellipse: Ellipse
    start: float = 0.0
    end: float = TURN

    @property
    def is_closed(self) -> bool:
        return self.end - self.start >= TURN - 1e-9


class Letters(NamedTuple):
    """A text. center: of its box. size: of its font. strong: bold."""

    center: tuple[float, float]
    size: float
    text: str
    strong: bool


@dataclass(frozen=True, eq=False)
class Part:
    """An element of a drawing.

    form: the points (n, 2) of a line or a polygon, an arc, or a text. width: of the stroke; 0 for a
    filled form, and for text.
    """

    group: Group
    name: str
    form: Floats | Arc | Letters
    color: Color
    width: float = 0.0
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Drawing:
    """parts: in the order in which they are drawn, those of a group together. unit: the width of a
    line. notes: for the reader. standing: the live image, over the outlines and under all other
    parts.
    """

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
    screen: OutsideScreen,
    t: NDArray[np.float32] | None = None,
    left_out: Sequence[str] = (),
    image: PlaneImage | None = None,
) -> Drawing:
    """Return the drawing of a page.

    screen: the outside camera and the page. t: (height, width), the scene's ray parameter at each
    pixel of the page, infinity for none; None: unknown, and nothing is hidden. left_out: names of
    objects without an outline. image: covers what is behind it, including the objects' outlines.
    """
    size, is_parallel, unit = screen.size, screen.camera.is_parallel, screen.unit_px
    hidden = behind = Hidden(t, is_parallel)
    stands = None
    if image is not None:
        stands = standing(image.pixels, image.plane, size, hidden, image.opacity)
        before = plane_t(image.plane, size, is_parallel)
        behind = Hidden(before if t is None else np.minimum(t, before), is_parallel)
    parts: list[Part] = []
    for outline in found:
        parts += _outline(outline, hidden, paint, size, unit)
    smooth = _edges_of_shapes(primitives)
    kept = [part for number, part in enumerate(primitives) if number not in smooth]
    for primitive in sorted(kept, key=lambda part: getattr(part, "layer", 9)):  # stable
        if isinstance(primitive, Text):
            continue
        covered = hidden if primitive.on_plane else behind
        if isinstance(primitive, Shape):
            parts += _area(primitive, covered, paint, size)
        else:
            parts += _strokes(primitive, covered, paint, size)
    parts += _letters(primitives, paint, screen.symbol_px, size)
    parts.sort(key=lambda part: GROUPS.index(part.group))
    notes = ["Hidden parts of lines are dashed." if t is not None else "Nothing is hidden."]
    if left_out:
        notes.append(f"Without an outline, for too many triangles: {', '.join(left_out)}.")
    return Drawing(size, paint.background, tuple(parts), unit, tuple(notes), stands)


def _edges_of_shapes(primitives: Sequence[Primitive]) -> set[int]:
    """Return the numbers of strokes that only smooth a shape's edge in pixels."""
    return {
        number + 1
        for number, (shape, edge) in enumerate(pairwise(primitives))
        if isinstance(shape, Shape)
        and isinstance(edge, Strokes)
        and edge.name == shape.name
        and (edge.width_px, edge.layer, edge.tint) == (1.0, shape.layer, shape.tint)
        and not edge.on_plane
    }


def _strokes(part: Strokes, hidden: Hidden, paint: Paint, size: Size) -> Iterator[Part]:
    group, color, width = GROUP_OF[part.role], paint.color(part.role, part.tint), part.width_px
    is_spot = (part.points[:, 0] == part.points[:, 1]).all(axis=1)
    for spot, s in zip(part.points[is_spot, 0], part.depth[is_spot, :1], strict=True):
        if ((spot > -width / 2) & (spot < np.add(size, width / 2))).all():
            pale = part.hidden if hidden.at(spot[None], s)[0] else 1.0
            disc = Arc(Ellipse(tuple(spot.tolist()), (width / 2, width / 2)))
            yield Part(group, part.name, disc, color, opacity=part.opacity * pale)
    points, depth = clipped(part.points[~is_spot], part.depth[~is_spot], size, width)
    points, behind = divided(points, depth, hidden)
    for value in (True, False):  # visible parts cover hidden ones
        opacity = part.opacity * (part.hidden if value else 1.0)
        for chain in chains(points[behind == value]):
            yield Part(group, part.name, chain, color, width, opacity, part.dashed or value)


def _area(part: Shape, hidden: Hidden, paint: Paint, size: Size) -> Iterator[Part]:
    points = on_page(part.points, size)
    if len(points) < 3:
        return
    opacity = part.opacity
    # A small solid one, such as an arrow's head, is hidden as a whole, by its middle.
    middle, s = part.points.mean(axis=0)[None], part.depth.mean(keepdims=True)
    if opacity == 1 and hidden.at(middle, s)[0]:
        opacity = part.hidden
    color = paint.color(part.role, part.tint)
    yield Part(GROUP_OF[part.role], part.name, points, color, opacity=opacity)


def _letters(
    primitives: Sequence[Primitive], paint: Paint, symbol: float, size: Size
) -> Iterator[Part]:
    """Yield the labels, placed where they cover nothing."""
    texts = [part for part in primitives if isinstance(part, Text)]
    sizes = [symbol * (STRONG_PX if part.strong else LETTER_PX) for part in texts]
    counts = [sum(len(piece) for piece, _ in runs(part.text, part.strong)) for part in texts]
    boxes = tuple(
        Box(WIDE * em * count, em, symbol * (STRONG_ROOM if part.strong else ROOM))
        for part, em, count in zip(texts, sizes, counts, strict=True)
    )
    centers = LabelPlacer().place(primitives, boxes, size)
    for part, em, center in zip(texts, sizes, centers, strict=True):
        letters = Letters(center, em, part.text, part.strong)
        yield Part("letters", part.name, letters, paint.color(part.role, 0.0))


def _outline(
    outline: Outline, hidden: Hidden, paint: Paint, size: Size, unit: float
) -> Iterator[Part]:
    form, width = outline.form, OUTLINE * unit
    if isinstance(form, Ellipse):
        for arc in _visible_arcs(form, hidden, size, width):
            yield Part("outlines", outline.name, arc, paint.outline, width)
        return
    for sharp, width in ((True, SHARP * unit), (False, OUTLINE * unit)):
        chosen = form.sharp == sharp
        points, behind = divided(
            *clipped(form.points[chosen], form.depth[chosen], size, width), hidden
        )
        for chain in chains(points[~behind]):
            if np.linalg.norm(np.diff(chain, axis=0), axis=1).sum() >= SHORTEST_PX:
                yield Part("outlines", outline.name, chain, paint.outline, width)


def _visible_arcs(form: Ellipse, hidden: Hidden, size: Size, width: float) -> list[Arc]:
    """Return the arcs of an ellipse that are on the page and not hidden."""
    step = TURN / STEPS
    points = form.at((np.arange(STEPS, dtype=np.float64) + 0.5) * step)
    inside = ((points > -width) & (points < np.asarray(size) + width)).all(axis=1)
    visible = inside & ~hidden.at(points, form.depth_at(points))
    if visible.all():
        return [Arc(form)]
    first = int(np.argmin(visible))  # start where it is not visible
    edges = np.flatnonzero(np.diff(np.roll(visible, -first), append=False)) + 1 + first
    arcs = [Arc(form, *pair) for pair in (edges.reshape(-1, 2) * step).tolist()]
    return [arc for arc in arcs if (arc.end - arc.start) * max(form.radii) >= SHORTEST_PX]


def chains(segments: Floats) -> list[Floats]:
    """Join segments (n, 2, 2) at their common ends to lines (m, 2), in a fixed order."""
    keys = np.round(segments * 1000).astype(np.int64).tolist()
    at: dict[tuple[int, int], list[int]] = {}
    for number, ends in enumerate(keys):
        for end in ends:
            at.setdefault(tuple(end), []).append(number)
    used = [False] * len(keys)
    out: list[Floats] = []

    def follow(number: int, end: int) -> Iterator[list[float]]:
        """Yield the points after an end of a segment, as long as exactly two segments meet."""
        while True:
            place = tuple(keys[number][end])
            meeting = at[place]
            if len(meeting) != 2:
                return
            number = meeting[0] if meeting[1] == number else meeting[1]
            if used[number]:
                return
            used[number] = True
            end = 1 if tuple(keys[number][0]) == place else 0
            yield segments[number, end].tolist()

    for number in range(len(keys)):
        if not used[number]:
            used[number] = True
            before = [*follow(number, 0)][::-1]
            out.append(np.array([*before, *segments[number].tolist(), *follow(number, 1)]))
    return out


def dashes(points: Floats, unit: float) -> list[Floats]:
    """Return the drawn parts of a dashed line (n, 2). unit: the width of a line."""
    drawn, period = DASHES[0] * unit, sum(DASHES) * unit
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    run = np.concatenate([[0.0], np.cumsum(steps)])
    out = []
    for start in (np.arange(np.ceil(run[-1] / period)) * period).tolist():
        places = [start, min(start + drawn, float(run[-1]))]
        places[1:1] = run[(run > places[0]) & (run < places[1])].tolist()
        out.append(np.stack([np.interp(places, run, points[:, k]) for k in range(2)], axis=1))
    return out


def is_closed(points: Floats) -> bool:
    """Return True if a line (n, 2) ends where it starts."""
    return len(points) > 2 and bool(np.allclose(points[0], points[-1], atol=1e-3))
