"""A vector drawing by ImGui's draw list, at any magnification: drawn anew for each, so it is sharp.

Owns the way from a drawing's parts to ImGui's calls. Knows nothing of what is drawn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui import ImVec2Like
from numpy.typing import NDArray

from app.outside.bitmap import dashes
from app.outside.svg import DASHES, RIM
from app.outside.vector import Arc, Area, Color, Drawing, Letters, Part, Spot, VectorLine
from app.widgets.theme import Fonts

Floats = NDArray[np.float64]
THINNEST_PX = 1.0  # thinner lines are paler in files; here they stay


@dataclass(frozen=True, eq=False)
class Mark:
    """A part as it is painted. lines: of a line, its dashes if it has some. low, high: around."""

    part: Part
    color: int
    lines: tuple[Floats, ...]
    low: Floats
    high: Floats


@dataclass(frozen=True)
class Magnified:
    """A part of the page on the screen: page point p is at origin + scale * p."""

    origin: tuple[float, float]
    scale: float

    def at(self, x: float, y: float) -> ImVec2:
        return ImVec2(self.origin[0] + self.scale * x, self.origin[1] + self.scale * y)

    def all(self, points: Floats) -> list[ImVec2Like]:
        return [ImVec2(x, y) for x, y in (points * self.scale + self.origin).tolist()]


def prepared(drawing: Drawing) -> tuple[Mark, ...]:
    """Return the marks that do not change with the magnification. Runs on a thread."""
    marks = []
    for part in drawing.parts:
        lines: tuple[Floats, ...] = ()
        color = packed(part.color, getattr(part, "opacity", 1.0))
        if isinstance(part, VectorLine):
            lines = (part.points,)
            if part.dashed:
                lines = tuple(dashes(part.points, [dash * drawing.unit for dash in DASHES]))
            around, margin = part.points, part.width
        elif isinstance(part, Area):
            around, margin = part.points, 1.0
        elif isinstance(part, Spot):
            around, margin = np.array([part.center]), part.radius
        elif isinstance(part, Arc):
            around = part.ellipse.at(np.linspace(part.start, part.end, 90))
            margin = part.width + max(part.ellipse.radii) * 0.003
        else:
            around, margin = np.array([part.center]), part.size * max(1, len(part.text))
        low, high = around.min(axis=0) - margin, around.max(axis=0) + margin
        marks.append(Mark(part, color, lines, low, high))
    return tuple(marks)


def paint(
    draw: imgui.ImDrawList,
    drawing: Drawing,
    marks: tuple[Mark, ...],
    view: Magnified,
    low: ImVec2,
    high: ImVec2,
    fonts: Fonts,
) -> None:
    """Draw the part of a drawing that is visible between two corners of the screen."""
    ground = packed(drawing.background)
    draw.push_clip_rect(low, high, True)
    draw.add_rect_filled(low, high, ground)
    first = (np.array([low.x, low.y]) - view.origin) / view.scale
    last = (np.array([high.x, high.y]) - view.origin) / view.scale
    for mark in marks:
        if (mark.high < first).any() or (mark.low > last).any():
            continue
        _paint(draw, mark, view, ground, fonts)
    draw.pop_clip_rect()


def _paint(draw: imgui.ImDrawList, mark: Mark, view: Magnified, ground: int, fonts: Fonts) -> None:
    part = mark.part
    if isinstance(part, VectorLine):
        width = max(THINNEST_PX, part.width * view.scale)
        for line in mark.lines:
            closed = len(line) > 2 and bool(np.allclose(line[0], line[-1], atol=1e-3))
            points = view.all(line[:-1] if closed else line)
            draw.add_polyline(
                points, mark.color, width, int(imgui.ImDrawFlags_.closed) if closed else 0
            )
    elif isinstance(part, Area):
        draw.add_convex_poly_filled(view.all(part.points), mark.color)
    elif isinstance(part, Spot):
        draw.add_circle_filled(view.at(*part.center), part.radius * view.scale, mark.color)
    elif isinstance(part, Arc):
        form = part.ellipse
        radii = ImVec2(form.radii[0] * view.scale, form.radii[1] * view.scale)
        # As many corners as a circle of that size has: a quarter of a pixel off at most.
        turn = 2 * math.pi / math.acos(1 - min(0.25 / max(radii.x, 1.0), 1.0))
        count = max(8, math.ceil(turn * (part.end - part.start) / (2 * math.pi)))
        width = max(THINNEST_PX, part.width * view.scale)
        whole = part.end - part.start >= 2 * math.pi - 1e-9
        end = part.end - (2 * math.pi / (count + 1) if whole else 0.0)  # it is closed below
        draw.path_clear()
        draw.path_elliptical_arc_to(view.at(*form.center), radii, form.tilt, part.start, end, count)
        draw.path_stroke(mark.color, width, int(imgui.ImDrawFlags_.closed) if whole else 0)
    else:
        _letters(draw, part, mark.color, view, ground, fonts)


def _letters(
    draw: imgui.ImDrawList, part: Letters, color: int, view: Magnified, ground: int, fonts: Fonts
) -> None:
    font = fonts.bold if part.strong else fonts.text
    assert font is not None
    size = max(
        1, round(part.size * view.scale)
    )  # whole: other sizes are made of the next whole one
    imgui.push_font(font, 0.0)
    box, ratio = imgui.calc_text_size(part.text), size / imgui.get_font_size()
    imgui.pop_font()
    middle = view.at(*part.center)
    x, y = middle.x - ratio * box.x / 2, middle.y - ratio * box.y / 2
    for k in range(8):
        angle = k * math.pi / 4
        rim = RIM * size / 2
        at = ImVec2(x + rim * math.cos(angle), y + rim * math.sin(angle))
        draw.add_text(font, size, at, ground, part.text)
    draw.add_text(font, size, ImVec2(x, y), color, part.text)


def packed(color: Color, opacity: float = 1.0) -> int:
    """A colour as ImGui takes it."""
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red | green << 8 | blue << 16 | alpha << 24
