"""Draws the floor of the built-in lecture, app/lecture/lectures/tiles.png: tiles with fine lines.

.venv/bin/python docs/draw_tiles.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

OUT = Path(__file__).parents[1] / "app" / "lecture" / "lectures" / "tiles.png"
SIDE = 128  # texels; a quarter of it is a tile
LIGHT, DARK, JOINT, LINE = (226, 216, 196), (52, 78, 104), (30, 28, 26), (196, 84, 36)


def tiles() -> np.ndarray:
    """uint8 (SIDE, SIDE, 3): light and dark tiles in turn, dark joints, a thin frame in each."""
    row, column = np.mgrid[:SIDE, :SIDE]
    tile = SIDE // 4
    is_dark = (row // tile + column // tile) % 2 == 1
    image = np.where(is_dark[..., None], np.uint8(DARK), np.uint8(LIGHT))
    to_edge = np.minimum.reduce([row % tile, column % tile])
    to_edge = np.minimum(to_edge, tile - 1 - np.maximum(row % tile, column % tile))
    image[(to_edge >= 6) & (to_edge < 8)] = LINE
    image[to_edge < 1] = JOINT
    return image


if __name__ == "__main__":
    Image.fromarray(tiles()).save(OUT, optimize=True)
