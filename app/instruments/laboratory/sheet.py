"""A sheet for the laboratory's drawings: lines, shapes, words and pictures, in units of its own."""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.instruments.outside.figure import (
    Color,
    Figure,
    Inset,
    Label,
    Line,
    Part,
    Picture,
    Polygon,
)
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes

Point = tuple[float, float]

WIDTH = 0.09  # a line's width
CORNERS = 72  # per disc
HEAD = 0.7, 0.28  # the length of an arrow's head, and half of its width
BLACK, WHITE, YELLOW = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (0.94, 0.89, 0.26)
WALL = (0.05, 0.055, 0.065)  # a lit wall, and dark displays, in every theme
LIGHTS: tuple[Color, ...] = ((1.0, 0.3, 0.3), (0.2, 0.8, 0.4), (0.37, 0.61, 1.0))


@dataclass(frozen=True)
class Look:
    """The colours of a sheet: of the ground, of text, less and least important lines, fills,
    marks, rays, and the axes u, v and w.
    """

    ground: Color
    text: Color
    dim: Color
    line: Color
    fill: Color
    mark: Color
    ray: Color
    u: Color
    v: Color
    w: Color


class Sheet:
    """A collector of a figure's parts.

    A unit is the size of text; y points down. extent: the width and height in units, which are
    fitted to the sheet and centred. low: the point at the extent's upper left corner.
    """

    def __init__(self, size: Size, look: Look, extent: Point, low: ArrayLike = (0.0, 0.0)) -> None:
        self.size, self.look = size, look
        self.unit = min(size[0] / extent[0], size[1] / extent[1])
        self._first = (np.asarray(size) - self.unit * np.asarray(extent)) / 2
        self._low, self._opacity = np.asarray(low, float), 1.0
        self._parts: list[Part] = []

    def part(self, corner: ArrayLike = (0.0, 0.0), opacity: float = 1.0) -> Sheet:
        """Return the same sheet with its point (0, 0) at a corner, and with paler drawings."""
        other = copy(self)
        low, opacity = self._low - corner, self._opacity * opacity
        other._low, other._opacity = low, opacity  # noqa: SLF001, a copy of its own
        return other

    def figure(self) -> Figure:
        return Figure(self.size, tuple(self._parts), WIDTH * self.unit, self.look.ground)

    def px(self, points: ArrayLike) -> Floats:
        """Return points in pixels."""
        found: Floats = (np.asarray(points) - self._low) * self.unit + self._first
        return found

    def line(
        self,
        points: ArrayLike,
        color: Color | None = None,
        width: float = WIDTH,
        opacity: float = 1.0,
        dashed: bool = False,
    ) -> None:
        """Draw a line through points."""
        if opacity := opacity * self._opacity:
            ink, pieces = color or self.look.text, (self.px(points),)
            self._parts.append(Line("", pieces, ink, width * self.unit, opacity, dashed))

    def fill(self, points: ArrayLike, color: Color, opacity: float = 1.0) -> None:
        """Fill a convex polygon."""
        if opacity := opacity * self._opacity:
            self._parts.append(Polygon("", self.px(points), color, opacity))

    def outline(self, points: ArrayLike, color: Color | None = None, width: float = WIDTH) -> None:
        """Draw a closed line."""
        corners = np.asarray(points)
        self.line(np.concatenate([corners, corners[:2]]), color, width)

    def shape(self, points: ArrayLike, color: Color, edge: float = 0.16) -> None:
        """Fill a convex polygon, and draw its outline."""
        self.fill(points, color)
        self.outline(points, width=edge)

    def disc(self, center: ArrayLike, radius: float, color: Color, opacity: float = 1.0) -> None:
        self.fill(circle(center, radius), color, opacity)

    def arrow(self, start: ArrayLike, end: ArrayLike, color: Color | None = None) -> None:
        """Draw an arrow."""
        way = np.subtract(end, start)
        along = way / np.hypot(*way)
        across = HEAD[1] * np.array([-along[1], along[0]])
        foot = np.asarray(end) - HEAD[0] * along
        self.line([start, foot], color, 1.5 * WIDTH)
        self.fill([end, foot + across, foot - across], color or self.look.text)

    def word(
        self,
        text: str,
        at: ArrayLike,
        size: float = 1.0,
        color: Color | None = None,
        opacity: float = 1.0,
        strong: bool = False,
        **look: Any,
    ) -> None:
        """Write a text. strong: True for bold. look: mono, align and rim, as in Label."""
        if opacity := opacity * self._opacity:
            ink = mixed(self.look.ground, color or self.look.text, opacity)
            x, y = self.px(at).tolist()
            self._parts.append(Label("", text, (x, y), size * self.unit, ink, strong, **look))

    def picture(self, pixels: Bytes, low: Point, extent: Point) -> None:
        """Place a picture (height, width, 3)."""
        self._parts.append(Picture("", pixels, *self._corners(low, extent)))

    def inset(self, figure: Figure, low: Point, extent: Point, first: Point, scale: float) -> None:
        """Place a part of another figure: from its point `first`, magnified."""
        self._parts.append(Inset("", figure, *self._corners(low, extent), first, scale))

    def _corners(self, low: Point, extent: Point) -> tuple[Point, Point]:
        (left, top), (right, bottom) = self.px(np.array([low, np.add(low, extent)])).tolist()
        return (left, top), (right, bottom)


def rectangle(low: ArrayLike, extent: ArrayLike) -> Floats:
    """Return a rectangle's corners, clockwise on the sheet."""
    unit = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    corners: Floats = np.asarray(low) + unit * np.asarray(extent, float)
    return corners


def circle(center: ArrayLike, radius: ArrayLike, corners: int = CORNERS) -> Floats:
    """Return points of a circle, or of an ellipse with two radii, clockwise from the right."""
    angles = np.arange(corners) * (2 * math.pi / corners)
    points: Floats = np.stack([np.cos(angles), np.sin(angles)], axis=1) * np.asarray(radius, float)
    return points + np.asarray(center)


def rounded(low: ArrayLike, extent: ArrayLike, radius: float) -> Floats:
    """Return the outline of a rectangle with round corners."""
    half = np.asarray(extent, float) / 2
    around = circle((0.0, 0.0), 1.0, 32).round(9)
    points: Floats = np.asarray(low) + half + np.sign(around) * (half - radius) + radius * around
    return points


def mixed(one: Color, other: Color, part: float) -> Color:
    """Return a colour between two. part: the share of the other."""
    part = min(max(part, 0.0), 1.0)
    red, green, blue = ((1 - part) * a + part * b for a, b in zip(one, other, strict=True))
    return red, green, blue


def reached(progress: float, number: int) -> float:
    """Return the visible share of a drawing's part: 0 before build `number`, 1 from it on.

    progress: the drawing's progress, in builds.
    """
    return min(max(progress - number + 1, 0.0), 1.0)


def between(progress: float, places: Sequence[Any]) -> Any:
    """Return the value at a progress; `places` has the value of each build."""
    last = len(places) - 1
    first = min(int(progress), max(last - 1, 0))
    part = min(max(progress - first, 0.0), 1.0) if last else 0.0
    low, high = (np.asarray(one, float) for one in (places[first], places[min(first + 1, last)]))
    return (1 - part) * low + part * high
