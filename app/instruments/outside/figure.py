"""A figure: lines, polygons and labels on a page, over an image of the scene. Pure.

svg.py writes it, painting.py paints it. Lines are divided where the scene hides them; hidden parts
are dashed. Positions are in pixels from the page's upper left corner, x to the right, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes
from lucida.renderer.raster.overlay import BACK_LIGHT, Plane

from .diagram import Role, runs
from .placing import Box, LabelPlacer
from .projected import Primitive, Shape, Strokes, Text
from .screen import OutsideScreen

Depths = NDArray[np.float32]
Bools = NDArray[np.bool_]

Color = tuple[float, float, float]  # red, green, blue as displayed, 0 to 1

LETTER_PX, STRONG_PX = 16.0, 24.0  # the sizes of labels and of vectors' names, in symbols
ROOM, STRONG_ROOM = 13.0, 7.0  # the spaces between a point and its text, in symbols
LETTER_WIDTH = 0.56  # relative to its size
BEHIND = 1.001  # times the scene's t
CORNERS = 48  # per disc
DASHES = (5.0, 4.0)  # lengths of a dash and a gap, in widths of lines
RIM = 0.18  # the rim's width around letters, relative to their size
WHITE = (1.0, 1.0, 1.0)  # the colour of rims on a transparent ground


@dataclass(frozen=True, eq=False)
class Line:
    """A line of several pieces, points (n, 2) each."""

    name: str
    pieces: tuple[Floats, ...]
    color: Color
    width: float
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Polygon:
    """A filled convex polygon, points (n, 2)."""

    name: str
    points: Floats
    color: Color
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Label:
    """A text.

    center: the centre of its box. size: the font's size. strong: True for bold. mono: True for a
    fixed width. align: the share of its width left of the centre: 0, 0.5 or 1. rim: False if it is
    not on the page's ground.
    """

    name: str
    text: str
    center: tuple[float, float]
    size: float
    color: Color
    strong: bool
    mono: bool = False
    align: float = 0.5
    rim: bool = True


@dataclass(frozen=True, eq=False)
class Picture:
    """Display pixels (height, width, 3 or 4), drawn as flat rectangles between two corners."""

    name: str
    pixels: Bytes
    low: tuple[float, float]
    high: tuple[float, float]

    @property
    def is_fine(self) -> bool:
        """True if it has more pixels than the page, which shows their mean."""
        return self.pixels.shape[1] > self.high[0] - self.low[0] + 1


@dataclass(frozen=True, eq=False)
class Inset:
    """A part of another figure, magnified, between two corners of the page.

    first: the point of that figure at the corner `low`. scale: its magnification.
    """

    name: str
    figure: Figure
    low: tuple[float, float]
    high: tuple[float, float]
    first: tuple[float, float]
    scale: float


Part = Line | Polygon | Label | Picture | Inset


@dataclass(frozen=True, eq=False)
class Figure:
    """A page of `size` pixels.

    parts: the parts in drawing order. unit: the width of a line. ground: the page's
    colour, and that of the labels' rims; None if it is transparent. image: the scene, (height,
    width, 4) as displayed, stretched over the page; None for lines alone.
    """

    size: Size
    parts: tuple[Part, ...]
    unit: float
    ground: Color | None
    image: Bytes | None = None


def figure_parts(
    primitives: Sequence[Primitive],
    color: Callable[[Role, float], Color],
    screen: OutsideScreen,
    t: Depths,
    plane: Plane | None = None,
) -> tuple[Part, ...]:
    """Return the parts of a figure.

    color: returns the colour of a role, with a tint (1: white, -1: black). t: (height, width), the
    scene's ray parameters at the pixels of the page, infinity where nothing is hit. plane: a plane
    that hides everything behind it.
    """
    is_parallel = screen.camera.is_parallel
    scene = behind = _farthest(t)
    if plane is not None:
        behind = _farthest(np.minimum(t, on_plane(screen, plane)[0]))
    parts: list[Part] = []
    drawn = [part for part in primitives if not isinstance(part, Text)]
    for part in sorted(drawn, key=lambda one: one.layer):
        limit = scene if part.on_plane else behind
        ink = color(part.role, part.tint)
        if isinstance(part, Shape):
            opacity = part.opacity
            # A solid part, such as an arrow's head, is hidden as a whole if its middle is.
            middle, s = part.points.mean(axis=0)[None], part.depth.mean(keepdims=True)
            if opacity == 1 and _is_hidden(middle, s, limit, is_parallel)[0]:
                opacity = part.hidden
            parts.append(Polygon(part.name, part.points, ink, opacity))
        else:
            parts += _strokes(part, ink, limit, is_parallel)
    return (*parts, *_labels(primitives, color, screen))


def _strokes(part: Strokes, ink: Color, limit: Depths, is_parallel: bool) -> Iterator[Part]:
    is_spot = (part.points[:, 0] == part.points[:, 1]).all(axis=1)
    spots = part.points[is_spot, 0]
    hidden = _is_hidden(spots, part.depth[is_spot, 0], limit, is_parallel)
    angles = np.arange(CORNERS) * (2 * np.pi / CORNERS)
    ring = part.width_px / 2 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for spot, is_behind in zip(spots, hidden, strict=True):
        opacity = part.opacity * (part.hidden if is_behind else 1.0)
        yield Polygon(part.name, spot + ring, ink, opacity)
    pieces, behind = divided(part.points[~is_spot], part.depth[~is_spot], limit, is_parallel)
    for value in (True, False):  # visible pieces cover hidden ones
        opacity = part.opacity * (part.hidden if value else 1.0)
        found = tuple(_joined(pieces[behind == value]))
        if found and opacity > 0:
            dashed = part.dashed or value
            yield Line(part.name, found, ink, part.width_px, opacity, dashed)


def divided(
    points: Floats, depth: Floats, limit: Depths, is_parallel: bool
) -> tuple[Floats, Bools]:
    """Divide segments (n, 2, 2) with depths (n, 2), to about a pixel, at the points where they
    become hidden or visible. Return the pieces (m, 2, 2), and (m,) True if hidden.
    """
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    counts = np.maximum(np.ceil(lengths), 1).astype(int)
    of = np.repeat(np.arange(len(points)), counts)
    place = np.arange(len(of)) - (np.cumsum(counts) - counts)[of]
    part = (place + 0.5) / counts[of]
    along, deeper = points[:, 1] - points[:, 0], depth[:, 1] - depth[:, 0]
    spots = points[of, 0] + part[:, None] * along[of]
    behind = _is_hidden(spots, depth[of, 0] + part * deeper[of], limit, is_parallel)
    begins = np.ones(len(of) + 1, bool)
    begins[1:-1] = (of[1:] != of[:-1]) | (behind[1:] != behind[:-1])
    start, last = np.flatnonzero(begins[:-1]), np.flatnonzero(begins[1:])
    of = of[start]
    low, high = (place[start] / counts[of])[:, None], ((place[last] + 1) / counts[of])[:, None]
    # The ends keep their exact numbers, by which segments are joined.
    first = np.where(low == 0, points[of, 0], points[of, 0] + low * along[of])
    second = np.where(high == 1, points[of, 1], points[of, 0] + high * along[of])
    return np.stack([first, second], axis=1), behind[start]


def _joined(segments: Floats) -> list[Floats]:
    """Join segments (n, 2, 2) that continue each other to lines (m, 2)."""
    if not len(segments):
        return []
    breaks = np.flatnonzero((segments[1:, 0] != segments[:-1, 1]).any(axis=1)) + 1
    return [np.vstack([run[:1, 0], run[:, 1]]) for run in np.split(segments, breaks)]


def _farthest(t: Depths) -> Depths:
    """Return the largest t of the nine pixels around each pixel.

    An object's own edge, which lies between its pixels and others, must stay visible.
    """
    height, width = t.shape
    wide = np.pad(np.where(np.isnan(t), np.inf, t), 1, mode="edge")
    around = [wide[i : i + height, j : j + width] for i in range(3) for j in range(3)]
    found: Depths = np.max(around, axis=0)
    return found


def _is_hidden(points: Floats, depth: Floats, limit: Depths, is_parallel: bool) -> Bools:
    """Return True for each place (n, 2) with depth s (n,) behind `limit`; False off the page."""
    height, width = limit.shape
    column, row = np.floor(np.clip(points, -1, 1e6)).astype(int).T
    inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
    scene = limit[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    with np.errstate(all="ignore"):
        t = depth if is_parallel else np.where(depth > 0, 1 / depth, np.inf)
    found: Bools = inside & (t > BEHIND * scene)
    return found


def _labels(
    primitives: Sequence[Primitive], color: Callable[[Role, float], Color], screen: OutsideScreen
) -> Iterator[Label]:
    """Yield the labels, placed where they cover nothing."""
    texts = [part for part in primitives if isinstance(part, Text)]
    symbol = screen.symbol_px
    sizes = [symbol * (STRONG_PX if part.strong else LETTER_PX) for part in texts]
    counts = [sum(len(piece) for piece, _ in runs(part.text, part.strong)) for part in texts]
    boxes = tuple(
        Box(LETTER_WIDTH * em * count, em, symbol * (STRONG_ROOM if part.strong else ROOM))
        for part, em, count in zip(texts, sizes, counts, strict=True)
    )
    centers = LabelPlacer().place(primitives, boxes, screen.size)
    for part, em, center in zip(texts, sizes, centers, strict=True):
        yield Label(part.name, part.text, center, em, color(part.role, 0.0), part.strong)


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


def on_plane(screen: OutsideScreen, plane: Plane, fine: int = 1) -> tuple[Depths, Floats]:
    """Return the plane's ray parameters at the pixels of the page, (height, width), infinity
    outside its picture, and the places (height, width, 2) in the picture, 0 to 1.

    fine: the number of samples per side of a page pixel.
    """
    x, y = ((np.arange(side * fine) + 0.5) / fine - side / 2 for side in screen.size)
    spots = np.stack([*np.meshgrid(x, y), np.ones((len(y), len(x)))], axis=-1)
    at, s = spots @ plane.from_screen.T, spots @ plane.depth
    with np.errstate(all="ignore"):
        places = at[..., :2] / at[..., 2:]
        t = s if screen.camera.is_parallel else 1 / s
    inside = (s > 0) & (places >= 0).all(axis=-1) & (places <= 1).all(axis=-1)
    return np.where(inside, t, np.inf).astype(np.float32), places


def with_picture(
    image: Bytes,
    t: Depths,
    screen: OutsideScreen,
    plane: Plane,
    pixels: Bytes,
    opacity: float,
) -> Bytes:
    """Return an image of the scene with a picture on the image plane.

    image: (height, width, 4), a whole number of times larger than the screen. t: the scene's ray
    parameters at the image's pixels. pixels: the picture's, (height, width, 3), as displayed.
    """
    reached, places = on_plane(screen, plane, image.shape[1] // screen.size[0])
    shown = reached < t
    height, width = pixels.shape[:2]
    column, row = (places[shown] * (width, height)).astype(int).T
    over = np.full((len(row), 4), 255.0)
    over[:, :3] = pixels[np.minimum(row, height - 1), np.minimum(column, width - 1)]
    over[:, :3] *= 1.0 if plane.is_front else BACK_LIGHT
    result = image.copy()
    result[shown] = np.round(opacity * over + (1 - opacity) * image[shown])
    return result
