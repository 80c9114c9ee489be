"""Write a figure as a self-contained SVG file, with the scene as a PNG and letters as text.

The same figure always yields the same bytes. Source: SVG 1.1 (W3C, second edition); `data-name` is
from SVG 2.
"""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from html import escape

import numpy as np
from PIL import Image

from lucida.renderer.images.display import Bytes

from .diagram import runs
from .figure import DASHES, RIM, WHITE, Color, Figure, Inset, Label, Line, Part, Picture, Polygon

FONTS = "Roboto, Helvetica, Arial, narrowed, sans-serif"  # narrowed: in lecture.css
MONO = "Roboto Mono, Consolas, Menlo, monospace"
MONO_WIDTH = 0.5  # a letter's width, relative to its size
ANCHORS = {0.0: "start", 0.5: "middle", 1.0: "end"}
BLACK = (0.0, 0.0, 0.0)
CASING, PALEST = 2.0, 0.45  # a casing's extra width, in units; paler lines have none
BASELINE = 0.35  # below a line's middle, relative to the font's size


def png_address(pixels: Bytes) -> str:
    """Return the data URL of a PNG with these pixels."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"


def svg(figure: Figure, title: str = "") -> str:
    """Return the file's text. The view box has the page's pixels."""
    width, height = figure.size
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        f"<title>{escape(_legal(title))}</title>",
    ]
    return "\n".join([*lines, *content(figure), "</svg>", ""])


def content(figure: Figure, address: Callable[[Bytes], str] = png_address) -> list[str]:
    """Return the elements of a figure: its ground, its image, its lines, its labels.

    address: returns the address of a picture's pixels.
    """
    box, lines = f'width="{figure.size[0]}" height="{figure.size[1]}"', []
    if figure.ground is not None:
        lines.append(f'<rect class="ground" {box} fill="{_hex(figure.ground)}"/>')
    if figure.image is not None:
        lines.append(f'<image class="scene" {box} xlink:href="{address(figure.image)}"/>')
    lines.append('<g class="lines" fill="none" stroke-linecap="round" stroke-linejoin="round">')
    lines += [
        _element(part, figure, address) for part in figure.parts if not isinstance(part, Label)
    ]
    lines.append(
        f'</g>\n<g class="labels" font-family="{FONTS}" text-anchor="middle"'
        ' stroke-linejoin="round">'
    )
    rim = _hex(figure.ground or WHITE)
    lines += [_text(part, rim) for part in figure.parts if isinstance(part, Label)]
    return [*lines, "</g>"]


def _element(
    part: Line | Polygon | Picture | Inset, figure: Figure, address: Callable[[Bytes], str]
) -> str:
    if isinstance(part, Picture | Inset):
        x, y, width, height = map(_number, (*part.low, *np.subtract(part.high, part.low)))
        box = f'{_name(part)} x="{x}" y="{y}" width="{width}" height="{height}"'
    if isinstance(part, Picture):
        look = 'preserveAspectRatio="none"'
        if not part.is_fine:
            look += ' image-rendering="pixelated"'
        return f'<image{box} {look} xlink:href="{address(part.pixels)}"/>'
    if isinstance(part, Inset):
        seen = np.subtract(part.high, part.low) / part.scale
        view = " ".join(map(_number, (*part.first, *seen)))
        return "\n".join([f'<svg{box} viewBox="{view}">', *content(part.figure, address), "</svg>"])
    kind = "stroke" if isinstance(part, Line) else "fill"
    look = f'{_name(part)} {kind}="{_hex(part.color)}"'
    if part.opacity < 1:
        look += f' {kind}-opacity="{_number(part.opacity)}"'
    if isinstance(part, Polygon):
        return f'<polygon points="{_points(part.points)}"{look}/>'
    look += f' stroke-width="{_number(part.width)}"'
    if part.dashed:
        lengths = " ".join(_number(dash * figure.unit) for dash in DASHES)
        look += f' stroke-dasharray="{lengths}" stroke-linecap="butt"'
    path = "".join(f"M{_points(piece)}" for piece in part.pieces)
    line = f'<path d="{path}"{look}/>'
    if (casing := casing_of(part, figure)) is None:
        return line
    color, opacity, wide = casing
    look = f' stroke="{_hex(color)}" stroke-opacity="{opacity}" stroke-width="{_number(wide)}"'
    return f'<path d="{path}"{look}/>\n{line}'


def casing_of(part: Line, figure: Figure) -> tuple[Color, float, float] | None:
    """Return the colour, the opacity and the width of a line's casing, which separates it from the
    scene and from other lines; None if it has none.
    """
    is_pale = part.dashed or part.opacity < PALEST or part.width <= figure.unit
    if is_pale or figure.image is None:
        return None
    is_light = min(figure.ground or WHITE) > 0.5
    return WHITE if is_light else BLACK, 0.6, part.width + CASING * figure.unit


def _text(part: Label, ground: str) -> str:
    """Return the text over a rim of the ground's colour, which separates it from lines."""
    x, y = _number(part.center[0]), _number(part.center[1] + BASELINE * part.size)
    look = f'{_name(part)} x="{x}" y="{y}" font-size="{_number(part.size)}"'
    if part.mono:  # as wide as in the window
        wide = _number(MONO_WIDTH * part.size * len(part.text))
        look += f' font-family="{MONO}" textLength="{wide}" lengthAdjust="spacingAndGlyphs"'
    look += f' text-anchor="{ANCHORS[part.align]}"' if part.align != 0.5 else ""
    rim = f' fill="none" stroke="{ground}" stroke-width="{_number(RIM * part.size)}"'
    text = "".join(
        f'<tspan font-weight="bold">{escape(_legal(piece))}</tspan>'
        if is_bold
        else escape(_legal(piece))
        for piece, is_bold in runs(part.text, part.strong)
    )
    letters = f'<text{look} fill="{_hex(part.color)}">{text}</text>'
    return f"<text{look}{rim}>{text}</text>\n{letters}" if part.rim else letters


def _name(part: Part) -> str:
    return f' data-name="{escape(_legal(part.name))}"'


def _hex(color: Color) -> str:
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in color)


def _points(points: np.ndarray) -> str:
    return " ".join(f"{_number(x)},{_number(y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    """Return a number with at most three decimals, no exponent and no minus zero."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _legal(text: str) -> str:
    """Return a text without the characters that no XML file may hold."""
    return re.sub(r"[^\t\n -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "", text)
