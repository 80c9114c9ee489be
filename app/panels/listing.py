"""The code that runs, line by line, and the same in Julia beside it.

Owns how the two share their room. What they do is teach/loops.py's.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.lettering import lettering
from app.panels.code import LINE, code, code_size_px
from app.teach.languages import julia
from app.theme import Fonts

LEGIBLE_EM = 0.85  # the least size of the code, where the width allows


@dataclass(frozen=True)
class Listing:
    """A function's lines in Python, whether they are wanted in Julia, too, and the sources of the
    functions that they call."""

    lines: tuple[str, ...]
    in_julia: bool
    called: Mapping[str, str]


def listing(shown: Listing, lit: int, size_px: float, room: ImVec2, fonts: Fonts) -> None:
    """The code, one line of it lit; in Julia beside it where both can be read, else below."""
    if not shown.in_julia:
        _lines("code", shown.lines, lit, size_px, room, shown.called, fonts)
        return
    twin = _twin(shown.lines)
    gap = imgui.get_style().item_spacing
    half = 0.5 * (room.x - gap.x)
    beside_px = code_size_px(max((*shown.lines, *twin.lines), key=len), half, size_px)
    beside = beside_px >= LEGIBLE_EM * imgui.get_font_size()
    size_px = beside_px if beside else size_px
    part = ImVec2(half, room.y) if beside else ImVec2(room.x, 0.5 * (room.y - gap.y))
    _lines("code", shown.lines, lit, size_px, part, shown.called, fonts)
    if beside:
        imgui.same_line()
    _lines("julia", twin.lines, twin.line_of[lit], size_px, part, {}, fonts)


def _lines(
    name: str,
    lines: tuple[str, ...],
    lit: int,
    size_px: float,
    room: ImVec2,
    called: Mapping[str, str],
    fonts: Fonts,
) -> None:
    """Lines of code; where not all of them have room, the part around the lit one."""
    line_px = LINE * size_px
    needed = len(lines) * line_px
    height = min(needed, max(1, int(room.y / line_px)) * line_px)  # no line is cut
    flags = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
    imgui.begin_child(name, ImVec2(room.x, height), 0, flags)
    if needed > height:
        above = lit - int(0.5 * height / line_px)
        imgui.set_scroll_y(min(max(0.0, above * line_px), needed - height))
    with lettering(fonts.mono, size_px):
        code(lines, lit, size_px, room.x, called)
    imgui.end_child()


@functools.cache
def _twin(lines: tuple[str, ...]) -> julia.Loops:
    return julia.loops("\n".join(lines))
