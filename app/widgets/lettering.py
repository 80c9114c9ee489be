"""Text of any size in any of the window's fonts.

Owns the way from a size on the screen to ImGui's own, which scales it. Knows nothing of what is
written.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator

from imgui_bundle import ImVec2, imgui

LEAST_FITTED = 0.7  # of the type of a line that is made smaller to have room
SMALLER = 0.94  # each size of type that is tried is that part of the one before
SMALLEST_PX = 1.0  # what has no room in its window may ask for less than nothing


@contextlib.contextmanager
def lettering(font: imgui.ImFont | None, size_px: float) -> Iterator[None]:
    """Text inside is of this font and size, in ImGui's pixels; None: the present font."""
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
    """Draws a line at a place, in smaller type where it would be wider than it may be; of what
    would be too small to read so, as many words as have room."""
    part = min(1.0, width_px / max(imgui.calc_text_size(text).x, 1.0))
    fits = part >= LEAST_FITTED
    with lettering(None, imgui.get_font_size() * max(part, LEAST_FITTED)):
        draw.add_text(at, color, text if fits else fitting_words(text, width_px))


def fitting_words(text: str, width_px: float) -> str:
    """The text, or as many of its first words as have room, in the present font."""
    words = text.split(" ")
    shown = text
    while len(words) > 1 and imgui.calc_text_size(shown).x > width_px:
        words.pop()
        shown = " ".join(words) + " ..."
    return shown


def fitting_px(most_px: float, room_px: float, height: Callable[[float], float]) -> float:
    """The largest size of type, of those tried from most_px down, at which text of height(size) has
    room; never below the window's."""
    least = imgui.get_font_size()
    size = most_px
    while size > least and height(size) > room_px:
        size = max(least, SMALLER * size)
    return size


def hall_px(width_px: float, letters: float) -> float:
    """A size at which a column has about so many letters a line; never below the window's own,
    so that what is wide can be read from afar."""
    return max(imgui.get_font_size(), min(2.2 * width_px / letters, 3 * imgui.get_font_size()))
