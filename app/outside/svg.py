"""Write a vector drawing as an SVG file: self-contained, one group for each kind, letters as text.

The live image is a PNG inside it. Pure except for write(). The same drawing makes the same bytes.
Source: SVG 1.1 (W3C, second edition); `data-name`, the name of a thing, is from SVG 2.
"""

from __future__ import annotations

import base64
import io
import math
import re
from itertools import groupby
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from app.outside.diagram import runs
from app.outside.image_bitmap import Standing
from app.outside.vector import DASHES, Arc, Color, Drawing, Letters, Part, is_closed
from renderer.atomic import atomic_write

ENDING = ".svg"
FONTS = "Roboto, Helvetica, Arial, sans-serif"
BASELINE = 0.35  # below a line's middle, in parts of the font's size
RIM = 0.18  # around letters, likewise
LINES = 'fill="none" stroke-linecap="round" stroke-linejoin="round"'
LETTERS = f'font-family="{FONTS}" text-anchor="middle" stroke-linejoin="round"'


def write(path: str | Path, drawing: Drawing, title: str = "") -> int:
    """Write an SVG file atomically. Return its size in bytes. Raises LucidaError for a bad path."""
    content = svg(drawing, title).encode()
    with atomic_write(path) as file:
        file.write(content)
    return len(content)


def svg(drawing: Drawing, title: str = "") -> str:
    """Return the file's text.

    The view box has the drawing's pixels. The groups that are not empty have the ids outlines,
    live-image, frustum, image-plane, rays, ...
    """
    width, height = drawing.size
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width}" height="{height}"'
        f' viewBox="0 0 {width} {height}">',
    ]
    if title:
        lines.append(f"<title>{_escaped(title)}</title>")
    lines.append(f"<desc>{_escaped(' '.join(drawing.notes))}</desc>")
    ground = _hex(drawing.background)
    lines.append(f'<rect id="background" width="{width}" height="{height}" fill="{ground}"/>')
    image = _live_image(drawing.standing) if drawing.standing is not None else []
    for group, parts in groupby(drawing.parts, key=lambda part: part.group):
        if group != "outlines":
            lines += image
            image = []
        common = LETTERS if group == "letters" else LINES
        lines.append(f'<g id="{group.replace(" ", "-")}" {common}>')
        lines += [_element(part, drawing) for part in parts if _is_finite(part)]
        lines.append("</g>")
    return "\n".join([*lines, *image, "</svg>", ""])


def _live_image(standing: Standing) -> list[str]:
    """Return the image once, and its cells as uses of it, clipped by paths.

    Its pixels stay squares: optimizeSpeed is SVG 1.1's word for that, pixelated is CSS's, which
    browsers follow.
    """
    height, width = standing.rgba.shape[:2]
    from PIL import Image  # here: the window opens without

    file = io.BytesIO()
    Image.fromarray(standing.rgba).save(file, "PNG")
    content = base64.b64encode(file.getvalue()).decode()
    image = (
        f'<image id="pixels" width="{width}" height="{height}" preserveAspectRatio="none"'
        ' image-rendering="optimizeSpeed" style="image-rendering:pixelated"'
        f' xlink:href="data:image/png;base64,{content}"/>'
    )
    cut, used = [], []
    for number, cell in enumerate(standing.cells):
        matrix = " ".join(f"{value:.9g}" for value in cell.matrix)
        use = f'<use xlink:href="#pixels" transform="matrix({matrix})"/>'
        path = f'<path d="M{_points(cell.corners)}Z"/>'
        cut.append(f'<clipPath id="cell-{number}">{path}</clipPath>')
        used.append(f'<g clip-path="url(#cell-{number})">{use}</g>')
    opacity = _number(standing.opacity)
    head = ["<defs>", image, *cut, "</defs>"]
    return [*head, f'<g id="live-image" opacity="{opacity}">', *used, "</g>"]


def _is_finite(part: Part) -> bool:
    form = part.form
    if isinstance(form, Arc):
        ellipse = form.ellipse
        values: ArrayLike = (*ellipse.center, *ellipse.radii, ellipse.tilt, form.start, form.end)
    else:
        values = (*form.center, form.size) if isinstance(form, Letters) else form
    return bool(np.isfinite(values).all())


def _element(part: Part, drawing: Drawing) -> str:
    form, kind = part.form, "stroke" if part.width else "fill"
    name, paint = f" data-name={_quoted(part.name)}", f' {kind}="{_hex(part.color)}"'
    if part.opacity < 1:
        paint += f' {kind}-opacity="{_number(part.opacity)}"'
    if isinstance(form, Letters):
        return _text(form, name, paint, _hex(drawing.background))
    if part.width:
        paint += f' stroke-width="{_number(part.width)}"'
    if part.dashed:
        lengths = " ".join(_number(dash * drawing.unit) for dash in DASHES)
        paint += f' stroke-dasharray="{lengths}" stroke-linecap="butt"'
    if isinstance(form, Arc):
        return _arc(form, name, paint)
    if not part.width:
        return f'<polygon{name} points="{_points(form)}"{paint}/>'
    closed = is_closed(form)
    points = _points(form[:-1] if closed else form)
    return f'<path{name} d="M{points}{"Z" if closed else ""}"{paint}/>'


def _arc(arc: Arc, name: str, paint: str) -> str:
    form = arc.ellipse
    x, y, rx, ry = map(_number, (*form.center, *form.radii))
    tilt = _number(math.degrees(form.tilt))
    if not arc.is_closed:
        start, end = (_points(form.at(np.array([angle]))) for angle in (arc.start, arc.end))
        large = int(arc.end - arc.start > math.pi)
        return f'<path{name} d="M{start}A{rx} {ry} {tilt} {large} 1 {end}"{paint}/>'
    if rx == ry:
        return f'<circle{name} cx="{x}" cy="{y}" r="{rx}"{paint}/>'
    turn = f' transform="rotate({tilt} {x} {y})"'
    return f'<ellipse{name} cx="{x}" cy="{y}" rx="{rx}" ry="{ry}"{turn}{paint}/>'


def _text(form: Letters, name: str, paint: str, ground: str) -> str:
    """Return the text over a rim of the ground's colour, which separates it from lines."""
    x, y = _number(form.center[0]), _number(form.center[1] + BASELINE * form.size)
    bold = ' font-weight="bold"' if form.strong else ""
    look = f'{name} x="{x}" y="{y}" font-size="{_number(form.size)}"{bold}'
    rim = f' fill="none" stroke="{ground}" stroke-width="{_number(RIM * form.size)}"'
    text = "".join(
        f'<tspan font-weight="bold">{_escaped(piece)}</tspan>'
        if is_bold and not form.strong
        else _escaped(piece)
        for piece, is_bold in runs(form.text, form.strong)
    )
    return f"<text{look}{rim}>{text}</text>\n<text{look}{paint}>{text}</text>"


def _hex(color: Color) -> str:
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in color)


def _points(points: np.ndarray) -> str:
    return " ".join(f"{_number(x)},{_number(y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    """Return a number with at most three decimals, no exponent and no minus zero."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _escaped(text: str) -> str:
    from xml.sax.saxutils import escape  # here: it imports Python's whole web client

    return escape(_legal(text))


def _quoted(text: str) -> str:
    from xml.sax.saxutils import quoteattr

    return quoteattr(_legal(text))


def _legal(text: str) -> str:
    """Return a text without the characters that no XML file may hold."""
    return re.sub(r"[^\t\n -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "", text)
