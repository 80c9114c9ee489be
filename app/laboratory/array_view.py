"""The laboratory's page "Array": the cells about a pixel, its program, and its place in memory.

Owns their looks. Which cell lies where is laboratory/memory.py's, the program array_code.py's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from app.explaining.breaking import broken
from app.explaining.languages import LANGUAGES
from app.explaining.symbols import lettered
from app.laboratory import array_code, memory
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import Image
from app.laboratory.pictures import HEADING_EM
from app.state.app_state import AppState
from app.state.options import Language, Pixel
from app.widgets import theme
from app.widgets.areas import press_area
from app.widgets.checks import radio_button
from app.widgets.code import LINE, letters_in
from app.widgets.lettering import fitting_words, lettering
from app.widgets.theme import Fonts
from renderer.images.display import luminance, to_srgb8

CELL_EM = (8.6, 3.9)  # of one pixel of the array
MOST_CELLS = (7, 7)  # columns, rows
ROW_EM = 1.45  # of a pixel in memory
MOST_ROWS = 15
LANGUAGES_EM = 2.2  # the height of the switches over the program


def program_em(state: AppState, size: tuple[int, int], width_px: float) -> float:
    """Return the height of the program of an image, in multiples of the type's size."""
    last = size[1] - 1, size[0] - 1
    lines = _listed(state, state.options.language, size, last, (0.0, 0.0, 0.0))
    letters = letters_in(width_px, imgui.get_font_size())
    return LANGUAGES_EM + LINE * sum(len(broken(line, letters)) for line in lines)


def _listed(
    state: AppState,
    language: Language,
    size: tuple[int, int],
    pixel: Pixel,
    values: tuple[float, ...],
) -> list[str]:
    order, options = state.of(LaboratoryOptions).order, state.options
    lines = array_code.lines(language, order, options.one_based, size, pixel, values)
    return [lettered(line, options.notation) for line in lines]


