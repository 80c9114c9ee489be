"""Displays over time: the tube, mirrors (DLP), liquid crystals (LCD), diodes (LED).

For each display, the mean over a cycle is the pixel's linear colour. A cycle is one showing of the
picture; a phase in 0..1 is a moment of it. Colours (H, W, 3) are linear, 0..1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lucida.app.instruments.outside.figure import Color, Figure
from lucida.renderer.images.display import to_srgb8

from .page import Page
from .sheet import LIGHTS, WALL, YELLOW, Sheet, mixed, reached, rectangle, rounded

Floats = NDArray[np.float32]
Place = tuple[float, float, float, float, float]  # middle x, y; half the width, height; rounding

FADING = 0.1  # the share of a cycle in which a phosphor's light falls to 1/e; real ones are faster
GRAY = 0.3
DARKEST = 30  # the least displayed value of an element
COLORS = np.array(
    [[(1, 1, 1), (1, 1, 0), (0, 1, 1), (0, 1, 0)],
     [(GRAY, GRAY, GRAY), (1, 0, 1), (1, 0, 0), (0, 0, 1)]], np.float32,
)  # fmt: skip
MARKED = (1, 0)  # the gray pixel
MOMENTS = 240
SIDE, LANE = 3.5, 0.95  # the sizes of a pixel, and of a chart of its light


@dataclass(frozen=True)
class DisplayKind:
    """A kind of display.

    light: maps (colour, phase) to the light of each element, 0..1 of its full brightness.
    places: those of the red, green and blue elements in a pixel of side 1, or of the only element.
    way: the origin of its colours, in words.
    """

    title: str
    way: str
    light: Callable[[Floats, float], Floats]
    places: tuple[Place, ...]

    @property
    def elements(self) -> list[tuple[list[int], Place]]:
        """Return a pixel's elements: each one's channels and place. A mirror has all three."""
        if len(self.places) == 1:
            return [([0, 1, 2], self.places[0])]
        return [([channel], place) for channel, place in enumerate(self.places)]


def _fading(color: Floats, phase: float) -> Floats:
    """Return the light of dots that fade after a beam has hit them one by one, row by row."""
    rows, columns = color.shape[:2]
    met = np.arange(rows * columns).reshape(rows, columns, 1) / (rows * columns)
    return np.asarray(color * np.exp(-((phase - met) % 1.0) / FADING), np.float32)


def _mirrored(color: Floats, phase: float) -> Floats:
    """Return the light of a mirror: it is on for a share of each colour's third of the cycle."""
    third = min(int(3 * phase), 2)
    light = np.zeros_like(color)
    light[..., third] = color[..., third] > 3 * phase - third
    return light


def _held(color: Floats, phase: float) -> Floats:
    return color


def _switched(color: Floats, phase: float) -> Floats:
    """Return light that is fully on for a share of the time."""
    return np.asarray(color > phase, np.float32)


def _stripes(width: float, height: float, rounding: float) -> tuple[Place, ...]:
    return tuple((x / 6, 0.5, width / 2, height / 2, rounding) for x in (1, 3, 5))


_DOT = 0.22, 0.22, 0.22

DISPLAYS: tuple[DisplayKind, ...] = (
    DisplayKind(
        "Tube",
        "beams; dots that fade",
        _fading,
        ((0.25, 0.27, *_DOT), (0.75, 0.27, *_DOT), (0.5, 0.73, *_DOT)),
    ),
    DisplayKind(
        "DLP",
        "colours in turn",
        _mirrored,
        ((0.5, 0.5, 0.46, 0.46, 0.03),),
    ),
    DisplayKind(
        "LCD",
        "light behind filters",
        _held,
        _stripes(0.29, 0.92, 0.02),
    ),
    DisplayKind(
        "LED",
        "stripes that shine",
        _switched,
        _stripes(0.22, 0.74, 0.09),
    ),
)


def displays(page: Page) -> Figure:
    """Draw the same few pixels on four displays, each with the light of the gray pixel over a
    cycle. They appear one by one.
    """
    sheet, phase = page.sheet((32, 28.8)), page.options.phase % 1.0
    for number, display in enumerate(DISPLAYS):
        corner = 1.0 + 16.0 * (number % 2), 14.5 * (number // 2)
        part = sheet.part(corner, reached(page.progress, number))
        part.word(display.title, (0.0, 0.9), 1.5, strong=True, align=0.0)
        part.word(display.way, (0.0, 2.7), 1.45, page.look.dim, align=0.0)
        _pixels(part.part((0.0, 3.8)), display, phase)
        _lanes(part.part((0.0, 4.2 + SIDE * len(COLORS))), display, phase)
    return sheet.figure()


def _pixels(sheet: Sheet, kind: DisplayKind, phase: float) -> None:
    """Draw the elements of all pixels with the light that they send, and a frame around the gray
    one.
    """
    rows, columns = COLORS.shape[:2]
    sheet.fill(rectangle((0.0, 0.0), (SIDE * columns, SIDE * rows)), WALL)
    light = kind.light(COLORS, phase)
    for row, column in np.ndindex(rows, columns):
        pixel = sheet.part((SIDE * column, SIDE * row))
        for channels, place in kind.elements:
            sent = np.zeros(3, np.float32)
            sent[channels] = light[row, column, channels]
            x, y, half_x, half_y, rounding = (SIDE * part for part in place)
            low, extent = (x - half_x, y - half_y), (2 * half_x, 2 * half_y)
            pixel.fill(rounded(low, extent, rounding), _shown(sent))
    marked = SIDE * MARKED[1], SIDE * MARKED[0]
    sheet.outline(rectangle(marked, (SIDE, SIDE)), YELLOW, 0.16)


def _shown(light: Floats) -> Color:
    """Return light as displayed; an element without light is just visible."""
    red, green, blue = (max(int(value), DARKEST) / 255 for value in to_srgb8(light))
    return red, green, blue


def _lanes(sheet: Sheet, kind: DisplayKind, phase: float) -> None:
    """Draw the gray pixel's red, green and blue light over a cycle, and mark the moment."""
    look, width, tall = sheet.look, SIDE * COLORS.shape[1], 0.9 * LANE
    for channel, values in enumerate(course(kind).T):
        lane = sheet.part((0.0, LANE * channel))
        lane.fill(rectangle((0.0, 0.0), (width, tall)), mixed(look.ground, look.fill, 0.5))
        ends = [0, *(np.flatnonzero(np.diff(values)) + 1).tolist(), MOMENTS]
        for first, last in pairwise(ends):
            low = width * first / MOMENTS, tall * (1 - float(values[first]))
            extent = width * (last - first) / MOMENTS, tall - low[1]
            lane.fill(rectangle(low, extent), LIGHTS[channel])
    x = width * phase
    sheet.line([(x, -0.1), (x, 3 * LANE)], look.mark, 0.14)


def course(kind: DisplayKind) -> Floats:
    """Return the gray pixel's light over a cycle, 0..1 of full brightness: (MOMENTS, 3)."""
    phases = (np.arange(MOMENTS) + 0.5) / MOMENTS
    return np.array([kind.light(COLORS, float(phase))[MARKED] for phase in phases], np.float32)
