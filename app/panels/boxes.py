"""A small box in the middle of the window that asks for something to be typed.

Owns its place and look, and when it is left. What is asked is its callers'.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

TYPED = int(imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all)


def begin_box(title: str) -> tuple[bool, bool | None]:
    """As imgui.begin(): whether it is to be filled, and whether it stays open. Call imgui.end()."""
    center = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(center, imgui.Cond_.appearing, ImVec2(0.5, 0.5))
    flags = imgui.WindowFlags_
    return imgui.begin(
        title,
        True,
        flags.no_docking | flags.always_auto_resize | flags.no_collapse | flags.no_saved_settings,
    )


def is_left(still_open: bool | None) -> bool:
    """Whether the box was closed, or Escape pressed."""
    return not still_open or imgui.is_key_pressed(imgui.Key.escape)
