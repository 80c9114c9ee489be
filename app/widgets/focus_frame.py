"""The frame around the control that has the keyboard, the same for every control and drawn last.

ImGui's own is drawn before what a control of ours paints over it, and is thin on a projector. Its
two colours have a contrast of 9:1, so that one of them has 3:1 on any ground (WCAG 2.2, 2.4.13).
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui.internal import ImRect

from app.widgets import theme

LINE, CASING = 2.5, 6.5  # widths at 100 %


class FocusFrame:
    """The frame of one window."""

    def __init__(self) -> None:
        self._item = ImRect()

    def draw(self) -> None:
        """Draw the frame, if the keyboard is in use. Call once a frame, after all windows."""
        context = imgui.get_current_context()
        window = context.nav_window
        if window is None or not (context.nav_cursor_visible and context.nav_id_is_alive):
            return
        if not context.nav_move_submitted:  # then it is not the item's, but what a move is to reach
            self._item = ImRect(context.nav_scoring_rect.min, context.nav_scoring_rect.max)
        item, shown = self._item, window.outer_rect_clipped
        line, casing = max(2.0, theme.px(LINE)), max(6.0, theme.px(CASING))
        rim = ImVec2(casing / 2, casing / 2)
        inner = ImRect(shown.min + rim, shown.max - rim)
        low = ImVec2(max(item.min.x - 1, inner.min.x), max(item.min.y - 1, inner.min.y))
        high = ImVec2(min(item.max.x + 1, inner.max.x), min(item.max.y + 1, inner.max.y))
        if high.x <= low.x or high.y <= low.y:
            return
        draw = window.draw_list
        draw.push_clip_rect(shown.min, shown.max)
        draw.add_rect(low, high, theme.u32(theme.rgb("#000000")), theme.px(3), casing)
        draw.add_rect(low, high, theme.u32(theme.RAY), theme.px(3), line)
        draw.pop_clip_rect()
