"""A vector drawing painted by ImGui's draw list, anew for each magnification, so it stays sharp."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui import ImVec2Like
from numpy.typing import NDArray

from app.outside.diagram import runs
from app.outside.svg import RIM
from app.outside.vector import TURN, Arc, Color, Drawing, Letters, Part, dashes, is_closed
from app.widgets import theme
from app.widgets.theme import Fonts

Floats = NDArray[np.float64]
THINNEST_PX = 1.0  # a screen's lines are not thinner; in files, thinner lines are paler


@dataclass(frozen=True, eq=False)
class Mark:
    """A part as it is painted. lines: a line, or its dashes. low, high: the corners of its box."""

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
        form, lines = part.form, tuple[Floats, ...]()
        if isinstance(form, Letters):
            around, margin = np.array([form.center]), form.size * max(1, len(form.text))
        elif isinstance(form, Arc):
            around = form.ellipse.at(np.linspace(form.start, form.end, 90))
            margin = part.width + max(form.ellipse.radii) * 0.003
        else:
            lines = tuple(dashes(form, drawing.unit)) if part.dashed else (form,)
            around, margin = form, part.width or 1.0
        low, high = around.min(axis=0) - margin, around.max(axis=0) + margin
        marks.append(Mark(part, packed(part.color, part.opacity), lines, low, high))
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
        if not ((mark.high < first).any() or (mark.low > last).any()):
            _paint(draw, mark, view, ground, fonts)
    draw.pop_clip_rect()


def _paint(draw: imgui.ImDrawList, mark: Mark, view: Magnified, ground: int, fonts: Fonts) -> None:
    part, form = mark.part, mark.part.form
    width = max(THINNEST_PX, part.width * view.scale)
    closing = int(imgui.ImDrawFlags_.closed)
    if isinstance(form, Letters):
        _letters(draw, form, mark.color, view, ground, fonts)
    elif isinstance(form, Arc):
        center, radii = view.at(*form.ellipse.center), np.multiply(form.ellipse.radii, view.scale)
        if not part.width:
            draw.add_circle_filled(center, float(radii[0]), mark.color)
            return
        # As many corners as a circle of that size has: a quarter of a pixel off at most.
        turn = TURN / math.acos(1 - min(0.25 / max(float(radii[0]), 1.0), 1.0))
        count = max(8, math.ceil(turn * (form.end - form.start) / TURN))
        end = form.end - (TURN / (count + 1) if form.is_closed else 0.0)  # it is closed below
        draw.path_clear()
        draw.path_elliptical_arc_to(
            center, ImVec2(*radii.tolist()), form.ellipse.tilt, form.start, end, count
        )
        draw.path_stroke(mark.color, width, closing if form.is_closed else 0)
    elif not part.width:
        draw.add_convex_poly_filled(view.all(form), mark.color)
    else:
        for line in mark.lines:
            closed = is_closed(line)
            points = view.all(line[:-1] if closed else line)
            draw.add_polyline(points, mark.color, width, closing if closed else 0)


def _letters(
    draw: imgui.ImDrawList, form: Letters, color: int, view: Magnified, ground: int, fonts: Fonts
) -> None:
    # Whole: others are made of the next whole one. Never smaller than other text.
    size = round(max(theme.type_px(), form.size * view.scale))
    pieces, at = measured(form.text, form.strong, size, fonts), view.at(*form.center)
    at = ImVec2(at.x - sum(piece[2] for piece in pieces) / 2, at.y - size / 2)
    for font, text, wide in pieces:
        rimmed_text(draw, font, size, at, text, color, ground, RIM * size / 2)
        at.x += wide


def measured(
    text: str, strong: bool, size: float, fonts: Fonts
) -> list[tuple[imgui.ImFont, str, float]]:
    """Return a label's pieces, each with its font and its width."""
    found = []
    for piece, is_bold in runs(text, strong):
        font = fonts.bold if is_bold else fonts.text
        assert font is not None
        imgui.push_font(font, 0.0)
        found.append((font, piece, imgui.calc_text_size(piece).x * size / imgui.get_font_size()))
        imgui.pop_font()
    return found


def rimmed_text(
    draw: imgui.ImDrawList,
    font: imgui.ImFont,
    size: float,
    at: ImVec2,
    text: str,
    color: int,
    rim: int,
    width: float,
) -> None:
    """Draw a text over copies of it in the rim's colour, which separate it from lines."""
    for k in range(8):
        angle = k * math.pi / 4
        place = ImVec2(at.x + width * math.cos(angle), at.y + width * math.sin(angle))
        draw.add_text(font, size, place, rim, text)
    draw.add_text(font, size, at, color, text)


def packed(color: Color, opacity: float = 1.0) -> int:
    """Return a colour as ImGui packs it."""
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red | green << 8 | blue << 16 | alpha << 24
