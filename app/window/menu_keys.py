"""Alt alone, or F10, which moves the keyboard to the menu bar and back.

ImGui's own Alt leads to the menus of the focused window. The menu bar is a window of its own, which
no key of ImGui's reaches.
"""

from __future__ import annotations

from imgui_bundle import imgui

Key = imgui.Key
BAR = "##MainMenuBar"
ALT = Key.left_alt  # the right one types letters on many keyboards
# All other keys, with the mouse's buttons and wheel, which ImGui numbers after them.
OTHERS = [key for key in Key if Key.tab <= key < Key.reserved_for_mod_ctrl and key != ALT]


class MenuKeys:
    """The keys of the menu bar. in_menus: True if the keyboard is in the bar or in a menu."""

    def __init__(self) -> None:
        self.in_menus = False
        self._is_alone = False  # nothing else was pressed while Alt was held
        self._was_open = False  # whether a menu was open in the previous frame
        self._came_from_menu = False  # whether an arrow key closed one
        self._walking = 0  # frames in which a menu may close because of an arrow key
        self._before: imgui.internal.Window | None = None

    def frame(self) -> None:
        """Handle the keys. Call once a frame, before the menus are drawn."""
        asked = self._alt_alone() or imgui.shortcut(int(Key.f10), imgui.InputFlags_.route_global)
        is_open = imgui.is_popup_open("", int(imgui.PopupFlags_.any_popup))
        sideways = any(imgui.is_key_pressed(key) for key in (Key.left_arrow, Key.right_arrow))
        self._walking = 3 if sideways else max(0, self._walking - 1)
        nav, escape = imgui.get_current_context().nav_window, imgui.is_key_pressed(Key.escape)
        is_on_bar = nav is not None and nav.name == BAR
        if escape and is_open and _is_over_menu():
            imgui.internal.close_popup_to_level(0, True)
        if not self.in_menus:
            if asked and not is_open:
                self._enter()
        elif not (is_on_bar or is_open):  # something else has the keyboard
            self.in_menus = False
        elif asked or (escape and not self._was_open) or self._has_chosen(is_open or escape):
            self._leave()
        elif self._walking == 1 and not is_open and self._came_from_menu:
            imgui.internal.activate_item_by_id(imgui.get_current_context().nav_id)
        self._came_from_menu = self._walking > 0 and (is_open or self._came_from_menu)
        self._was_open = is_open

    def _has_chosen(self, stays: bool) -> bool:
        """Return True if a menu has closed because an entry was selected."""
        return self._was_open and not (stays or self._walking)

    def _alt_alone(self) -> bool:
        """Return True if Alt was released, and nothing else was pressed while it was held."""
        if imgui.is_key_down(ALT):
            imgui.internal.set_key_owner(ALT, imgui.get_id(BAR))  # keep ImGui from using it
            other = any(imgui.is_key_down(key) for key in OTHERS)
            self._is_alone = not other and (self._is_alone or imgui.is_key_pressed(ALT, False))
            return False
        was_alone, self._is_alone = self._is_alone, False
        return was_alone and imgui.is_key_released(ALT)

    def _enter(self) -> None:
        bar, context = imgui.internal.find_window_by_name(BAR), imgui.get_current_context()
        self.in_menus, self._before = True, context.nav_window
        imgui.internal.clear_active_id()
        imgui.internal.focus_window(bar)
        context.nav_layer = imgui.internal.NavLayer.menu
        imgui.internal.nav_init_window(bar, True)
        imgui.set_nav_cursor_visible(True)

    def _leave(self) -> None:
        self.in_menus = False
        imgui.set_window_focus(None)  # if no window had the focus
        if self._before is not None:
            imgui.internal.focus_window(self._before)
        imgui.set_nav_cursor_visible(True)


def _is_over_menu() -> bool:
    """Return True if the mouse is over an open menu, which would open its submenu again."""
    hovered = imgui.get_current_context().hovered_window
    return hovered is not None and "###Menu_" in hovered.name
