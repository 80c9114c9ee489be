"""K, R and t of the camera for the image that is shown: to read in a panel, and to copy.

Pure; the formulas are renderer/intrinsics.py's.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats.entries import ORIGIN_TOLD
from renderer.intrinsics import PixelOrigin

TOLD = "A world point p is seen at the pixel (x, y): (x, y, 1) ~ K (R p + t)"
_DIGITS = 5
_TINY = 1e-12  # of a matrix's largest number: what is left of a 0


class OtherWords(NamedTuple):
    """read: lines of letters of one width. copied: all digits, as programs and Lucida take them."""

    read: tuple[str, ...]
    copied: str


def other_words(camera: Camera, size: Size, origin: PixelOrigin) -> OtherWords:
    """size: (width, height) of the image. Raises LucidaError for a parallel camera."""
    K, R, t = camera.intrinsics(size, origin)
    parts = {"K": _clean(K), "R": _clean(R), "t": _clean(t)[:, None]}
    read = [line for name, part in parts.items() for line in _table(name, part)]
    lines = [
        f"# {TOLD}",
        f"# x to the right, y down, z forward; {ORIGIN_TOLD[origin]}",
        f"width = {size[0]}",
        f"height = {size[1]}",
        f"K = {_clean(K).tolist()}",
        f"R = {R.tolist()}",
        f"t = {t.tolist()}",
    ]
    return OtherWords(tuple(read), "\n".join(lines) + "\n")


def _clean(part: Floats) -> Floats:
    """Without what rounding leaves of zeros, and without their signs."""
    return np.where(np.abs(part) <= _TINY * np.abs(part).max(), 0.0, part)


def _table(name: str, part: Floats) -> list[str]:
    """Rows with the name before the first, each column as wide as it must be."""
    texts = [[f"{value:.{_DIGITS}g}" for value in row] for row in part.tolist()]
    widths = [max(map(len, column)) for column in zip(*texts, strict=True)]
    rows = ["  ".join(map(str.rjust, row, widths)) for row in texts]
    return [f"{name if not number else ' '}  {row}" for number, row in enumerate(rows)]
