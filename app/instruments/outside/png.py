"""Paint a figure into pixels: the same parts as in its SVG file, with smooth edges."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from pathlib import Path

import imgui_bundle
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from lucida.renderer.camera.checks import Floats
from lucida.renderer.images.display import Bytes

from .diagram import runs
from .figure import (
    RIM,
    WHITE,
    Color,
    Figure,
    Label,
    Line,
    Picture,
    Polygon,
    dashes,
)
from .svg import BASELINE, casing_of

FINE = 3  # samples a side of a pixel, for smooth edges
FONTS = Path(imgui_bundle.__file__).parent / "assets" / "fonts" / "Roboto"
Places = Callable[[Floats], list[tuple[float, float]]]
Paint = Callable[[ImageDraw.ImageDraw, Places], object]


def painted(figure: Figure) -> Bytes:
    """Return a figure's page, (height, width, 4), sRGB and opacity. Insets are not painted."""
    ground = figure.ground or WHITE
    page = Image.new("RGBA", figure.size, (*_bytes(ground), 255 if figure.ground else 0))
    if figure.image is not None:
        scene = Image.fromarray(figure.image)
        page.alpha_composite(scene.resize(figure.size, Image.Resampling.BOX))
    for part in figure.parts:
        if isinstance(part, Label):
            _label(page, part, ground)
        elif isinstance(part, Polygon):
            paint = partial(_polygon, part.points)
            _lay(page, part.points, 1.0, part.color, part.opacity, paint)
        elif isinstance(part, Picture):
            low, high = (np.round(corner).astype(int).tolist() for corner in (part.low, part.high))
            pixels = Image.fromarray(part.pixels).convert("RGBA")
            size = high[0] - low[0], high[1] - low[1]
            size = max(1, size[0]), max(1, size[1])
            way = Image.Resampling.BOX if part.is_fine else Image.Resampling.NEAREST
            page.alpha_composite(pixels.resize(size, way), tuple(low))
        elif isinstance(part, Line):
            _line(page, part, figure)
    return np.asarray(page)


def _polygon(points: Floats, draw: ImageDraw.ImageDraw, at: Places) -> None:
    draw.polygon(at(points), 255)


def _line(page: Image.Image, part: Line, figure: Figure) -> None:
    pieces = list(part.pieces)
    if part.dashed:
        pieces = [dash for piece in pieces for dash in dashes(piece, figure.unit)]

    def paint(width: float, draw: ImageDraw.ImageDraw, at: Places) -> None:
        reach = FINE * width / 2
        for piece in pieces:
            draw.line(at(piece), 255, max(1, round(2 * reach)), joint="curve")
            for x, y in () if part.dashed else at(piece[[0, -1]]):
                draw.ellipse((x - reach, y - reach, x + reach, y + reach), 255)

    casing = casing_of(part, figure)
    look = part.color, part.opacity, part.width
    for color, opacity, width in (look,) if casing is None else (casing, look):
        _lay(page, np.concatenate(pieces), width, color, opacity, partial(paint, width))


def _label(page: Image.Image, part: Label, rim: Color) -> None:
    texts = runs(part.text, part.strong)
    pieces = [(text, _font(is_bold, FINE * part.size)) for text, is_bold in texts]
    widths = [font.getlength(text) / FINE for text, font in pieces]
    x, y = part.center[0] - part.align * sum(widths), part.center[1] + BASELINE * part.size
    places = np.array([(x + sum(widths[:k]), y) for k in range(len(pieces))])

    def paint(wide: int, draw: ImageDraw.ImageDraw, at: Places) -> None:
        for spot, (text, font) in zip(at(places), pieces, strict=True):
            draw.text(spot, text, 255, font, anchor="ls", stroke_width=wide)

    margin = sum(widths) + 2 * part.size
    if part.rim:
        stroke = round(FINE * RIM * part.size / 2)
        _lay(page, places, margin, rim, 1.0, partial(paint, stroke))
    _lay(page, places, margin, part.color, 1.0, partial(paint, 0))


def _lay(
    page: Image.Image, points: Floats, margin: float, color: Color, opacity: float, paint: Paint
) -> None:
    """Lay a colour over the page where `paint` paints: into FINE times as many pixels, at places
    that its second argument returns.

    points (n, 2), margin: what is painted is nowhere farther from them.
    """
    low = np.floor(np.clip(points.min(axis=0) - margin, 0, page.size)).astype(int)
    high = np.ceil(np.clip(points.max(axis=0) + margin, 0, page.size)).astype(int)
    width, height = (high - low).tolist()
    if min(width, height) < 1 or opacity <= 0:
        return
    mask = Image.new("L", (FINE * width, FINE * height))
    paint(ImageDraw.Draw(mask), lambda spots: [(x, y) for x, y in (FINE * (spots - low)).tolist()])
    mask = mask.resize((width, height), Image.Resampling.BOX)
    layer = Image.new("RGBA", (width, height), _bytes(color))
    layer.putalpha(mask.point(lambda covered: round(opacity * covered)))
    page.alpha_composite(layer, tuple(low.tolist()))


@cache
def _font(is_bold: bool, size: float) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(FONTS / f"Roboto-{'Bold' if is_bold else 'Regular'}.ttf", size)


def _bytes(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(255 * min(max(one, 0.0), 1.0)) for one in color)
    return red, green, blue
