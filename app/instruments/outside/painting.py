"""Paint figures and texts with ImGui."""

from __future__ import annotations

import math

import numpy as np
from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui import ImVec2Like

from lucida.app.ui.theme import Fonts, framebuffer_scale
from lucida.app.ui.uploads import Uploads
from lucida.renderer.camera.checks import Floats

from .diagram import runs
from .figure import RIM, WHITE, Color, Figure, Label, Line, Picture, Polygon, dashes

Point = tuple[float, float]
Box = tuple[Point, Point]  # upper left and lower right corner
THINNEST_PX = 1.0  # the least width of a line on the screen


class Painter:
    """A painter of figures with ImGui. uploads: the textures of their pictures."""

    def __init__(self, draw: imgui.ImDrawList, fonts: Fonts, uploads: Uploads) -> None:
        self._draw, self._fonts, self._uploads = draw, fonts, uploads

    def paint(
        self, figure: Figure, origin: Point, scale: float, low: Point, high: Point, path: str = ""
    ) -> None:
        """Draw a figure between two corners of the screen.

        origin, scale: the page's point p is at origin + scale * p. path: a prefix that
        distinguishes the pictures of nested figures.
        """
        ground = packed(figure.ground or WHITE)
        self._draw.push_clip_rect(ImVec2(*low), ImVec2(*high), True)
        if figure.ground is not None:
            self._draw.add_rect_filled(ImVec2(*low), ImVec2(*high), ground)

        def on_screen(points: Floats) -> list[ImVec2Like]:
            return [ImVec2(x, y) for x, y in (points * scale + origin).tolist()]

        def place(point: Point) -> Point:
            return origin[0] + scale * point[0], origin[1] + scale * point[1]

        for number, part in enumerate(figure.parts):
            name = f"{path}/{number}"
            if isinstance(part, Label):
                self._label(part, place(part.center), scale, ground)
            elif isinstance(part, Polygon):
                color = packed(part.color, part.opacity)
                self._draw.add_convex_poly_filled(on_screen(part.points), color)
            elif isinstance(part, Line):
                color = packed(part.color, part.opacity)
                width = max(THINNEST_PX, part.width * scale)
                for piece in part.pieces:
                    for points in dashes(piece, figure.unit) if part.dashed else [piece]:
                        self._draw.add_polyline(on_screen(points), color, width, 0)
            else:
                box = place(part.low), place(part.high)
                seen = _within(box, (low, high))
                if isinstance(part, Picture):
                    self._picture(name, part, box, seen)
                else:
                    inner = scale * part.scale
                    x, y = (at - inner * one for at, one in zip(box[0], part.first, strict=True))
                    self.paint(part.figure, (x, y), inner, *seen, name)
        self._draw.pop_clip_rect()

    def _picture(self, name: str, part: Picture, box: Box, seen: Box) -> None:
        """Draw the visible part of a picture by screen pixels, because ImGui would smooth it.

        box: the whole picture's place on the screen. seen: its visible part.
        """
        px = framebuffer_scale()
        low, high = (np.round(np.array(corner) * px) / px for corner in seen)
        width, height = np.round((high - low) * px).astype(int).tolist()
        if min(width, height) < 1:
            return
        extent = np.subtract(box[1], box[0])
        corner, share = ((low - box[0]) / extent).tolist(), ((high - low) / extent).tolist()
        texture = self._uploads.magnified(
            name, part.pixels, (width, height), tuple(corner), tuple(share)
        )
        self._draw.add_image(imgui.ImTextureRef(texture.glo), ImVec2(*low), ImVec2(*high))

    def _label(self, part: Label, at: Point, scale: float, ground: int) -> None:
        # Use a whole size: ImGui scales other sizes from the next whole one.
        size = max(1, round(part.size * scale))
        pieces = measured(part.text, part.strong, size, self._fonts, part.mono)
        x, y = at[0] - part.align * sum(piece[2] for piece in pieces), at[1] - size / 2
        for font, text, wide in pieces:
            rim = RIM * size / 2 if part.rim else 0.0
            rimmed_text(self._draw, font, size, ImVec2(x, y), text, packed(part.color), ground, rim)
            x += wide


def _within(box: Box, other: Box) -> Box:
    """Return the intersection of two boxes."""
    (left, top), (right, bottom) = box
    (first, highest), (last, lowest) = other
    return (max(left, first), max(top, highest)), (min(right, last), min(bottom, lowest))


def measured(
    text: str, strong: bool, size: float, fonts: Fonts, mono: bool = False
) -> list[tuple[imgui.ImFont, str, float]]:
    """Return a label's pieces, each with its font and its width."""
    found = []
    for piece, is_bold in runs(text, strong):
        font = fonts.mono if mono else fonts.bold if is_bold else fonts.text
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
    for k in range(8 if width else 0):
        angle = k * math.pi / 4
        place = ImVec2(at.x + width * math.cos(angle), at.y + width * math.sin(angle))
        draw.add_text(font, size, place, rim, text)
    draw.add_text(font, size, at, color, text)


def packed(color: Color, opacity: float = 1.0) -> int:
    """Return a colour in ImGui's packed form."""
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red | green << 8 | blue << 16 | alpha << 24
