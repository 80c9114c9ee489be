"""Drawn next to the laboratory's kinds of image: how colour becomes gray."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.widgets import theme
from app.widgets.lettering import fitting_words, lettering
from app.widgets.theme import Fonts
from renderer.images.display import LUMINANCE

BARS = ("#e5484d", "#46a758", "#4f8ff7")  # red, green and blue, as light as text must be


def luminance_weights(at: ImVec2, room: ImVec2, fonts: Fonts) -> None:
    """Draw how colour becomes gray: Rec. 709's weights, as bars of their length."""
    em, width = imgui.get_font_size(), room.x
    line = max(1.1 * em, min(1.5 * em, (room.y - 2.8 * em) / len(BARS)))
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold):
        draw.add_text(at, theme.u32(theme.TEXT), "Luminance")
    y = at.y + 1.15 * em
    caption = "from colour to gray; Rec. 709, of linear light"
    draw.add_text(ImVec2(at.x, y), theme.u32(theme.DIM), fitting_words(caption, width))
    y += 1.65 * em
    longest = width - 6.5 * em
    for name, weight, color in zip("RGB", LUMINANCE, BARS, strict=True):
        with lettering(fonts.mono):
            draw.add_text(ImVec2(at.x, y), theme.u32(theme.TEXT), f"{weight:.4f} {name}")
        low = ImVec2(at.x + 5.5 * em, y + 0.1 * em)
        high = ImVec2(low.x + max(2.0, longest * float(weight)), y + 0.95 * em)
        draw.add_rect_filled(low, high, theme.u32(theme.rgb(color)), 2.0)
        y += line
