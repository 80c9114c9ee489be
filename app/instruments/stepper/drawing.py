"""A program and the canvas that it fills, as large as the space allows, without wrapped lines."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.canvas import Marks, canvas_unit, color_picture, draw_canvas
from lucida.app.ui.explaining.breaking import narrowed
from lucida.app.ui.lettering import lettering
from lucida.app.ui.theme import Fonts
from lucida.app.ui.uploads import Uploads
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.system.memo import Memo

from . import julia
from .code import LINE, code, code_size
from .source import shown_lines

GAP_EM = 0.9
MOST_CODE = 0.68  # the code's largest share of the width or height
LARGEST = 1.5, 1.3, 1.0  # the code's type sizes, relative to the window's
LEAST_WORDS = 0.8  # the least size of prose, small enough that a slide need not scroll
NUMBERED = 12  # the most rows or columns that all have numbers
Lit = Mapping[int, float]  # the opacities of highlights, by line number


@dataclass(frozen=True)
class Drawn:
    """The drawn part of a program.

    in_words: True if the program is prose.
    """

    lines: tuple[str, ...]
    lit: Lit
    texture: int
    size: Size
    marks: Marks
    base: int
    in_words: bool = False


class Canvases:
    """Textures of canvases, by name; each is uploaded when it has changed."""

    def __init__(self, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)
        self.get, self.release = self._uploads.get, self._uploads.release
        self.begin_frame = self._uploads.begin_frame
        self._put: dict[str, Memo[*tuple[Any, ...], None]] = {}

    def texture(self, name: str, color: Floats, exposure_ev: float) -> moderngl.Texture:
        """Return a texture of linear light (height, width, 3)."""
        put = self._put.setdefault(name, Memo(_put))
        put(self._uploads, name, color, exposure_ev, theme.used())
        texture = self._uploads.get(name)
        assert texture is not None
        return texture


def _put(
    uploads: Uploads, name: str, color: Floats, exposure_ev: float, look: theme.WindowLook
) -> None:
    uploads.put(name, color_picture(color, exposure_ev))


def written(lines: tuple[str, ...], lit: Lit, state: AppState) -> tuple[tuple[str, ...], Lit]:
    """Return a program in the window's language and indexing."""
    indexing = state.options.indexing
    if state.options.language == "python":
        return shown_lines(lines, indexing), lit
    loops = _julia(shown_lines(lines), indexing)
    return loops.lines, {loops.line_of[n]: part for n, part in lit.items()}


@functools.cache
def _julia(lines: tuple[str, ...], indexing: Indexing) -> julia.Loops:
    found = julia.loops("\n".join(lines), indexing)
    return replace(found, lines=tuple(line.replace(" * ", "*") for line in found.lines))


def draw_program(drawn: Drawn, low: ImVec2, room: ImVec2, fonts: Fonts) -> None:
    """Draw a program and its canvas in the middle of an area."""
    em, words = imgui.get_font_size(), drawn.in_words
    lines, font = narrowed(drawn.lines), fonts.text if words else fonts.mono
    with lettering(font):
        needed = code_size(lines) * ImVec2(1.05, 1)  # letter widths are whole pixels in each size
    best = max(
        (
            _arranged(needed, drawn, room, em, *way)
            for way in itertools.product((False, True), LARGEST)
        ),
        key=lambda one: (one.fits, one.larger * one.canvas_px.x),
    )
    total = best.total_px
    spare, canvas_at = total - best.code_px, total - best.canvas_px
    low = low + (room - total) * 0.5
    if best.beside:
        code_at, canvas_at.y = ImVec2(0, 0.5 * spare.y), 0.5 * canvas_at.y
    else:
        code_at, canvas_at.x = ImVec2(0.5 * spare.x, 0), 0.5 * canvas_at.x
        if words:  # as on a slide, they are below the canvas
            code_at.y, canvas_at.y = spare.y, 0
    _canvas(drawn, low + canvas_at, best.unit, fonts)
    imgui.set_cursor_screen_pos(low + code_at)
    flags = imgui.WindowFlags_.horizontal_scrollbar
    imgui.begin_child(f"code at {low.x}, {low.y}", best.code_px, 0, flags)
    with lettering(font, best.larger):
        # In a small window, scroll to the highlighted line.
        lit = max(drawn.lit, default=0) * LINE * imgui.get_font_size()
        imgui.set_scroll_y(max(0.0, lit - 0.5 * best.code_px.y))
        code(lines, drawn.lit, max(best.code_px.x, best.larger * needed.x))
    imgui.end_child()
    imgui.set_cursor_screen_pos(low)
    imgui.dummy(total)


