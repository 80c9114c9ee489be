"""Paint figures and texts with ImGui."""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui import ImVec2Like

from app.outside.diagram import runs
from app.outside.figure import RIM, WHITE, Color, Figure, Floats, Label, Line, Polygon, dashes
from app.widgets import theme
from app.widgets.theme import Fonts

THINNEST_PX = 1.0  # of lines on the screen


@dataclass(frozen=True)
class Magnified:
    """A part of the page on the screen: page point p is at origin + scale * p."""

    origin: tuple[float, float]
    scale: float

    def all(self, points: Floats) -> list[ImVec2Like]:
        return [ImVec2(x, y) for x, y in (points * self.scale + self.origin).tolist()]


def paint(
    draw: imgui.ImDrawList, figure: Figure, view: Magnified, low: ImVec2, high: ImVec2, fonts: Fonts
) -> None:
    """Draw the lines, polygons and labels of a figure between two corners of the screen."""
    ground = packed(figure.ground or WHITE)
    draw.push_clip_rect(low, high, True)
    draw.add_rect_filled(low, high, ground)
    for part in figure.parts:
        if isinstance(part, Label):
            _label(draw, part, view, ground, fonts)
        elif isinstance(part, Polygon):
            draw.add_convex_poly_filled(view.all(part.points), packed(part.color, part.opacity))
        else:
            _line(draw, part, view, figure.unit)
    draw.pop_clip_rect()


def _line(draw: imgui.ImDrawList, part: Line, view: Magnified, unit: float) -> None:
    color, width = packed(part.color, part.opacity), max(THINNEST_PX, part.width * view.scale)
    for piece in part.pieces:
        for points in dashes(piece, unit) if part.dashed else [piece]:
            draw.add_polyline(view.all(points), color, width, 0)


def _label(draw: imgui.ImDrawList, part: Label, view: Magnified, ground: int, fonts: Fonts) -> None:
    # A whole size: ImGui scales others from the next whole one. Never smaller than other text.
    size = round(max(theme.type_px(), part.size * view.scale))
    pieces = measured(part.text, part.strong, size, fonts)
    x, y = (at + view.scale * c for at, c in zip(view.origin, part.center, strict=True))
    at = ImVec2(x - sum(piece[2] for piece in pieces) / 2, y - size / 2)
    for font, text, wide in pieces:
        rimmed_text(draw, font, size, at, text, packed(part.color), ground, RIM * size / 2)
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
