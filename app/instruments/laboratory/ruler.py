"""From a pixel's numbers to its (u, v): rulers along a row and a column of pixels."""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.outside.figure import Color, Figure
from lucida.renderer.camera.checks import Floats

from .page import Page
from .sheet import BLACK, YELLOW, Point, Sheet, between, mixed, reached

COUNT = 10  # pixels in a row, and in a column
PIXEL = (3, 7)  # row and column, from 1
CELL, CORNER = 1.3, np.array((16.2, 2.9))
ROW_Y = 10.4  # the y of the row of pixels before it moves into its image
ACROSS = ("j - 0.5", "/ W", "- 0.5 = u")
DOWN = ("i - 0.5", "/ H", "- 0.5", "v")
TEXT = 1.22


def numbers(pixel: int) -> list[tuple[float, float, float]]:
    """Return the numbers on each ruler: at its beginning, at a pixel's centre, and at its end.

    pixel: its number, from 1.
    """
    at = pixel - 0.5
    return [(0.0, at, COUNT), (0.0, at / COUNT, 1.0), (-0.5, at / COUNT - 0.5, 0.5)]


def ruler(page: Page) -> Figure:
    """Draw a row of pixels. Builds 1, 2 and 3 lead to u; build 4 does the same with a column."""
    down, look = reached(page.progress, 4), page.look
    extent = between(down, [(22.4, 15.2), (31.1, 26.4)])
    sheet = page.sheet((extent[0], extent[1]), between(down, [(8.8, 11.2), (0.0, 0.0)]))
    sheet = sheet.part(CORNER)
    image, row_y = sheet.part(opacity=down), float(between(down, (ROW_Y, CELL * (PIXEL[0] - 1))))
    row, names = sheet.part((0.0, row_y)), sheet.part((0.0, (1 - down) * ROW_Y))
    for i, j in np.ndindex(COUNT, COUNT):
        image.outline(_square(i, j), look.line, 0.05)
    for number in range(COUNT):
        is_marked = number == PIXEL[1] - 1
        _cell(row, _square(0, number), is_marked, reached(page.progress, 1))
        _name(names, number, (CELL * (number + 0.5), -0.8), is_marked)
        is_marked = number == PIXEL[0] - 1
        if down:
            _cell(image, _square(number, PIXEL[1] - 1), is_marked, 1.0)
        _name(image, number, (-0.8, CELL * (number + 0.5)), is_marked)
    names.word("j", (CELL * COUNT + 0.9, -0.8), TEXT, look.dim)
    image.word("i", (-0.8, -0.6), TEXT, look.dim)
    _across(sheet, page.progress, row_y + CELL / 2)
    _down(image)
    return sheet.figure()


def _across(sheet: Sheet, progress: float, row_y: float) -> None:
    """Draw the rulers below the row, and the lines that connect them."""
    x, look = CELL * (PIXEL[1] - 0.5), sheet.look
    for number, (name, values) in enumerate(zip(ACROSS, numbers(PIXEL[1]), strict=True)):
        y = 14.3 + 3.2 * number
        part = sheet.part(opacity=reached(progress, number + 1))
        color = look.u if number == 2 else look.text
        start = y - 1.4 if number else row_y
        part.line([(x, start), (x, y)], look.mark, 0.14, dashed=not number)
        _ticks(part, (0.0, y), (CELL, 0.0), color)
        part.disc((x, y), 0.3, look.mark)
        for value, at in zip(values, (0.0, x, CELL * COUNT), strict=True):
            part.word(short(value), (at, y + 1.1), TEXT, color, strong=at == x)
        part.word(name, (-1.2, y), TEXT, color, align=1.0)


def _down(sheet: Sheet) -> None:
    """Draw the rulers of the column, from right to left."""
    y, look, (*rulers, last) = CELL * (PIXEL[0] - 0.5), sheet.look, numbers(PIXEL[0])
    upward = -last[0], -last[1], -last[2]
    for number, (name, values) in enumerate(zip(DOWN, (*rulers, last, upward), strict=True)):
        x, color = -2.9 - 3.45 * number, look.v if number == 3 else look.text
        _ticks(sheet, (x, 0.0), (0.0, CELL), color)
        sheet.disc((x, y), 0.3, look.mark)
        for value, at in zip(values, (0.0, y, CELL * COUNT), strict=True):
            sheet.word(short(value), (x - 0.45, at), TEXT, color, strong=at == y, align=1.0)
        sheet.word(name, (x, -1.6), TEXT, color)


def _ticks(sheet: Sheet, first: Point, step: Point, color: Color) -> None:
    """Draw a ruler with a tick at each edge of a pixel."""
    start, way = np.array(first), np.array(step)
    across = 0.25 * way[::-1] / CELL
    sheet.line([start, start + COUNT * way], color, 0.12)
    for tick in start + np.arange(COUNT + 1)[:, None] * way:
        sheet.line([tick - across, tick + across], color, 0.08)


def _square(i: int, j: int) -> Floats:
    """Return the corners of a pixel, relative to the image's corner."""
    return CELL * np.array([(j, i), (j + 1, i), (j + 1, i + 1), (j, i + 1)], float)


def _cell(sheet: Sheet, corners: Floats, is_marked: bool, dotted: float) -> None:
    """Draw a pixel, and its centre."""
    sheet.shape(corners, YELLOW if is_marked else sheet.look.fill, 0.07)
    sheet.disc(corners.mean(axis=0), 0.16, BLACK if is_marked else sheet.look.text, dotted)


def _name(sheet: Sheet, number: int, at: Point, is_marked: bool) -> None:
    """Write a pixel's number."""
    color = sheet.look.text if is_marked else mixed(sheet.look.dim, sheet.look.ground, 0.2)
    sheet.word(str(number + 1), at, TEXT, color, strong=is_marked)


def short(value: float) -> str:
    """Return a number with at most two decimals."""
    return f"{value:.2f}".rstrip("0").rstrip(".")
