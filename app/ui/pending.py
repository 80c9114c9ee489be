"""A note next to a panel: the error in a number that was typed there, and a way back.

The panel itself does not move, and nothing in it is hidden.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from . import theme
from .messages import overlay, wrapped

WIDTH_EM = 19.0
_place: list[float] = []  # upper edge of the wrong field, on the screen


def here() -> None:
    """Note that the current item is wrong."""
    _place[:] = [imgui.get_item_rect_min().y]


def note(text: str, button: str) -> bool:
    """Draw the note next to the current window, at the height of the wrong field. Return True if
    its button was clicked.

    If there is no room next to the window, the note covers its end.
    """
    viewport, em = imgui.get_main_viewport(), imgui.get_font_size()
    at, size = imgui.get_window_pos(), imgui.get_window_size()
    low, high = viewport.work_pos, viewport.work_pos + viewport.work_size
    wide, gap = WIDTH_EM * em, 0.3 * em
    y = min(max(_place[0] if _place else at.y, at.y), high.y - 6 * em)
    if at.x + size.x + gap + wide <= high.x:
        place, pivot = ImVec2(at.x + size.x + gap, y), (0, 0)
    elif at.x - gap - wide >= low.x:
        place, pivot = ImVec2(at.x - gap, y), (1, 0)
    else:
        place, pivot = ImVec2(at.x, at.y + size.y), (0, 1)
    flags = imgui.WindowFlags_.no_focus_on_appearing | imgui.WindowFlags_.no_nav_focus
    with overlay("###pending", place, pivot, wide, theme.ERROR, int(flags)):
        wrapped(text, theme.legible(theme.ERROR))
        return bool(imgui.button(button))
