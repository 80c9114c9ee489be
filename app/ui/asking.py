"""A small box in the middle of the window that asks for something to be typed."""

from __future__ import annotations

from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

TYPED = int(imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all)


class Box(NamedTuple):
    """A question in a small window.

    opened: the box was just opened and must be filled. stays: it was neither closed nor left by
    Escape. focused: it has the keyboard, even before one of its fields has taken it.
    """

    opened: bool
    stays: bool
    focused: bool


def begin_box(title: str) -> Box:
    """Begin the box. Call imgui.end() in any case."""
    center = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(center, imgui.Cond_.appearing, ImVec2(0.5, 0.5))
    flags = imgui.WindowFlags_
    opened, still_open = imgui.begin(
        title,
        True,
        flags.no_docking | flags.always_auto_resize | flags.no_collapse | flags.no_saved_settings,
    )
    focused = imgui.is_window_focused()
    # The field that is typed into takes Escape for itself; the box is left all the same.
    left = imgui.shortcut(int(imgui.Key.escape))
    left = left or (focused and imgui.is_key_pressed(imgui.Key.escape))
    return Box(opened, bool(still_open) and not left, focused)
