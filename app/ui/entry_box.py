"""A small box in the middle of the window with fields to type into."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from imgui_bundle import ImVec2, imgui

from lucida.renderer.system.errors import LucidaError

from . import theme

TYPED = int(imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all)


class Box(Protocol):
    """A box in the middle of the window. focused: True if it has the keyboard."""

    focused: bool

    def draw(self) -> bool:
        """Draw the box. Return True while it stays open."""


class EntryBox:
    """A box. Tab moves from field to field, Enter enters the texts, Escape closes it.

    fields: each field's initial text, by its name.
    button: the label of its button.
    rule: the line below the fields.
    entered: called with the texts; the box stays open if it raises LucidaError.
    field_em: the width of a field, in type sizes.
    problem: the last error.
    focused: True if the box has the keyboard, even before one of its fields has taken it.
    """

    def __init__(
        self,
        title: str,
        fields: dict[str, str],
        button: str,
        rule: str,
        entered: Callable[[tuple[str, ...]], None],
        field_em: float = 5.0,
    ) -> None:
        self._title, self._fields, self._button = title, fields, button
        self._rule, self._entered, self._field_em = rule, entered, field_em
        self._appearing = True
        self.problem = ""
        self.focused = True

    def draw(self) -> bool:
        """Draw the box. Return True while it stays open."""
        center, flags = imgui.get_main_viewport().get_center(), imgui.WindowFlags_
        imgui.set_next_window_pos(center, imgui.Cond_.appearing, ImVec2(0.5, 0.5))
        _, stays = imgui.begin(
            self._title,
            True,
            flags.no_docking
            | flags.always_auto_resize
            | flags.no_collapse
            | flags.no_saved_settings,
        )
        self.focused = imgui.is_window_focused()
        # The active field consumes Escape; the box closes all the same.
        left = imgui.shortcut(int(imgui.Key.escape))
        left = left or (self.focused and imgui.is_key_pressed(imgui.Key.escape))
        room = imgui.get_main_viewport().work_size.x
        width = min(self._field_em * imgui.get_font_size(), 0.5 * room)
        done = False
        for name, text in self._fields.items():
            imgui.align_text_to_frame_padding()
            imgui.text(name)
            imgui.same_line()
            if self._appearing:
                imgui.set_keyboard_focus_here()
                self._appearing = False
            imgui.set_next_item_width(width)
            entered, self._fields[name] = imgui.input_text(f"##{name}", text, TYPED)
            done = done or entered
            imgui.same_line()
        done = imgui.button(self._button) or done
        color = theme.ERROR if self.problem else theme.DIM
        imgui.push_text_wrap_pos(0.8 * room)
        imgui.text_colored(color, self.problem or self._rule)
        imgui.pop_text_wrap_pos()
        imgui.end()
        if not done:
            return bool(stays and not left)
        try:
            self._entered(tuple(self._fields.values()))
        except LucidaError as error:
            self.problem, self._appearing = str(error), True
            return True
        return False
