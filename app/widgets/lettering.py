"""Text of any size in any of the window's fonts, converted to ImGui's own scaled sizes."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator

from imgui_bundle import ImVec2, imgui

LEAST_FITTED = 0.7  # smallest scale of a line that must fit
SMALLER = 0.94  # ratio of successive type sizes tried
SMALLEST_PX = 1.0  # what has no room in its window may ask for less than nothing


@contextlib.contextmanager
def lettering(font: imgui.ImFont | None, size_px: float) -> Iterator[None]:
    """Set the font and size of text inside, in ImGui's pixels. None: the current font."""
    style = imgui.get_style()
    size = max(size_px, SMALLEST_PX) / (style.font_scale_main * style.font_scale_dpi)
    imgui.push_font(font, size)
    try:
        yield
    finally:
        imgui.pop_font()


@contextlib.contextmanager
def at_most(size_px: float) -> Iterator[None]:
    """Limit type and spacing inside to this size, to leave room for the text that is read."""
    style, part = imgui.get_style(), min(1.0, size_px / imgui.get_font_size())
    names = (
        "window_padding",
        "frame_padding",
        "item_spacing",
        "item_inner_spacing",
        "cell_padding",
    )
    for name in names:
        size = getattr(style, name)
        imgui.push_style_var(getattr(imgui.StyleVar_, name), ImVec2(part * size.x, part * size.y))
    try:
        with lettering(None, part * imgui.get_font_size()):
            yield
    finally:
        imgui.pop_style_var(len(names))


def fitted_text(draw: imgui.ImDrawList, at: ImVec2, color: int, text: str, width_px: float) -> None:
    """Draw a line, in smaller type if it is too wide. If that would be too small to read, draw as
    many words as fit.
    """
    part = min(1.0, width_px / max(imgui.calc_text_size(text).x, 1.0))
    fits = part >= LEAST_FITTED
    with lettering(None, imgui.get_font_size() * max(part, LEAST_FITTED)):
        draw.add_text(at, color, text if fits else fitting_words(text, width_px))


def fitting_words(text: str, width_px: float) -> str:
    """Return the text, or as many of its first words as fit, in the current font."""
    words = text.split(" ")
    shown = text
    while len(words) > 1 and imgui.calc_text_size(shown).x > width_px:
        words.pop()
        shown = " ".join(words) + " ..."
    return shown


def fitting_px(most_px: float, room_px: float, height: Callable[[float], float]) -> float:
    """Return the largest tried type size, from most_px down, at which text of height(size) fits;
    never smaller than the window's.
    """
    least = imgui.get_font_size()
    size = most_px
    while size > least and height(size) > room_px:
        size = max(least, SMALLER * size)
    return size


def hall_px(width_px: float, letters: float) -> float:
    """Return a size at which a column has about this many letters per line, so that wide columns
    can be read from afar; never smaller than the window's.
    """
    return max(imgui.get_font_size(), min(2.2 * width_px / letters, 3 * imgui.get_font_size()))
