"""Colours of displays: three projectors whose light adds up, and test pictures.

Pictures in, pictures out; knows no window.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.images.display import Bytes, to_srgb8

Offset = tuple[int, int]  # rows down, columns to the right

# Where red, green and blue stand when they are moved apart by 1: an upright triangle.
APART = ((-1.0, 0.0), (0.5, -0.866), (0.5, 0.866))
CHANNELS = ("red", "green", "blue")
BARS = ((1, 1, 1), (1, 1, 0), (0, 1, 1), (0, 1, 0), (1, 0, 1), (1, 0, 0), (0, 0, 1), (0, 0, 0))


def triangle(distance_px: float) -> tuple[Offset, Offset, Offset]:
    """Offsets of the three pictures, each `distance_px` from the middle; 0: all aligned."""
    red, green, blue = ((round(r * distance_px), round(c * distance_px)) for r, c in APART)
    return red, green, blue


def projected(
    color: ArrayLike, offsets: tuple[Offset, Offset, Offset], exposure_ev: float = 0.0
) -> Bytes:
    """Return the wall: three single-colour pictures, moved apart, whose light adds up.

    color: linear, (H, W, 3). Returns uint8 (H + rows, W + columns, 3), as large as the three
    pictures together reach; dark where none falls.
    """
    linear = np.asarray(color, np.float32)
    height, width = linear.shape[:2]
    rows = [row for row, _ in offsets]
    columns = [column for _, column in offsets]
    shape = (height + max(rows) - min(rows), width + max(columns) - min(columns), 3)
    wall = np.zeros(shape, np.float32)
    for channel, (row, column) in enumerate(offsets):
        top, left = row - min(rows), column - min(columns)
        wall[top : top + height, left : left + width, channel] = linear[..., channel]
    return to_srgb8(wall, exposure_ev)


def magnified(picture: Bytes, side: int) -> Bytes:
    """Each pixel of a picture (H, W, 3) as side x side equal ones."""
    return np.repeat(np.repeat(picture, side, axis=0), side, axis=1)


def window(image: NDArray, i: int, j: int, rows: int, columns: int) -> tuple[int, int, NDArray]:
    """Return at most rows x columns pixels of an image around pixel (i, j), 0-based, moved inside
    it.

    Returns the window's first row and column, and a view of its pixels.
    """
    height, width = image.shape[:2]
    first = min(max(0, i - rows // 2), max(0, height - rows))
    left = min(max(0, j - columns // 2), max(0, width - columns))
    return first, left, image[first : first + rows, left : left + columns]


def bars(rows: int, columns: int) -> NDArray[np.float32]:
    """A test picture (rows, columns, 3), linear: white, yellow, cyan, green, magenta, red, blue,
    black side by side; below, grays from black to white."""
    across = np.arange(columns)
    picture = np.tile(np.array(BARS, np.float32)[across * len(BARS) // columns], (rows, 1, 1))
    ramp = np.linspace(0, 1, columns, dtype=np.float32)
    picture[rows - rows // 4 :] = ramp[:, None]
    return picture


def disc(rows: int, columns: int) -> NDArray[np.float32]:
    """A test picture (rows, columns, 3), linear: a white disc, as large as fits."""
    i, j = np.ogrid[:rows, :columns]
    away = np.hypot(i + 0.5 - rows / 2, j + 0.5 - columns / 2)
    white = (away < min(rows, columns) / 2).astype(np.float32)
    return np.repeat(white[..., None], 3, axis=2)
