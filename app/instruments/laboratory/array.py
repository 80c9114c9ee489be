"""An image as a two-dimensional array, in a program and in memory."""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.outside.figure import Color, Figure

from .page import Page
from .sheet import BLACK, Point, Sheet, between, mixed, reached, rectangle

ROWS, COLUMNS = 3, 4
LIT, ORANGE = (1, 2), (1.0, 0.6, 0.0)  # row and column from 0
CELL, CORNER = 2.8, (8.8, 7.2)
BYTE, MEMORY_Y = 2.45, 20.6
JULIA = ("canvas = zeros(RGB{Float32}, height, width)", "canvas[2, 3] = RGB(1, 0.6, 0)")
NUMPY = ("canvas = np.zeros((3, 4, 3), np.float32)", "canvas[1, 2] = 1, 0.6, 0")


def array(page: Page) -> Figure:
    """Draw an empty canvas. Build 1 lights a cell, build 2 adds the memory as Julia lays it out,
    and build 3 changes to NumPy: rows one after another, counted from 0.
    """
    sheet, look = page.sheet((30, 24.6)), page.look
    lit, stored, numpy = (reached(page.progress, build) for build in (1, 2, 3))
    turns = _turns(numpy)
    for (line, assigned), opacity in zip((JULIA, NUMPY), turns, strict=True):
        code = sheet.part((0.2, 1.2), opacity)
        code.word(line, (0, 0), 1.25, mono=True, align=0.0)
        code.word(assigned, (0, 1.9), 1.25, opacity=lit, mono=True, align=0.0)
    for number, name in enumerate(("height = 3", "width = 4")):
        at = 22.2, 7.6 + 1.9 * number
        sheet.word(name, at, 1.25, look.dim, turns[0], mono=True, align=0.0)
    grid, memory = sheet.part(CORNER), sheet.part((0.3, MEMORY_Y), stored)
    for row, column in np.ndindex(ROWS, COLUMNS):
        color = mixed(BLACK, ORANGE, lit if (row, column) == LIT else 0.0)
        _cell(grid, (CELL * column, CELL * row), CELL, color)
        places = [place(row, column, by_rows) for by_rows in (False, True)]
        at = BYTE * float(between(numpy, places)), 0.0
        _cell(memory, at, BYTE, color)
        texts = f"{row + 1},{column + 1}", f"{row},{column}"
        _number(memory, texts, (at[0] + BYTE / 2, BYTE + 0.9), numpy, look.text)
    for count, marked, first, step in (
        (COLUMNS, LIT[1], (CELL / 2, -0.9), (CELL, 0.0)),
        (ROWS, LIT[0], (-1.0, CELL / 2), (0.0, CELL)),
    ):
        for number in range(count):
            color = mixed(look.dim, look.text, lit if number == marked else 0.0)
            at = first[0] + number * step[0], first[1] + number * step[1]
            _number(grid, (str(number + 1), str(number)), at, numpy, color)
    grid.word("column", (COLUMNS * CELL / 2, -2.4), 1.25, look.dim)
    names = "column after column (Julia)", "row after row (NumPy)"
    for name, opacity in zip(names, turns, strict=True):
        memory.word(f"in memory: {name}", (0, -1.3), 1.25, opacity=opacity, align=0.0)
    _arrows(grid, stored, numpy)
    return sheet.figure()


def place(row: int, column: int, by_rows: bool) -> int:
    """Return a pixel's place in memory, from 0."""
    return row * COLUMNS + column if by_rows else column * ROWS + row


def _cell(sheet: Sheet, at: Point, side: float, color: Color) -> None:
    square = rectangle(at, (side - 0.1, side - 0.1))
    sheet.fill(square, color)
    sheet.outline(square, sheet.look.dim)


def _number(sheet: Sheet, texts: tuple[str, str], at: Point, numpy: float, color: Color) -> None:
    """Write a number as Julia counts it, or as NumPy does."""
    for text, opacity in zip(texts, _turns(numpy), strict=True):
        sheet.word(text, at, 1.25, color, opacity)


def _turns(numpy: float) -> tuple[float, float]:
    """Return the opacities of Julia's and of NumPy's words: one fades before the other appears."""
    return max(0.0, 1 - 2 * numpy), max(0.0, 2 * numpy - 1)


def _arrows(grid: Sheet, stored: float, numpy: float) -> None:
    """Draw arrows along the cells that follow each other in memory."""
    columns, rows = grid.part(opacity=stored * (1 - numpy)), grid.part(opacity=stored * numpy)
    for column in range(COLUMNS):
        x, y = CELL * (column + 0.5), CELL * ROWS + 0.3
        columns.arrow((x, y), (x, y + 1.4), grid.look.ray)
    for row in range(ROWS):
        x, y = CELL * COLUMNS + 0.2, CELL * (row + 0.5)
        rows.arrow((x, y), (x + 1.4, y), grid.look.ray)
