"""Boxes over the window for errors and progress, and the error of a view.

overlay() draws the boxes of other modules too.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.renderer.system.errors import describe

from . import theme

SHOWN_AFTER_S = 0.4  # quick work has no progress bar
LONG = 40  # letters of an answer
LOADING = "##loading"


@contextlib.contextmanager
def overlay(
    name: str, at: ImVec2, pivot: tuple[float, float], width: float, edge: ImVec4, flags: int = 0
) -> Iterator[None]:
    """Draw the block's content in a box without a title.

    at, pivot: a place, and the point of the box that is there. edge: the colour of the border.
    """
    imgui.set_next_window_pos(at, imgui.Cond_.always, pivot)
    imgui.set_next_window_size((width, 0))
    imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
    imgui.push_style_color(imgui.Col_.border, edge)
    fixed = imgui.WindowFlags_
    flags |= fixed.no_decoration | fixed.no_docking | fixed.no_saved_settings | fixed.no_move
    imgui.begin(name, None, flags)
    imgui.pop_style_color(2)
    try:
        yield
    finally:
        imgui.end()


def top_center(lines: float) -> ImVec2:
    """Return the place this many lines below the middle of the window's upper edge."""
    viewport = imgui.get_main_viewport()
    return ImVec2(viewport.get_center().x, viewport.work_pos.y + lines * imgui.get_font_size())


def box_width(most_em: float, part: float) -> float:
    """Return a box's width: `most_em` type sizes, but at most this fraction of the window."""
    return min(most_em * imgui.get_font_size(), part * imgui.get_main_viewport().work_size.x)


def wrapped(text: str, color: ImVec4 | None = None, width: float = 0.0) -> None:
    """Draw a text in as many lines as it needs. width: 0 for the full width."""
    imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + width if width else 0.0)
    imgui.text_colored(theme.TEXT if color is None else color, text)
    imgui.pop_text_wrap_pos()


def message_box(text: str, answers: Sequence[str] = ("Close",)) -> str:
    """Draw a message with buttons, one below the other if they are long. Return the selected
    answer, or "".
    """
    chosen, is_long = "", max(map(len, answers)) > LONG
    with overlay("##message", top_center(3), (0.5, 0), box_width(40, 0.8), theme.ERROR):
        wrapped(text)
        for index, answer in enumerate(answers):
            if index and not is_long:
                imgui.same_line()
            if imgui.button(answer):
                chosen = answer
    return chosen


def loading_box(what: str, time_s: float) -> bool:
    """Draw the current work, its time and a button. Return True if the user cancels."""
    if time_s < SHOWN_AFTER_S:
        return False
    flags = int(imgui.WindowFlags_.no_focus_on_appearing)
    with overlay(LOADING, top_center(3), (0.5, 0), box_width(26, 0.8), theme.ACCENT, flags):
        wrapped(f"{what} ...")
        imgui.push_style_color(imgui.Col_.plot_histogram, theme.ACCENT)
        # Draw a moving bar, because the duration is unknown.
        size = -8 * imgui.get_font_size(), 0
        imgui.progress_bar(-0.5 * time_s, size, f"{time_s:.0f} s")
        imgui.same_line()
        cancelled = bool(imgui.button("Cancel", (-1, 0)))
        imgui.pop_style_color()
    return cancelled


def failure_note(title: str, error: Exception) -> bool:
    """Draw the error of a view that could not be drawn. Return True if the user wants a retry."""
    place, room = imgui.get_cursor_pos(), imgui.get_content_region_avail()
    margin = 0.5 * imgui.get_font_size()  # views of images have no padding
    imgui.set_cursor_pos(place + ImVec2(margin, margin))
    imgui.begin_group()
    imgui.push_text_wrap_pos(place.x + room.x - margin)
    imgui.text_colored(theme.ERROR, f"{' '.join(title.split())} could not be drawn.")
    imgui.text(describe(error))
    imgui.pop_text_wrap_pos()
    again = bool(imgui.button("Try again"))
    imgui.end_group()
    return again
