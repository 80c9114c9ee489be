"""The frame around the control that has the keyboard, the same for every control and drawn last.

ImGui draws its own frame first, so that our controls paint over it, and it is thin on a projector.
The two colours of this frame have a contrast of 9:1, so that one of them has 3:1 on any background
(WCAG 2.2, 2.4.13).
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui.internal import ImRect

from . import theme

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
        if not context.nav_move_submitted:  # during a move, it is the target's
            self._item = ImRect(context.nav_scoring_rect.min, context.nav_scoring_rect.max)
        line, casing = max(LINE, theme.px(LINE)), max(CASING, theme.px(CASING))
        root, rim = window.root_window.outer_rect_clipped, ImVec2(casing / 2, casing / 2)
        shown = ImRect(root.min - ImVec2(0, casing), root.max)  # a dock's tabs leave space for it
        item = ImRect(self._item.min, self._item.max)
        item.clip_with(window.outer_rect_clipped)
        if item.is_inverted():
            return
        item = ImRect(item.min - rim, item.max + rim)  # outside the item, to cover no letter
        item.clip_with(ImRect(shown.min + rim / 2, shown.max - rim / 2))
        draw = window.draw_list
        draw.push_clip_rect(shown.min, shown.max)
        draw.add_rect(item.min, item.max, theme.u32(theme.rgb("#000000")), theme.px(3), casing)
        draw.add_rect(item.min, item.max, theme.u32(theme.RAY), theme.px(3), line)
        draw.pop_clip_rect()
