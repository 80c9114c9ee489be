"""The image as an array: canvas[i, j], row-major order, and where each number lies in memory.

Owns indices and offsets. Knows nothing of how a table is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.teach.imagelab.light import window
from renderer.pixels import Indexing


@dataclass(frozen=True)
class Cell:
    """One pixel of the array. label: canvas[i, j] in the notation that was asked for. index: the
    pixel's number in row-major order, 0-based. offset_bytes: of its first channel. values: as
    stored."""

    label: str
    i: int
    j: int
    index: int
    offset_bytes: int
    values: tuple[float, ...]


@dataclass(frozen=True)
class Table:
    """A window of the array. i, j: of its first cell, 0-based. rows: its cells. one_based: the
    notation of the labels. itemsize: bytes a number. stride_bytes: from a pixel to the one on its
    right, and to the one below."""

    i: int
    j: int
    rows: tuple[tuple[Cell, ...], ...]
    one_based: bool
    itemsize: int
    stride_bytes: tuple[int, int]


def offset_bytes(
    i: int, j: int, channel: int, width: int, channels: int = 3, itemsize: int = 4
) -> int:
    """Where the number of a channel of pixel (i, j), all 0-based, lies from the array's beginning.

    Row-major: ((i W + j) channels + channel) itemsize, here 3 channels of 4 bytes.
    """
    return ((i * width + j) * channels + channel) * itemsize


def label(i: int, j: int, one_based: bool, name: str = "canvas") -> str:
    """canvas[i, j] of the 0-based pixel (i, j): row first, then column."""
    row, column = Indexing(int(one_based)).numbers((i, j))
    return f"{name}[{row}, {column}]"


def table(
    canvas: NDArray, i: int, j: int, rows: int, columns: int, one_based: bool = True
) -> Table:
    """The window of at most rows x columns pixels about (i, j), 0-based, of an array (H, W, 3), or
    (H, W) for one number a pixel."""
    width = canvas.shape[1]
    channels = canvas.shape[2] if canvas.ndim == 3 else 1
    size = canvas.dtype.itemsize
    first, left, part = window(canvas, i, j, rows, columns)
    cells = tuple(
        tuple(
            Cell(
                label(row, column, one_based),
                row,
                column,
                row * width + column,
                offset_bytes(row, column, 0, width, channels, size),
                tuple(float(x) for x in np.atleast_1d(part[row - first, column - left])),
            )
            for column in range(left, left + part.shape[1])
        )
        for row in range(first, first + part.shape[0])
    )
    strides = (channels * size, channels * size * width)
    return Table(first, left, cells, one_based, size, strides)


def formula(width: int, channels: int = 3, itemsize: int = 4, one_based: bool = True) -> str:
    """The rule of the offsets in words of code, with this image's numbers."""
    pixel = f"((i - 1) * {width} + (j - 1))" if one_based else f"(i * {width} + j)"
    if channels == 1:
        return f"offset = {pixel} * {itemsize} bytes"
    return f"offset = ({pixel} * {channels} + channel) * {itemsize} bytes"
