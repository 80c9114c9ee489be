"""A few lines of Python on the screen, some of them highlighted.

Names have the same colours as in the formulas.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping, Sequence

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.ui import theme

LINE = 1.18  # a line's height, relative to the type's
NAMED = re.compile(r"(\b(?:ray|hit|closest)\b)")


def code(lines: Sequence[str], lit: Mapping[int, float], width_px: float) -> None:
    """Draw the lines in the current font.

    lit: the opacities of highlights, by line number; 1 for the line about to run. width_px: the
    highlight's width.
    """
    draw, corner = imgui.get_window_draw_list(), imgui.get_cursor_screen_pos()
    letter, line_px = imgui.calc_text_size("0").x, LINE * imgui.get_font_size()
    bar, margin = 0.7 * letter, 0.5 * (line_px - imgui.get_text_line_height())
    for number, text in enumerate(lines):
        low = corner + ImVec2(0, number * line_px)
        if part := lit.get(number, 0.0):
            lit_color = theme.u32(theme.LIT, part)
            bar_color = theme.u32(theme.seen(theme.RAY), part)
            draw.add_rect_filled(low, low + ImVec2(width_px, line_px), lit_color, 2.0)
            draw.add_rect_filled(low, low + ImVec2(bar, line_px), bar_color)
        for column, word in code_words(text):
            at = low + ImVec2(2 * bar + imgui.calc_text_size(text[:column]).x, margin)
            draw.add_text(at, theme.u32(_color(word)), word)
    imgui.dummy((width_px, len(lines) * line_px))


def code_size(lines: Sequence[str]) -> ImVec2:
    """Return the space that code() needs for the lines, in the current font."""
    width = max(imgui.calc_text_size(line).x for line in lines) + 2.4 * imgui.calc_text_size("0").x
    return ImVec2(width, len(lines) * LINE * imgui.get_font_size())


def _color(word: str) -> ImVec4:
    if not NAMED.fullmatch(word):
        return theme.TEXT
    return theme.legible(theme.RAY if word == "ray" else theme.MARK)


@functools.lru_cache(maxsize=256)
def code_words(text: str) -> tuple[tuple[int, str], ...]:
    """Split a line into parts, with the column of each: coloured names, and the text between
    them.
    """
    words, column = [], 0
    for word in NAMED.split(text):
        words.append((column, word))
        column += len(word)
    return tuple((column, word) for column, word in words if word)