class Arranged(NamedTuple):
    """A program and its canvas, side by side or one above the other.

    fits: True if the code is shown whole. larger: its type size, relative to the window's. unit:
    the side of a canvas pixel. code_px, canvas_px, total_px: the sizes of the code, of the canvas
    with its numbers, and of both.
    """

    beside: bool
    fits: bool
    larger: float
    unit: float
    code_px: ImVec2
    canvas_px: ImVec2
    total_px: ImVec2


def _arranged(
    needed: ImVec2, drawn: Drawn, room: ImVec2, em: float, beside: bool, largest: float
) -> Arranged:
    """Arrange a program, which needs some space, and its canvas."""
    least = LEAST_WORDS if drawn.in_words else 1.0
    most = ImVec2(MOST_CODE * room.x, room.y) if beside else ImVec2(room.x, MOST_CODE * room.y)
    largest = min(most.x / needed.x, most.y / needed.y, largest)
    larger = max(theme.whole_px(largest * em - 0.5) / em, least)
    a = ImVec2(min(larger * needed.x, most.x), min(larger * needed.y, most.y))
    gap, margin = GAP_EM * em, _margin(drawn.size, em)
    beyond = ImVec2(0.25 * em * len(str(drawn.size[0])), 0.5 * em)  # halves of the last numbers
    taken = ImVec2(a.x + gap, 0) if beside else ImVec2(0, a.y + gap)
    unit = canvas_unit(drawn.size, room - taken - margin - beyond)
    b = margin + ImVec2(*drawn.size) * unit + beyond
    total = ImVec2(taken.x + b.x, max(a.y, b.y)) if beside else ImVec2(max(a.x, b.x), taken.y + b.y)
    return Arranged(beside, largest >= least, larger, unit, a, b, total)


def _margin(size: Size, em: float) -> ImVec2:
    """Return the space for the numbers of rows and columns."""
    return ImVec2(0.5 * em * len(str(size[1])) + 0.5 * em, 1.1 * em)


def _canvas(drawn: Drawn, low: ImVec2, unit: float, fonts: Fonts) -> None:
    """Draw a canvas with the numbers of its rows and columns."""
    em, size = imgui.get_font_size(), drawn.size
    corner = low + _margin(size, em)
    draw_canvas(drawn.texture, size, corner, unit, drawn.marks)
    draw, font = imgui.get_window_draw_list(), fonts.mono or imgui.get_font()
    for axis, count in enumerate((size[1], size[0])):
        marked = drawn.marks.pixel[axis] if drawn.marks.pixel else -1
        needed = 0.5 * em * len(str(count)) + 0.15 * em if axis else em
        for number in _numbered(count, marked, needed / unit):
            text = str(number + drawn.base)
            extent, middle = ImVec2(0.5 * em * len(text), em), (number + 0.5) * unit
            at = corner + ImVec2(-0.3 * em - extent.x, middle - 0.5 * em)
            if axis:
                at = corner + ImVec2(middle - 0.5 * extent.x, -1.1 * em)
            if number == marked:  # the mark's yellow is legible on dark only
                draw.add_rect_filled(at, at + extent, theme.u32(theme.MARK), 2.0)
            color = theme.rgb("#000000") if number == marked else theme.TEXT
            draw.add_text(font, em, at, theme.u32(color), text)


def _numbered(count: int, marked: int, needed: float) -> list[int]:
    """Return the rows or columns that get a number: all, or the first, the last and the marked.

    needed: the size of a number, in pixels of the canvas.
    """
    if count <= NUMBERED and needed <= 1:
        return list(range(count))
    ends = [n for n in (0, count - 1) if marked < 0 or abs(n - marked) > needed]
    return [*ends, *([marked] if marked >= 0 else [])]
