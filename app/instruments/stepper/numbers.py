"""The variables of the loop stepper."""

from __future__ import annotations

from imgui_bundle import imgui

from lucida.app.instruments.stepper.model import Variable, describe
from lucida.app.state.options.shared import Notation
from lucida.app.ui import theme
from lucida.app.ui.explaining import symbols
from lucida.app.ui.lettering import underline
from lucida.app.ui.rows import follow
from lucida.app.ui.theme import Fonts
from lucida.renderer.camera.pixels import Indexing

INDICES = ("i", "j", "rows", "columns")  # the variables that count pixels


def numbers(
    variables: tuple[Variable, ...], indexing: Indexing, notation: Notation, fonts: Fonts
) -> None:
    """Draw the variables, each in a line."""
    if not variables or not imgui.begin_table("numbers", 2, imgui.TableFlags_.no_saved_settings):
        return
    names = [symbols.program(one.name, notation) for one in variables]
    widest = max(imgui.calc_text_size(name).x for name in names)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, widest)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch)
    for name, one in zip(names, variables, strict=True):
        text, note = one.text, one.note
        if one.name in INDICES:  # as the code next to it
            text, note = describe(one.value, indexing.value), indexing.told
        color = theme.legible(theme.MARK) if one.changed else theme.TEXT
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_colored(theme.DIM, name)
        imgui.table_next_column()
        imgui.push_text_wrap_pos(0.0)
        imgui.push_font(fonts.mono, 0.0)
        imgui.text_colored(color, text)
        imgui.pop_font()
        if one.changed:
            underline(color)
        if note:
            follow(imgui.calc_text_size(note).x)
            imgui.text_colored(theme.DIM, note)
        imgui.pop_text_wrap_pos()
    imgui.end_table()
