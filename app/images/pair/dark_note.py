"""The note over an image that is black or shows nothing: the reason, and a button that helps."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.images.screen import Screen
from lucida.app.ui import theme
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import button_width

PADDING_EM = 0.8
BOX, TEXT = theme.rgb("#0c0d0f", 0.85), theme.rgb("#e8eaed")


def dark_note(text: str, remedy: str, screen: Screen) -> bool:
    """Draw the note in the middle of the visible image. Return True if its button was pressed.

    remedy: the button's label; "" for none.
    """
    low, high = screen.visible
    em = imgui.get_font_size()
    size = imgui.calc_text_size(text, wrap_width=max(4 * em, 0.8 * (high.x - low.x)))
    padding = ImVec2(PADDING_EM * em, PADDING_EM * em)
    if remedy:
        size.x = max(size.x, button_width(remedy))
        size.y += imgui.get_frame_height_with_spacing()
    size += padding * 2 + ImVec2(2, 1)  # whole pixels
    imgui.set_cursor_screen_pos((low + high - size) / 2)
    imgui.push_style_color(imgui.Col_.child_bg, BOX)
    imgui.push_style_var(imgui.StyleVar_.window_padding, padding)
    flags = imgui.ChildFlags_.always_use_window_padding | imgui.ChildFlags_.nav_flattened
    # A scrollbar needed in one frame would narrow the text and thereby stay necessary.
    imgui.begin_child("##why", size, flags, imgui.WindowFlags_.no_scrollbar)
    imgui.pop_style_var()
    imgui.pop_style_color()
    wrapped(text, TEXT)
    pressed = bool(remedy and imgui.button(remedy))
    imgui.end_child()
    return pressed
