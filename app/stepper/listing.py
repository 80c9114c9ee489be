"""The running code, line by line, with the same in Julia next to it."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.explaining.breaking import narrowed
from app.explaining.languages import julia
from app.state.options import Notation
from app.stepper.source import shown_code
from app.widgets import theme
from app.widgets.code import LINE, code, letters_in, row_count
from app.widgets.lettering import lettering
from app.widgets.theme import Fonts
from renderer.pixels import Indexing


@dataclass(frozen=True)
class Listing:
    """A function's lines in Python, whether to show them in Julia too, and the sources of the
    functions that they call. notation, indexing: of what is shown.
    """

    lines: tuple[str, ...]
    notation: Notation
    indexing: Indexing
    in_julia: bool
    called: Mapping[str, str]


def listing(shown: Listing, lit: int, room: ImVec2, fonts: Fonts) -> None:
    """Draw the code with one line lit. Julia goes next to it if both have room, else below."""
    python = narrowed(shown_lines(shown.lines, shown.notation, shown.indexing))
    if not shown.in_julia:
        _lines("code", python, lit, room, shown.called, fonts)
        return
    twin = _twin(shown_lines(shown.lines, shown.notation), shown.indexing)
    in_julia = narrowed(twin.lines)
    gap, caption = imgui.get_style().item_spacing, imgui.get_text_line_height_with_spacing()
    half = 0.5 * (room.x - gap.x)
    beside = letters_in(half, imgui.get_font_size()) >= max(map(len, (*python, *in_julia)))
    height = room.y if beside else 0.5 * (room.y - gap.y)
    part = ImVec2(half if beside else room.x, height - caption)
    imgui.begin_group()
    imgui.text_colored(theme.DIM, "Python, which runs")
    _lines("code", python, lit, part, shown.called, fonts)
    imgui.end_group()
    if beside:
        imgui.same_line()
    imgui.begin_group()
    imgui.text_colored(theme.DIM, "Julia, for reading")
    _lines("julia", in_julia, twin.line_of[lit], part, {}, fonts)
    imgui.end_group()


def _lines(
    name: str,
    lines: tuple[str, ...],
    lit: int,
    room: ImVec2,
    called: Mapping[str, str],
    fonts: Fonts,
) -> None:
    """Draw lines of code; if not all of them fit, the part around the lit one."""
    line_px, letters = LINE * imgui.get_font_size(), letters_in(room.x, imgui.get_font_size())
    needed = row_count(lines, letters) * line_px
    height = min(needed, max(1, int(room.y / line_px)) * line_px)  # no line is cut
    flags = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
    imgui.begin_child(name, ImVec2(room.x, height), 0, flags)
    if needed > height:
        above = row_count(lines[:lit], letters) - int(0.5 * height / line_px)
        imgui.set_scroll_y(min(max(0.0, above * line_px), needed - height))
    with lettering(fonts.mono):
        code(lines, lit, room.x, called)
    imgui.end_child()


@functools.cache
def shown_lines(
    lines: tuple[str, ...], notation: Notation, indexing: Indexing = Indexing.ARRAY
) -> tuple[str, ...]:
    """Return lines of the loops as they are shown."""
    return tuple(shown_code(line, notation, indexing) for line in lines)


@functools.cache
def _twin(lines: tuple[str, ...], indexing: Indexing) -> julia.Loops:
    return julia.loops("\n".join(lines), indexing)
