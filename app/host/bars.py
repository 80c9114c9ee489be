"""The backgrounds of the menu bar, the tab bars and the status bar, in the underlay.

ImGui draws them as well while a window floats, which they might cover.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from app.images.screen import MAIN_DOCK, window_px
from app.images.underlay import Underlay
from app.widgets import theme

BOTTOM = MAIN_DOCK, "##MainMenuBar", "StatusBar"  # HelloImGui's windows with nothing under them


class Bars:
    """Call its methods in this order in each frame."""

    def __init__(self) -> None:
        self._is_alone = False  # the underlay

    def begin_frame(self) -> None:
        """Leave out ImGui's own backgrounds of docks and menu bar, which it draws next, if no
        window floats.
        """
        windows = imgui.get_current_context().windows
        used = (one.root_window_dock_tree for one in windows if one.was_active)
        self._is_alone = all(root is None or root.name in BOTTOM for root in used)
        theme.show_bars(not self._is_alone)

    def show(self, underlay: Underlay) -> None:
        """Give all windows from here on their backgrounds, and lay the menu bar's."""
        theme.show_bars(True)
        view = imgui.get_main_viewport()
        size = ImVec2(view.size.x, view.work_pos.y - view.pos.y)
        _lay(underlay, view.pos, size, theme.BACKGROUND)

    def lay_tabs(self, underlay: Underlay) -> None:
        """Lay the tab bar's background of the current window, which is docked."""
        height = imgui.internal.get_current_window().title_bar_height
        size = ImVec2(imgui.get_window_size().x, height)
        _lay(underlay, imgui.get_window_pos(), size, theme.BACKGROUND)

    def before_window(self, is_status: bool) -> None:
        """Leave out the next window's background if it is the status bar."""
        if self._is_alone:
            imgui.set_next_window_bg_alpha(0.0 if is_status else 1.0)

    def lay_status(self, underlay: Underlay) -> None:
        """Lay the background of the status bar, the current window."""
        _lay(underlay, imgui.get_window_pos(), imgui.get_window_size(), theme.PANEL)


def _lay(underlay: Underlay, corner: ImVec2, size: ImVec2, color: ImVec4) -> None:
    """Lay a background, also under ImGui's, whose corners are round."""
    underlay.fill(window_px(corner, corner + size), (color.x, color.y, color.z))
