"""A number field during typing: it accepts fractions, roots and sums, and reports other text.

ImGui starts the typing (double click, Ctrl+click, Enter, Tab) with a text field that takes only
digits. From the next frame on, this one replaces it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import imgui

from lucida.renderer.system.errors import LucidaError

from . import theme
from .explaining.arithmetic import number


@dataclass
class _Typing:
    """A field during typing.

    before: the value that Esc restores.
    text: the text so far.
    wrong: its error.
    is_new: True until it is drawn, when the widget's own text must be replaced.
    """

    before: float
    text: str
    wrong: str = ""
    is_new: bool = True


# By the fields' ids. There is one keyboard, but when Tab leads from one field to the next, both are
# open for a frame.
open_fields: dict[int, _Typing] = {}


def is_open(label: str) -> bool:
    """Return True if the field with that label is being typed into, or was in the last frame."""
    return bool(open_fields) and imgui.get_id(f"##{label}") in open_fields


def take_over(label: str, value: float, changed: bool) -> bool:
    """Return True if the number's widget has begun to take text; field() then continues. Call after
    the widget.

    changed: True if letters were typed already. They are kept, and the widget's value is ignored.
    """
    item = imgui.get_id(f"##{label}")
    has_begun = bool(imgui.internal.temp_input_is_active(item))
    if has_begun:
        open_fields[item] = _Typing(value, _digits(value), is_new=not changed)
    return has_begun


def field(label: str, value: float) -> tuple[bool, float]:
    """Draw the field as text, with all digits of the value. Return (changed, value).

    The value follows while the text is a number. Any other text is reported and leaves the value.
    """
    item = imgui.get_id(f"##{label}")
    typing = open_fields[item]
    if typing.is_new:
        # The text is the widget's: it is rounded, and has been there for a frame under this id.
        state = imgui.internal.get_input_text_state(item)
        if state is not None:
            state.reload_user_buf_and_select_all()
        typing.is_new = False
    if typing.wrong:
        imgui.push_style_color(imgui.Col_.text, theme.legible(theme.ERROR))
    edited, text = imgui.input_text(f"##{label}", typing.text)
    if typing.wrong:
        imgui.pop_style_color()
    is_active = imgui.is_item_active()
    if not is_active:
        del open_fields[item]
        if imgui.is_key_pressed(imgui.Key.escape, False):
            return typing.before != value, typing.before
    if edited:
        typing.text = text
        try:
            new = number(text)
            typing.wrong = ""
        except LucidaError as error:
            new, typing.wrong = value, str(error)
        if new != value:
            return True, new
    if is_active and typing.wrong:
        low = imgui.get_item_rect_min()
        imgui.set_next_window_pos((low.x, imgui.get_item_rect_max().y))
        imgui.set_tooltip(typing.wrong)
    return False, value


def _digits(value: float) -> str:
    """Return all digits of a number, without those that only its nearest float32 has."""
    if not math.isfinite(value):
        return ""
    short = f"{value:.7g}"
    return short if math.isclose(float(short), value, rel_tol=1e-15) else repr(value)
