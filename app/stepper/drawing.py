"""A program and the canvas that it fills: as large as the room allows, no line of code wrapped."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.explaining.breaking import narrowed
from app.explaining.languages import julia
from app.state.app_state import AppState
from app.stepper.source import shown_lines
from app.widgets import theme
from app.widgets.canvas import Marks, canvas_unit, draw_canvas
from app.widgets.code import LINE, code, fitting_px
from app.widgets.lettering import lettering
from app.widgets.theme import Fonts
from renderer.camera import Size
from renderer.pixels import Indexing

GAP_EM = 0.9
MOST_CODE = 0.6  # of the width or height
LARGEST_EM = 1.3  # the code's type size
NUMBERED = 12  # the most rows or columns that all have numbers
Lit = Mapping[int, float]  # for the numbers of lines, the opacity of their highlight


@dataclass(frozen=True)
class Drawn:
    """What is drawn of a program.

    words_below: the code is below the canvas if it is not next to it.
    called: the sources of functions, which are shown under the mouse.
    """

    lines: tuple[str, ...]
    lit: Lit
    texture: int
    size: Size
    marks: Marks
    base: int
    words_below: bool = False
    called: Mapping[str, str] | None = None


def written(lines: tuple[str, ...], lit: Lit, state: AppState) -> tuple[tuple[str, ...], Lit]:
    """Return a program in the window's notation, language and indexing."""
    notation, indexing = state.options.notation, state.options.indexing
    if state.options.language == "python":
        return shown_lines(lines, notation, indexing), lit
    loops = _julia(shown_lines(lines, notation), indexing)
    return loops.lines, {loops.line_of[n]: part for n, part in lit.items()}


@functools.cache
def _julia(lines: tuple[str, ...], indexing: Indexing) -> julia.Loops:
    return julia.loops("\n".join(lines), indexing)


def draw_program(drawn: Drawn, low: ImVec2, room: ImVec2, fonts: Fonts) -> None:
    """Draw a program and its canvas in the middle of a room."""
    em, lines = imgui.get_font_size(), narrowed(drawn.lines)
    both = [_arranged(lines, drawn.size, room, em, beside) for beside in (False, True)]
    best = max(both, key=lambda one: one.type_px * one.canvas_px.x)
    total, spare = best.total_px, best.total_px - best.code_px
    low = low + (room - total) * 0.5
    code_at, canvas_at = ImVec2(0, 0), total - best.canvas_px
    if best.beside:
        code_at, canvas_at = ImVec2(0, 0.5 * spare.y), ImVec2(canvas_at.x, 0.5 * canvas_at.y)
    else:
        code_at, canvas_at = ImVec2(0.5 * spare.x, 0), ImVec2(0.5 * canvas_at.x, canvas_at.y)
        if drawn.words_below:
            code_at.y, canvas_at.y = spare.y, 0
    _canvas(drawn, low + canvas_at, best.unit, fonts)
    imgui.set_cursor_screen_pos(low + code_at)
    with lettering(fonts.mono, best.type_px / em):
        code(lines, drawn.lit, best.code_px.x, drawn.called or {})


@dataclass(frozen=True)
class Arranged:
    """A program and its canvas, side by side or one above the other.

    type_px: the size of the code's type. unit: the side of the canvas's pixels. code_px, canvas_px:
    the sizes of both, the canvas with its numbers. gap: between them.
    """

    beside: bool
    type_px: float
    unit: float
    code_px: ImVec2
    canvas_px: ImVec2
    gap: float

    @property
    def total_px(self) -> ImVec2:
        a, b = self.code_px, self.canvas_px
        if self.beside:
            return ImVec2(a.x + self.gap + b.x, max(a.y, b.y))
        return ImVec2(max(a.x, b.x), a.y + self.gap + b.y)


def _arranged(
    lines: tuple[str, ...], size: Size, room: ImVec2, em: float, beside: bool
) -> Arranged:
    """Arrange a program of some lines and a canvas of some pixels in a room."""
    most = ImVec2(MOST_CODE * room.x, room.y) if beside else ImVec2(room.x, MOST_CODE * room.y)
    type_px = fitting_px(lines, most, LARGEST_EM * em)
    wide = max(map(len, lines)) * math.ceil(0.5 * type_px) + type_px
    code_px, gap = ImVec2(wide, len(lines) * LINE * type_px), GAP_EM * em
    rest = room - (ImVec2(wide + gap, 0) if beside else ImVec2(0, code_px.y + gap))
    margin = _margin(size, em)
    unit = canvas_unit(size, rest - margin)
    return Arranged(beside, type_px, unit, code_px, margin + ImVec2(*size) * unit, gap)


def _margin(size: Size, em: float) -> ImVec2:
    """Return the room of the rows' numbers and of the columns'."""
    return ImVec2(0.5 * em * len(str(size[1])) + 0.5 * em, 1.1 * em)


def _canvas(drawn: Drawn, low: ImVec2, unit: float, fonts: Fonts) -> None:
    """Draw a canvas with the numbers of its rows and columns."""
    em, size = imgui.get_font_size(), drawn.size
    corner = low + _margin(size, em)
    draw_canvas(drawn.texture, size, corner, unit, drawn.marks)
    draw, font = imgui.get_window_draw_list(), fonts.mono or imgui.get_font()
    for axis, count in enumerate((size[1], size[0])):
        marked = drawn.marks.pixel[axis] if drawn.marks.pixel else -1
        digit = 0.5 * em
        if count <= NUMBERED:  # numbers of all pixels, side by side
            digit = min(digit, 0.8 * unit / len(str(count - 1 + drawn.base)))
        for number in _numbered(count, marked, (em, 2 * digit)[axis] / unit):
            text = str(number + drawn.base)
            extent, middle = ImVec2(digit * len(text), 2 * digit), (number + 0.5) * unit
            at = corner + ImVec2(-0.3 * em - extent.x, middle - 0.5 * extent.y)
            if axis:
                at = corner + ImVec2(middle - 0.5 * extent.x, -0.1 * em - extent.y)
            if number == marked:  # the mark's yellow is legible on dark only
                draw.add_rect_filled(at, at + extent, theme.u32(theme.MARK), 2.0)
            color = theme.rgb("#000000") if number == marked else theme.TEXT
            draw.add_text(font, 2 * digit, at, theme.u32(color), text)


def _numbered(count: int, marked: int, needed: float) -> list[int]:
    """Return the rows or columns that get a number: all, or the first, the last and the marked.

    needed: the size of a number, in pixels of the canvas.
    """
    if count <= NUMBERED:
        return list(range(count))
    ends = [n for n in (0, count - 1) if marked < 0 or abs(n - marked) > needed]
    return [*ends, *([marked] if marked >= 0 else [])]
