"""Text with code in it, between backticks as in source text: set in a fixed-width font."""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from . import theme
from .lettering import lettering
from .theme import Fonts

TICK = "`"


def coded_text(text: str, width: float, color: ImVec4, fonts: Fonts) -> None:
    """Draw the text at the cursor, in the current font and size, in lines of this width.

    A single backtick is no code. Lines break between words.
    """
    parts = text.split(TICK) if text.count(TICK) % 2 == 0 else [text]
    draw, corner = imgui.get_window_draw_list(), imgui.get_cursor_screen_pos()
    line, at = imgui.get_text_line_height(), ImVec2(0, 0)
    pad = ImVec2(0.12 * line, 0)
    for number, part in enumerate(parts):
        is_code = number % 2 == 1
        with lettering(fonts.mono if is_code else None):
            space = imgui.calc_text_size(" ").x
            for k, word in enumerate(part.split(" ")):
                wide, gap = imgui.calc_text_size(word).x, space if k and at.x else 0.0
                if k and at.x + gap + wide > width:
                    at, gap = ImVec2(0, at.y + line), 0.0
                start = corner + at + ImVec2(gap, 0)
                if is_code:
                    left = start - ImVec2(gap if k else 0.0, 0) - pad
                    ground = theme.u32(theme.FRAME)
                    draw.add_rect_filled(left, start + ImVec2(wide, line) + pad, ground, pad.x)
                draw.add_text(start, theme.u32(color), word)
                at.x += gap + wide
    imgui.dummy((width, at.y + line))
