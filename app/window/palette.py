"""The command palette: type a few letters, choose with the arrows, Enter does it.

Owns its look, its keys and what was chosen last. What there is to choose: palette_search.py.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.messages import box_width, overlay, top_center
from lucida.app.window.palette_search import Entry, found

SHOWN_ROWS = 12
REMEMBERED = 50
WIDTH_EM = 40.0
NAME = "##palette"


class CommandPalette:
    """open: it is visible."""

    def __init__(self) -> None:
        self.open = False
        self.recent: list[str] = []
        self._query = ""
        self._chosen = 0
        self._appearing = False

    def toggle(self) -> None:
        self.open = not self.open
        self._query, self._chosen, self._appearing = "", 0, True

    def draw(self, entries: Callable[[], list[Entry]]) -> None:
        """Draw the palette if it is open, and run the selected entry."""
        if not self.open:
            return
        with overlay(NAME, top_center(2), (0.5, 0), box_width(WIDTH_EM, 0.9), theme.ACCENT):
            if self._appearing:
                imgui.set_window_focus()
                imgui.set_keyboard_focus_here()
            elif imgui.is_key_pressed(imgui.Key.escape, False) or not imgui.is_window_focused(
                imgui.FocusedFlags_.root_and_child_windows
            ):
                self.open = False
            matches = self._search(entries())
            chosen = self._keys(matches)
            clicked = self._list(matches)
        self._appearing = False
        entry = clicked or chosen
        if entry is not None:
            self.open = False
            self.recent = [entry.key, *(k for k in self.recent if k != entry.key)]
            del self.recent[REMEMBERED:]
            entry.run()

    def _search(self, entries: list[Entry]) -> list[Entry]:
        imgui.set_next_item_width(-1)
        hint = "a few letters of a command; arrows select, Enter runs it"
        changed, self._query = imgui.input_text_with_hint("##query", hint, self._query)
        if changed:
            self._chosen = 0
        return found(self._query, entries, self.recent)

    def _keys(self, matches: list[Entry]) -> Entry | None:
        """Move the selection. Return the entry on which Enter was pressed."""
        step = {
            imgui.Key.down_arrow: 1,
            imgui.Key.up_arrow: -1,
            imgui.Key.page_down: SHOWN_ROWS,
            imgui.Key.page_up: -SHOWN_ROWS,
        }
        for key, rows in step.items():
            if imgui.is_key_pressed(key):
                self._chosen += rows
        self._chosen = max(0, min(self._chosen, len(matches) - 1))
        entered = any(
            imgui.is_key_pressed(key, False) for key in (imgui.Key.enter, imgui.Key.keypad_enter)
        )
        if entered and matches and matches[self._chosen].enabled:
            return matches[self._chosen]
        return None

    def _list(self, matches: list[Entry]) -> Entry | None:
        row = imgui.get_text_line_height_with_spacing()
        room = imgui.get_main_viewport().work_size.y - 7 * imgui.get_font_size()
        rows = max(1, min(SHOWN_ROWS, len(matches), int(room / row)))
        imgui.begin_child("##matches", (0, rows * row), 0, imgui.WindowFlags_.no_nav)
        clicked = None
        if not matches:
            imgui.text_colored(theme.DIM, "No matching command")
        clipper = imgui.ListClipper()
        clipper.begin(len(matches), row)
        clipper.include_item_by_index(self._chosen)
        while clipper.step():
            for index in range(clipper.display_start, clipper.display_end):
                if self._row(matches[index], index):
                    clicked = matches[index]
        imgui.end_child()
        return clicked

    def _row(self, entry: Entry, index: int) -> bool:
        chosen = index == self._chosen
        start = imgui.get_cursor_pos()
        flags = 0 if entry.enabled else imgui.SelectableFlags_.disabled
        clicked, _ = imgui.selectable(f"##{index}", chosen, flags)
        if chosen and not imgui.is_item_visible():
            imgui.set_scroll_here_y(0.5)
        imgui.set_cursor_pos(start)
        color = theme.TEXT if entry.enabled else theme.DIM
        imgui.text_colored(color, entry.name)
        if entry.on:
            imgui.same_line()
            imgui.text_colored(theme.GOOD, "on")
        keys = imgui.calc_text_size(entry.keys).x
        right = imgui.get_window_width() - imgui.get_style().scrollbar_size - 4
        place = f"{entry.where}    " if entry.keys else entry.where
        left = right - keys - imgui.calc_text_size(place).x
        imgui.same_line()
        if left > imgui.get_cursor_pos_x():
            imgui.same_line(left)
            imgui.text_colored(theme.DIM, place)
        imgui.same_line(max(right - keys, imgui.get_cursor_pos_x()))
        imgui.text_colored(color, entry.keys)
        return bool(clicked)
