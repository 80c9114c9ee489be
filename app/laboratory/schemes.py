"""Small drawings that show how a display makes its light.

The tube from the side, with its three beams, the mask's hole and the dots behind; the colour wheel
and a mirror of a DLP display; three projectors and their beams.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from imgui_bundle import ImVec2, ImVec4, imgui

from app.laboratory import light
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import PagePlan
from app.widgets import theme
from app.widgets.theme import framebuffer_scale

COLORS = ("#ff4d4d", "#33cc66", "#5f9bff")  # red, green and blue light, in both themes to be seen
NAMES = ("tube", "dlp")


class Scheme:
    """Draws in a rectangle; places are in parts of it."""

    def __init__(self, low: ImVec2, extent: ImVec2) -> None:
        self._low, self._extent = low, extent
        self._draw = imgui.get_window_draw_list()
        self._unit = min(extent.x, 2 * extent.y) / 16

    def _at(self, x: float, y: float) -> ImVec2:
        return ImVec2(self._low.x + x * self._extent.x, self._low.y + y * self._extent.y)

    def _line(
        self, start: tuple[float, float], end: tuple[float, float], color: ImVec4, width: float
    ) -> None:
        self._draw.add_line(self._at(*start), self._at(*end), theme.u32(color), width)

    def _word(self, text: str, x: float, y: float) -> None:
        at, size = self._at(x, y), imgui.calc_text_size(text)
        left = min(max(at.x - size.x / 2, self._low.x), self._low.x + self._extent.x - size.x)
        self._draw.add_text(ImVec2(left, at.y - size.y / 2), theme.u32(theme.DIM), text)

    def tube(self, strengths: Sequence[float]) -> None:
        """Three guns, whose beams cross in a hole of the mask. strengths: of the beams, 0 to 1."""
        mask, screen, gun = 0.66, 0.93, 0.06
        grow = (screen - mask) / (mask - gun)
        for channel, strength in enumerate(strengths):
            y = (0.22, 0.55, 0.88)[channel]
            meets = 0.55 + (0.55 - y) * grow
            color = theme.rgb(COLORS[channel])
            beam = theme.rgb(COLORS[channel], 0.12 + 0.88 * min(max(float(strength), 0.0), 1.0))
            self._line((gun, y), (screen, meets), beam, theme.line_px(2.0))
            self._draw.add_circle_filled(self._at(gun, y), 0.5 * self._unit, theme.u32(color))
            self._draw.add_circle_filled(
                self._at(screen, meets), 0.4 * self._unit, theme.u32(color)
            )
        for top, bottom in ((0.16, 0.46), (0.64, 0.96)):
            self._line((mask, top), (mask, bottom), theme.PLAIN, theme.line_px(3.0))
        for name, x in (("beams", gun), ("mask", mask), ("dots", screen)):
            self._word(name, x, 0.04)

    def dlp(self, phase: float, is_on: bool) -> None:
        """Draw the wheel, through which white light takes one colour after another, and a mirror
        that sends it onto the wall or away from it.
        """
        middle, radius = self._at(0.2, 0.55), 0.36 * self._extent.y
        for channel in range(3):
            begin = 2 * math.pi * (channel / 3 - phase)
            self._draw.path_line_to(middle)
            self._draw.path_arc_to(middle, radius, begin, begin + 2 * math.pi / 3)
            self._draw.path_fill_convex(theme.u32(theme.rgb(COLORS[channel])))
        light = theme.rgb(COLORS[min(int(3 * phase), 2)])
        rim = (middle.x + radius - self._low.x) / self._extent.x
        mirror, width = (0.66, 0.55), theme.line_px(2.5)
        self._line((rim, 0.55), mirror, light, width)
        self._line(mirror, (0.92, 0.2 if is_on else 0.92), light, width)
        tilt = 0.12 if is_on else -0.12
        self._line((0.66 - tilt / 4, 0.43), (0.66 + tilt / 4, 0.67), theme.TEXT, theme.line_px(3.5))
        for name, x, y in (("wheel", 0.2, 0.04), ("mirror", 0.62, 0.3), ("wall", 0.92, 0.08)):
            self._word(name, x, y)


def projectors(
    lenses: Sequence[ImVec2], pictures: Sequence[tuple[ImVec2, ImVec2]], wall: float
) -> None:
    """Draw projectors and their beams.

    lenses: the position of each lens. pictures: the left and the right end of what each throws.
    wall: its lower edge; the beams fill what is below it, so that the pictures keep their colours.
    """
    draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
    for lens, (left, right), color in zip(lenses, pictures, COLORS, strict=True):
        light = theme.rgb(color)
        part = (lens.y - wall) / (lens.y - left.y)
        first, last = (ImVec2(lens.x + part * (end.x - lens.x), wall) for end in (left, right))
        draw.add_triangle_filled(lens, first, last, theme.u32(light, 0.25))
        for end in (left, right):
            draw.add_line(lens, end, theme.u32(light, 0.9), theme.line_px(1.5))
        low, far = ImVec2(lens.x - em, lens.y + 0.3 * em), ImVec2(lens.x + em, lens.y + 1.5 * em)
        draw.add_rect_filled(low, far, theme.u32(theme.FRAME_ACTIVE), 0.2 * em)
        draw.add_rect_filled(
            ImVec2(lens.x - 0.35 * em, lens.y), ImVec2(lens.x + 0.35 * em, low.y), theme.u32(light)
        )


def below_wall(at: ImVec2, bottom: float, options: LaboratoryOptions, made: PagePlan) -> None:
    """Draw three projectors below the wall that they throw their pictures on.

    at: the wall's corner. bottom: of the page.
    """
    em, part = imgui.get_font_size(), made.magnification / framebuffer_scale()
    width, height = (part * side for side in made.image)
    offsets = light.triangle(options.apart * made.image[1])
    top, left = (part * min(place[axis] for place in offsets) for axis in (0, 1))
    half = (min(width, height) if options.content == "test" else width) / 2
    ends, middles = [], []
    for row, column in offsets:
        x = at.x + part * column - left + width / 2
        y = at.y + part * row - top + height / 2
        ends.append((ImVec2(x - half, y), ImVec2(x + half, y)))
        middles.append(x)
    middle = sum(middles) / 3
    lenses = [ImVec2(middle + k * 4 * em, bottom - 1.8 * em) for k in (0, -1, 1)]
    rows = [row for row, _ in offsets]
    wall = at.y + height + part * (max(rows) - min(rows))
    projectors(lenses, ends, wall)
