"""One drawing in two representations: as pixels and as shapes, at increasing magnification."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from lucida.app.instruments.outside.figure import WHITE, Color, Figure, Line, Polygon
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes

from .page import Page
from .sheet import Look, Sheet, between, circle, rectangle

SIDE_PX, PIXELS = 512, 128  # the sizes of the drawing and of its raster image
SAMPLES = 4  # per side of a pixel
FOCUS = (0.8, 0.635)  # the point that stays in the middle, as fractions of the drawing
PANE = 15.0
# The letters H, M and E are strokes, which look the same everywhere; O is an ellipse.
WORD = (
    [(0, 0), (0, 1)], [(1.1, 0), (1.1, 1)], [(0, 0.5), (1.1, 0.5)],
    [(3.4, 1), (3.4, 0), (4.05, 0.6), (4.7, 0), (4.7, 1)],
    [(6.3, 0), (5.3, 0), (5.3, 1), (6.3, 1)], [(5.3, 0.5), (6.1, 0.5)],
)  # fmt: skip


def raster_and_vector(page: Page) -> Figure:
    """Draw both representations. Build 1 magnifies four times, build 2 sixteen times."""
    zoom = 4 ** min(page.progress, 2.0)
    drawing = house(page.look)
    picture = bitmap(drawing, (PIXELS, PIXELS))
    as_pixels = Sheet(drawing.size, page.look, (1, 1))
    as_pixels.picture(picture, (0, 0), (1, 1))
    beside = 3 * page.size[0] > 2.6 * page.size[1]
    sheet = page.sheet((32, 19.8) if beside else (16, 39.6))
    step = (16.5, 0.0) if beside else (0.0, 19.8)
    captions = (
        ("Raster", f"{PIXELS} x {PIXELS} pixels"),
        ("Vector", f"{len(drawing.parts)} shapes"),
    )
    middle = between(min(page.progress, 1.0), ((0.5, 0.5), FOCUS))
    first = np.clip(middle - 0.5 / zoom, 0, 1 - 1 / zoom) * SIDE_PX
    for number, (figure, (title, caption)) in enumerate(
        zip((as_pixels.figure(), drawing), captions, strict=True)
    ):
        left, top = 0.25 + number * step[0], 0.25 + number * step[1]
        scale = PANE * sheet.unit / SIDE_PX * zoom
        sheet.inset(figure, (left, top), (PANE, PANE), (first[0], first[1]), scale)
        sheet.outline(rectangle((left, top), (PANE, PANE)), page.look.line)
        sheet.word(title, (left + PANE / 2, top + 16.2), 1.5, strong=True)
        sheet.word(caption, (left + PANE / 2, top + 18.3), 1.65, page.look.dim)
    return sheet.figure()


@lru_cache(maxsize=2)
def house(look: Look) -> Figure:
    """Return a house, the sun and a word: lines, filled shapes and text."""
    sheet = Sheet((SIDE_PX, SIDE_PX), look, (16, 16))
    sun = np.array((11.8, 3.9))
    sheet.disc((11.8, 3.9), 1.5, look.ray)
    for angle in np.arange(0, 2 * math.pi, math.pi / 6):
        way = np.array([math.cos(angle), math.sin(angle)])
        sheet.line([sun + 1.9 * way, sun + 2.6 * way], look.ray, 0.16)
    sheet.fill(rectangle((2.2, 7.5), (6.0, 5.0)), look.fill)
    sheet.fill(rectangle((4.4, 9.4), (1.6, 3.1)), look.w)
    sheet.fill([(1.3, 7.7), (5.2, 3.6), (9.1, 7.7)], look.u)
    sheet.outline(circle((6.9, 9.9), 0.6), width=0.12)
    sheet.line([(0.8, 12.5), (15.2, 12.5)], width=0.16)
    across = np.linspace(0.8, 15.2, 60)
    sheet.line(np.stack([across, 14.6 + 0.45 * np.sin(1.7 * across)], axis=1), look.v, 0.16)
    for stroke in WORD:
        sheet.line(np.array(stroke) * (1.0, 1.7) + (8.7, 9.8), width=0.32)
    sheet.outline(circle((10.95, 10.65), (0.62, 0.85)), width=0.32)
    return sheet.figure()


@lru_cache(maxsize=2)
def bitmap(figure: Figure, size: Size) -> Bytes:
    """Return a figure's lines and shapes at (width, height) pixels, as displayed.

    The figure must have the same aspect ratio. Each pixel is the mean of SAMPLES x SAMPLES points.
    """
    scale = SAMPLES * size[0] / figure.size[0]
    picture = Image.new("RGB", (SAMPLES * size[0], SAMPLES * size[1]), ink(figure.ground or WHITE))
    draw = ImageDraw.Draw(picture)
    for part in figure.parts:
        if isinstance(part, Polygon):
            draw.polygon(_spots(part.points, scale), fill=ink(part.color))
        elif isinstance(part, Line):
            for piece in part.pieces:
                draw.line(_spots(piece, scale), ink(part.color), round(part.width * scale), "curve")
    return np.asarray(picture.resize(size, Image.Resampling.BOX), np.uint8).copy()


def _spots(points: NDArray[np.float64], scale: float) -> list[tuple[float, float]]:
    """Return points in Pillow's coordinates, which count from the middle of the first pixel."""
    return [(x, y) for x, y in (points * scale - 0.5).tolist()]


def ink(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(255 * min(max(value, 0.0), 1.0)) for value in color)
    return red, green, blue
