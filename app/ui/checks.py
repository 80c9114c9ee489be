"""Check boxes and radio buttons whose edges are visible when they are empty.

Their background alone has too little contrast with a panel's: WCAG 2.1 (1.4.11) requires at least
3.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from . import theme

# The lines of the marks, as fractions of half their size.
CHECK = (((-1.0, 0.1), (-0.3, 0.8)), ((-0.3, 0.8), (1.0, -0.8)))
CROSS = (((-0.8, -0.8), (0.8, 0.8)), ((-0.8, 0.8), (0.8, -0.8)))


def checkbox(label: str, on: bool) -> tuple[bool, bool]:
    """Draw ImGui's check box. Return (was_clicked, is_on)."""
    _push_edge()
    changed, on = imgui.checkbox(label, on)
    _pop_edge()
    return changed, on


def radio_button(label: str, on: bool) -> bool:
    """Draw ImGui's radio button. Return True if it was clicked."""
    _push_edge()
    clicked = imgui.radio_button(label, on)
    _pop_edge()
    return bool(clicked)


def verdict_sign(middle: ImVec2, good: bool) -> None:
    """Draw a check mark or a cross, so that a verdict needs no colour. middle: in pixels."""
    r, draw = 0.32 * imgui.get_font_size(), imgui.get_window_draw_list()
    lines = CHECK if good else CROSS
    color = theme.u32(theme.GOOD if good else theme.legible(theme.ERROR))
    for start, end in lines:
        draw.add_line(middle + ImVec2(*start) * r, middle + ImVec2(*end) * r, color, theme.px(2.2))


def _push_edge() -> None:
    imgui.push_style_var(imgui.StyleVar_.frame_border_size, max(1.0, theme.px(1)))
    imgui.push_style_color(imgui.Col_.border, theme.PLAIN)
    imgui.push_style_color(imgui.Col_.border_shadow, theme.UNSEEN)


def _pop_edge() -> None:
    imgui.pop_style_color(2)
    imgui.pop_style_var()
