"""Text in any of the window's fonts, at the window's type size or a larger one."""

from __future__ import annotations

import contextlib
import re
from bisect import bisect
from collections.abc import Iterator

from imgui_bundle import ImVec4, imgui

from . import theme


@contextlib.contextmanager
def lettering(font: imgui.ImFont | None, larger: float = 1.0) -> Iterator[None]:
    """Set the font of text drawn inside; None for the current font.

    larger: the type size, as a multiple of the window's; for titles.
    """
    usual = theme.type_px()
    imgui.push_font(font, theme.TEXT_PX * theme.whole_px(usual * larger) / usual)
    try:
        yield
    finally:
        imgui.pop_font()


def underline(color: ImVec4) -> None:
    """Underline the last item: its meaning must be visible without its colour."""
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    draw = imgui.get_window_draw_list()
    draw.add_line((low.x, high.y), (high.x, high.y), theme.u32(color), theme.px(1.5))


def fitting_letters(text: str, width_px: float) -> str:
    """Return the text, shortened after a letter if it does not fit, in the current font.

    It suits names, which users choose.
    """
    if imgui.calc_text_size(text).x <= width_px:
        return text

    def width(count: int) -> float:
        return float(imgui.calc_text_size(text[:count] + "...").x)

    return text[: max(0, bisect(range(len(text)), width_px, key=width) - 1)] + "..."


def fitting_words(text: str, width_px: float) -> str:
    """Return the text, shortened after a word if it does not fit, in the current font.

    It ends at the last comma or semicolon that fits, or else after the last word that fits.
    """
    parts = [text[: found.start()] for found in re.finditer(r"[,;] |$", text)]
    whole = [part for part in parts if part.count("(") == part.count(")")]
    for shown in whole[::-1]:
        if imgui.calc_text_size(shown).x <= width_px:
            return shown
    shown = text
    words = text.split(" ")
    while len(words) > 1 and imgui.calc_text_size(shown).x > width_px:
        words.pop()
        shown = " ".join(words) + " ..."
    return shown
