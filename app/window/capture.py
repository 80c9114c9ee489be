"""Unused file names for pictures of the window, and parts of such pictures."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

Rect = tuple[float, float, float, float]  # left, top, right, bottom


def free_path(path: Path) -> Path:
    """Return the path, or the first free one with a number from 2 on: lucida.png, lucida-2.png."""
    found, number = path, 2
    while os.path.lexists(found):
        found = path.with_name(f"{path.stem}-{number}{path.suffix}")
        number += 1
    return found


def cut(pixels: np.ndarray, rect: Rect) -> np.ndarray:
    """Cut out a part of a picture, uint8 (height, width, 3), of at least one pixel."""
    height, width = pixels.shape[:2]
    left, right = (min(max(round(x), 0), width) for x in (rect[0], rect[2]))
    top, bottom = (min(max(round(y), 0), height) for y in (rect[1], rect[3]))
    left, top = min(left, width - 1), min(top, height - 1)
    return pixels[top : max(bottom, top + 1), left : max(right, left + 1)]
