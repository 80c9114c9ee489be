"""The image as an array: canvas[i, j], row-major or column-major, and where each number lies.

Owns indices and offsets. Knows nothing of how a table is drawn. Pixels (i, j) are 0-based, sizes
(width, height); a pixel's channels lie side by side in either order.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.laboratory.light import window
from renderer.pixels import Indexing

Order = Literal["row", "column"]
ORDERS: dict[Order, str] = {
    "row": "row-major (C, NumPy)",
    "column": "column-major (Julia, Fortran, MATLAB)",
}
Size = tuple[int, int]


@dataclass(frozen=True)
class Cell:
    """One pixel of the array. label: canvas[i, j] in the notation that was asked for. index: the
    pixel's number in memory, 0-based. offset_bytes: of its first channel. values: as stored."""

    label: str
    i: int
    j: int
    index: int
    offset_bytes: int
    values: tuple[float, ...]


@dataclass(frozen=True)
class ArrayWindow:
    """A window of the array. i, j: of its first cell, 0-based. rows: its cells. one_based: the
    notation of the labels. itemsize: bytes a number."""

    i: int
    j: int
    rows: tuple[tuple[Cell, ...], ...]
    one_based: bool
    itemsize: int


def pixel_number(i: int, j: int, size: Size, order: Order = "row") -> int:
    """The pixel's number in memory: i W + j, or j H + i."""
    width, height = size
    return i * width + j if order == "row" else j * height + i


def pixel_at(number: int, size: Size, order: Order = "row") -> tuple[int, int]:
    """The pixel (i, j) of a number."""
    width, height = size
    if order == "row":
        return number // width, number % width
    return number % height, number // height


def offset_bytes(
    i: int,
    j: int,
    channel: int,
    size: Size,
    order: Order = "row",
    channels: int = 3,
    itemsize: int = 4,
) -> int:
    """Return the offset of a channel of pixel (i, j) from the array's beginning."""
    return (pixel_number(i, j, size, order) * channels + channel) * itemsize


def label(i: int, j: int, one_based: bool, name: str = "canvas") -> str:
    """canvas[i, j] of the 0-based pixel (i, j): row first, then column."""
    row, column = Indexing(int(one_based)).numbers((i, j))
    return f"{name}[{row}, {column}]"


def cell(canvas: NDArray, i: int, j: int, order: Order, one_based: bool) -> Cell:
    """A pixel of an array (H, W, 3), or (H, W) for one number per pixel."""
    size = canvas.shape[1], canvas.shape[0]
    channels = canvas.shape[2] if canvas.ndim == 3 else 1
    return Cell(
        label(i, j, one_based),
        i,
        j,
        pixel_number(i, j, size, order),
        offset_bytes(i, j, 0, size, order, channels, canvas.dtype.itemsize),
        tuple(float(x) for x in np.atleast_1d(canvas[i, j])),
    )


def table(
    canvas: NDArray,
    i: int,
    j: int,
    rows: int,
    columns: int,
    one_based: bool = True,
    order: Order = "row",
) -> ArrayWindow:
    """The window of at most rows x columns pixels about (i, j) of an array as in cell()."""
    first, left, part = window(canvas, i, j, rows, columns)
    cells = tuple(
        tuple(
            cell(canvas, row, column, order, one_based)
            for column in range(left, left + part.shape[1])
        )
        for row in range(first, first + part.shape[0])
    )
    return ArrayWindow(first, left, cells, one_based, canvas.dtype.itemsize)


def run(
    canvas: NDArray, i: int, j: int, count: int, one_based: bool = True, order: Order = "row"
) -> tuple[Cell, ...]:
    """At most `count` pixels one after another in memory about (i, j), of an array as in cell()."""
    height, width = canvas.shape[:2]
    size, count = (width, height), min(count, width * height)
    first = pixel_number(i, j, size, order) - count // 2
    first = min(max(0, first), width * height - count)
    return tuple(
        cell(canvas, *pixel_at(number, size, order), order, one_based)
        for number in range(first, first + count)
    )


def formula(size: Size, order: Order = "row", one_based: bool = True, pixel_bytes: int = 12) -> str:
    """The rule of a pixel's offset, with this image's numbers."""
    i, j = ("(i - 1)", "(j - 1)") if one_based else ("i", "j")
    number = f"{i} * {size[0]} + {j}" if order == "row" else f"{j} * {size[1]} + {i}"
    return f"offset = ({number}) * {pixel_bytes} bytes"
