"""Write a vector drawing as an SVG file: self-contained, one group for each kind, letters as text.

The live image is a PNG inside it. Pure except for write(). The same drawing makes the same bytes.
Source: SVG 1.1 (W3C, second edition); `data-name`, the name of a thing, is from SVG 2.
"""

from __future__ import annotations

import base64
import io
import math
from itertools import groupby
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.outside.image_bitmap import Standing
from app.outside.vector import Arc, Area, Color, Drawing, Letters, Part, Spot, VectorLine
from renderer.atomic import atomic_write

ENDING = ".svg"
DASHES = (5.0, 4.0)  # in units of a line
FONTS = "Roboto, Helvetica, Arial, sans-serif"
BASELINE = 0.35  # below a line's middle, in parts of the font's size
RIM = 0.18  # around letters, likewise


def write(path: str | Path, drawing: Drawing, title: str = "") -> int:
    """Write an SVG file atomically. Return its size in bytes. Raises LucidaError for a bad path."""
    content = svg(drawing, title).encode()
    with atomic_write(path) as file:
        file.write(content)
    return len(content)


def svg(drawing: Drawing, title: str = "") -> str:
    """The file's text. A view box of the drawing's own pixels; groups have the ids outlines,
    live-image, frustum, image-plane, rays, ... as far as there is something in them."""
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
        name = group.replace(" ", "-")
        common = ' fill="none" stroke-linecap="round" stroke-linejoin="round"'
        if group == "letters":
            common = f' font-family="{FONTS}" text-anchor="middle" stroke-linejoin="round"'
        lines.append(f'<g id="{name}"{common}>')
        lines += [text for part in parts if (text := _element(part, drawing))]
        lines.append("</g>")
    return "\n".join([*lines, *image, "</svg>", ""])


def _live_image(standing: Standing) -> list[str]:
    """The image once, and its cells as uses of it, cut out by paths. Its pixels stay squares:
    optimizeSpeed is SVG 1.1's word for that, pixelated is CSS's, which browsers go by."""
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


def _element(part: Part, drawing: Drawing) -> str:
    """One element; "" for what has no finite place."""
    name = f" data-name={_quoted(part.name)}"
    if isinstance(part, VectorLine):
        return _line(part, name, drawing.unit)
    if isinstance(part, Area):
        if not np.isfinite(part.points).all():
            return ""
        fill = _paint("fill", part.color, part.opacity)
        return f'<polygon{name} points="{_points(part.points)}"{fill}/>'
    if isinstance(part, Spot):
        if not _finite(*part.center, part.radius):
            return ""
        x, y, r = map(_number, (*part.center, part.radius))
        fill = _paint("fill", part.color, part.opacity)
        return f'<circle{name} cx="{x}" cy="{y}" r="{r}"{fill}/>'
    if isinstance(part, Arc):
        return _arc(part, name)
    return _text(part, name, drawing.background)


def _line(part: VectorLine, name: str, unit: float) -> str:
    if not np.isfinite(part.points).all():
        return ""
    points = part.points
    closed = len(points) > 2 and bool(np.allclose(points[0], points[-1], atol=1e-3))
    if closed:
        points = points[:-1]
    stroke = _paint("stroke", part.color, part.opacity)
    stroke += f' stroke-width="{_number(part.width)}"'
    if part.dashed:
        dashes = " ".join(_number(dash * unit) for dash in DASHES)
        stroke += f' stroke-dasharray="{dashes}" stroke-linecap="butt"'
    return f'<path{name} d="M{_points(points)}{"Z" if closed else ""}"{stroke}/>'


def _arc(part: Arc, name: str) -> str:
    form = part.ellipse
    if not _finite(*form.center, *form.radii, form.tilt, part.start, part.end):
        return ""
    stroke = f'{_paint("stroke", part.color, 1.0)} stroke-width="{_number(part.width)}"'
    rx, ry = map(_number, form.radii)
    tilt = _number(math.degrees(form.tilt))
    if part.end - part.start >= 2 * math.pi - 1e-9:
        x, y = map(_number, form.center)
        turn = f' transform="rotate({tilt} {x} {y})"' if rx != ry else ""
        return f'<ellipse{name} cx="{x}" cy="{y}" rx="{rx}" ry="{ry}"{turn}{stroke}/>'
    ends = form.at(np.array([part.start, part.end]))
    large = int(part.end - part.start > math.pi)
    start, end = _points(ends[:1]), _points(ends[1:])
    return f'<path{name} d="M{start}A{rx} {ry} {tilt} {large} 1 {end}"{stroke}/>'


def _text(part: Letters, name: str, ground: Color) -> str:
    """The text over a rim of the ground's colour, which sets it off from lines."""
    if not _finite(*part.center, part.size):
        return ""
    x, y = _number(part.center[0]), _number(part.center[1] + BASELINE * part.size)
    bold = ' font-weight="bold"' if part.strong else ""
    look = f'{name} x="{x}" y="{y}" font-size="{_number(part.size)}"{bold}'
    rim = f' fill="none" stroke="{_hex(ground)}" stroke-width="{_number(RIM * part.size)}"'
    text = _escaped(part.text)
    fill = _paint("fill", part.color, 1.0)
    return f"<text{look}{rim}>{text}</text>\n<text{look}{fill}>{text}</text>"


def _paint(kind: str, color: Color, opacity: float) -> str:
    pale = f' {kind}-opacity="{_number(opacity)}"' if opacity < 1 else ""
    return f' {kind}="{_hex(color)}"{pale}'


def _hex(color: Color) -> str:
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in color)


def _points(points: NDArray[np.float64]) -> str:
    return " ".join(f"{_number(x)},{_number(y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    """Three decimals at most; no exponent, no minus zero."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _finite(*values: float) -> bool:
    return all(map(math.isfinite, values))


def _escaped(text: str) -> str:
    from xml.sax.saxutils import escape  # here: it brings Python's whole web client

    return escape(_legal(text))


def _quoted(text: str) -> str:
    from xml.sax.saxutils import quoteattr

    return quoteattr(_legal(text))


def _legal(text: str) -> str:
    """Without the characters that no XML file may hold."""
    return "".join(
        c
        for c in text
        if c in "\t\n" or (c >= " " and c not in "\ufffe\uffff" and not 0xD800 <= ord(c) < 0xE000)
    )
