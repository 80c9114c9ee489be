"""A message over the window: one thing that went wrong, until it is closed.

Owns its place and look.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme


def message_box(text: str) -> bool:
    """Draws the message; gives whether it was closed."""
    viewport = imgui.get_main_viewport()
    width = min(640.0, viewport.work_size.x * 0.8)
    top = ImVec2(viewport.get_center().x, viewport.work_pos.y + 48)
    imgui.set_next_window_pos(top, imgui.Cond_.always, ImVec2(0.5, 0.0))
    imgui.set_next_window_size(ImVec2(width, 0))
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.border, theme.ERROR)
    imgui.begin(
        "##message",
        None,
        flags.no_decoration | flags.no_docking | flags.no_saved_settings | flags.no_move,
    )
    imgui.pop_style_color()
    imgui.push_text_wrap_pos(0.0)
    imgui.text(text)
    imgui.pop_text_wrap_pos()
    closed = imgui.button("Close") or imgui.is_key_pressed(imgui.Key.escape)
    imgui.end()
    return closed