@dataclass(frozen=True, eq=False)
class ArrayPage:
    """The visible part of an image around a pixel: linear, (H, W, 3), with its extent."""

    state: AppState
    color: Image
    pixel: Pixel
    extent: ImVec2
    fonts: Fonts

    @property
    def size(self) -> tuple[int, int]:
        return self.color.shape[1], self.color.shape[0]

    @property
    def order(self) -> memory.Order:
        return self.state.of(LaboratoryOptions).order

    def table(self) -> memory.Table:
        """Return as much of the array as cells() has room for."""
        em = imgui.get_font_size()
        columns = max(1, min(MOST_CELLS[0], int(self.extent.x / (CELL_EM[0] * em))))
        height = self.extent.y - HEADING_EM * em
        rows = max(1, min(MOST_CELLS[1], int(height / (CELL_EM[1] * em))))
        one_based = self.state.options.one_based
        return memory.table(self.color, *self.pixel, rows, columns, one_based, self.order)

    def cells(self, table: memory.Table, at: ImVec2) -> Pixel | None:
        """Draw the cells: index, values, place in memory. Return the clicked pixel, or None."""
        em = imgui.get_font_size()
        number = memory.place(self.order, self.state.options.one_based, *self.size)
        rule = f"offset = {number} * {memory.PIXEL_BYTES} bytes"
        self._heading(at, "canvas[row, column]", rule)
        width = min(self.extent.x / len(table[0]), 1.5 * CELL_EM[0] * em)
        height = CELL_EM[1] * em
        top, chosen = at.y + HEADING_EM * em, None
        for r, row in enumerate(table):
            for c, cell in enumerate(row):
                corner = ImVec2(at.x + c * width, top + r * height)
                imgui.set_cursor_screen_pos(corner)
                if press_area(f"cell {r} {c}", ImVec2(width - 3, height - 3)):
                    chosen = (cell.i, cell.j)
                self._cell(cell, corner, (width - 3, height - 3))
        return chosen

    def in_memory(self, at: ImVec2) -> Pixel | None:
        """Draw the pixels one after another in memory. Return the clicked one, or None."""
        em, order = imgui.get_font_size(), self.order
        laid = f"{order}-major: {array_code.ONE_AFTER_ANOTHER[order]}; 12 bytes per pixel"
        self._heading(at, "In memory", laid)
        row_px = ROW_EM * em
        room = self.extent.y - HEADING_EM * em
        count = max(1, min(MOST_ROWS, int(room / row_px)))
        found = memory.run(self.color, *self.pixel, count, self.state.options.one_based, order)
        width, chosen = min(self.extent.x, 30 * em), None
        last = f"+{found[-1].offset_bytes}"
        with lettering(self.fonts.mono):
            letter = imgui.calc_text_size("0").x
            for number, cell in enumerate(found):
                corner = ImVec2(at.x, at.y + HEADING_EM * em + number * row_px)
                left = corner.x + (len(last) + 1) * letter
                text = f"+{cell.offset_bytes}".rjust(len(last))
                y = corner.y + 0.5 * (row_px - em)
                draw = imgui.get_window_draw_list()
                draw.add_text(ImVec2(corner.x, y), theme.u32(theme.DIM), text)
                low = ImVec2(left, corner.y)
                far = ImVec2(max(left + 1, at.x + width), corner.y + row_px - 2)
                imgui.set_cursor_screen_pos(corner)
                if press_area(f"byte {number}", ImVec2(width, row_px)):
                    chosen = (cell.i, cell.j)
                ink = self._ground(cell, low, far)
                values = " ".join(f"{value:.2f}" for value in cell.values)
                draw.push_clip_rect(low, far, True)
                draw.add_text(ImVec2(left + 0.5 * em, y), theme.u32(ink), f"{cell.label} {values}")
                draw.pop_clip_rect()
        return chosen

    def program(self, at: ImVec2) -> Language:
        """Draw the same as a program, with a button that copies it. Return the selected
        language.
        """
        em, options = imgui.get_font_size(), self.state.options
        imgui.set_cursor_screen_pos(at)
        imgui.begin_group()
        language: Language = options.language
        for number, (one, title) in enumerate(LANGUAGES.items()):
            if number:
                imgui.same_line(0, 0.7 * em)
            if radio_button(f"{title}##language", one == language):
                language = one
        values = tuple(float(value) for value in self.color[self.pixel])
        listed = _listed(self.state, language, self.size, self.pixel, values)
        imgui.same_line(0, 0.7 * em)
        if imgui.button("Copy"):
            imgui.set_clipboard_text(array_code.program(language, listed))
        imgui.set_item_tooltip("the whole program, which prints the offset")
        imgui.end_group()
        top = at.y + LANGUAGES_EM * em
        draw, letters = imgui.get_window_draw_list(), letters_in(self.extent.x, em)
        rows = [row for line in listed for row in broken(line, letters)]
        with lettering(self.fonts.mono):
            letter = imgui.calc_text_size("0").x
            for number, line in enumerate(rows):
                code, mark, comment = line.partition("#")
                y = top + number * LINE * em
                draw.add_text(ImVec2(at.x, y), theme.u32(theme.TEXT), code)
                after = ImVec2(at.x + len(code) * letter, y)
                draw.add_text(after, theme.u32(theme.DIM), mark + comment)
        return language

    def _heading(self, at: ImVec2, title: str, caption: str) -> None:
        em, draw = imgui.get_font_size(), imgui.get_window_draw_list()
        with lettering(self.fonts.bold):
            draw.add_text(at, theme.u32(theme.TEXT), title)
        with lettering(self.fonts.mono if "=" in caption else None):
            shown = fitting_words(caption, self.extent.x)
            shown = "" if shown.endswith("...") else shown  # half of a formula is none
            draw.add_text(ImVec2(at.x, at.y + 1.15 * em), theme.u32(theme.DIM), shown)

    def _cell(self, cell: memory.Cell, corner: ImVec2, size: tuple[float, float]) -> None:
        em, draw = imgui.get_font_size(), imgui.get_window_draw_list()
        far = ImVec2(corner.x + size[0], corner.y + size[1])
        ink = self._ground(cell, corner, far)
        x, y = corner.x + 0.4 * em, corner.y + 0.25 * em
        draw.push_clip_rect(corner, far, True)
        with lettering(self.fonts.mono):
            draw.add_text(ImVec2(x, y), theme.u32(ink), cell.label)
        with lettering(self.fonts.mono):
            numbers = " ".join(f"{value:.2f}" for value in cell.values)
            draw.add_text(ImVec2(x, y + 1.2 * em), theme.u32(ink), numbers)
            draw.add_text(ImVec2(x, y + 2.25 * em), theme.u32(ink), f"+{cell.offset_bytes} B")
        draw.pop_clip_rect()

    def _ground(self, cell: memory.Cell, low: ImVec2, far: ImVec2) -> ImVec4:
        """Draw a pixel's colour, framed if it is the marked one. Return the colour for text over
        it.
        """
        values = np.asarray(cell.values, np.float32)
        red, green, blue = (float(x) / 255 for x in to_srgb8(values))
        draw = imgui.get_window_draw_list()
        draw.add_rect_filled(low, far, theme.u32(ImVec4(red, green, blue, 1.0)), 3.0)
        if (cell.i, cell.j) == self.pixel:
            draw.add_rect(low, far, theme.u32(theme.rgb("#000000", 0.8)), 3.0, 5.0)
            draw.add_rect(low, far, theme.u32(theme.MARK), 3.0, 3.0)
        light = float(to_srgb8(luminance(values))) / 255 > 0.55
        return theme.rgb("#000000") if light else theme.rgb("#ffffff")
