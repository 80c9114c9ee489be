"""The image as an array: canvas[i, j], row-major or column-major, and the place of each pixel.

Pixels (i, j) are 0-based, sizes (width, height). A pixel is three numbers of single precision,
adjacent in either order.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.laboratory.light import window
from renderer.camera import Size
from renderer.pixels import Indexing

Order = Literal["row", "column"]
ORDERS: dict[Order, str] = {
    "row": "row-major (C, NumPy)",
    "column": "column-major (Julia, Fortran, MATLAB)",
}
PIXEL_BYTES = 12
Canvas = NDArray[np.float32]


@dataclass(frozen=True)
class Cell:
    """A pixel of the array. label: canvas[i, j], counted as requested. values: as stored."""

    label: str
    i: int
    j: int
    offset_bytes: int
    values: tuple[float, ...]


Table = tuple[tuple[Cell, ...], ...]


def pixel_number(i: int, j: int, size: Size, order: Order) -> int:
    """Return the pixel's number in memory: i W + j, or j H + i."""
    return i * size[0] + j if order == "row" else j * size[1] + i


def cell(canvas: Canvas, i: int, j: int, one_based: bool, order: Order) -> Cell:
    row, column = Indexing(int(one_based)).numbers((i, j))
    number = pixel_number(i, j, (canvas.shape[1], canvas.shape[0]), order)
    values = tuple(canvas[i, j].tolist())
    return Cell(f"canvas[{row}, {column}]", i, j, number * PIXEL_BYTES, values)


def table(
    canvas: Canvas, i: int, j: int, rows: int, columns: int, one_based: bool, order: Order
) -> Table:
    """Return rows of at most rows x columns pixels around (i, j)."""
    first, left, part = window(canvas, i, j, rows, columns)
    return tuple(
        tuple(cell(canvas, first + r, left + c, one_based, order) for c in range(part.shape[1]))
        for r in range(part.shape[0])
    )


def run(
    canvas: Canvas, i: int, j: int, count: int, one_based: bool, order: Order
) -> tuple[Cell, ...]:
    """Return at most `count` pixels around (i, j), one after another in memory."""
    height, width = canvas.shape[:2]
    count = min(count, width * height)
    first = pixel_number(i, j, (width, height), order) - count // 2
    first = min(max(0, first), width * height - count)
    pixels = []
    for number in range(first, first + count):
        across, along = divmod(number, width if order == "row" else height)
        i, j = (across, along) if order == "row" else (along, across)
        pixels.append(cell(canvas, i, j, one_based, order))
    return tuple(pixels)


def place(order: Order, one_based: bool, width: object = "W", height: object = "H") -> str:
    """Return the code of a pixel's number in memory."""
    i, j = ("(i - 1)", "(j - 1)") if one_based else ("i", "j")
    return f"({i} * {width} + {j})" if order == "row" else f"({j} * {height} + {i})"
