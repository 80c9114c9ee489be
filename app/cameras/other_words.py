"""K, R and t of the camera for the current image, to read in a panel and to copy.

Pure; the formulas are renderer/camera/intrinsics.py's.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.files.cameras.entries import ORIGIN_TOLD
from lucida.renderer.scene.model import View

TOLD = "A world point p is seen at the pixel (x, y): (x, y, 1) ~ K (R p + t)"
_DIGITS, _GIVEN_DIGITS = 5, 8
_TINY = 1e-12  # relative to a matrix's largest number: smaller ones are rounding


class OtherWords(NamedTuple):
    """K, R and t as text. read: lines for a fixed-width font. copied: a text with all digits, in
    the form that programs and Lucida read.
    """

    read: tuple[str, ...]
    copied: str


def other_words(view: View, size: Size, origin: PixelOrigin) -> OtherWords:
    """Return K, R and t of the current image. If the camera was given for an image of another size,
    put K of that image before them.

    size: (width, height) of the current image. Raises LucidaError for a parallel camera.
    """
    camera = view.for_size(view.own_size or size)
    K, R, t = view.for_size(size).intrinsics(size, origin)
    shown, given = f"in this image, {size[0]} x {size[1]}", view.own_size or size
    tables, note = [*_table("K", _clean(K))], []
    if given != size:
        note = [f"# {shown}: K is {_clean(K).tolist()}"]
        K = view.for_size(given).intrinsics(given, origin).K
        own = f"as it was given, for {given[0]} x {given[1]}"
        tables = [own, *_table("K", _clean(K), _GIVEN_DIGITS), shown, *tables]
    for name, part in (("R", R), ("t", t[:, None])):
        tables += _table(name, _clean(part))
    lines = [
        f"# {TOLD}",
        f"# x to the right, y down, z forward; {ORIGIN_TOLD[origin]}",
        f"width = {given[0]}",
        f"height = {given[1]}",
        f"K = {_clean(K).tolist()}",
        f"# in an image of the same shape, of any size W x H: K is {of_any_size(camera, origin)}",
        *note,
        f"R = {R.tolist()}",
        f"t = {t.tolist()}",
    ]
    return OtherWords(tuple(tables), "\n".join(lines) + "\n")


def of_any_size(camera: Camera, origin: PixelOrigin) -> str:
    """Return K as a formula of an image's width W and height H, if its viewport stays. Raises
    LucidaError for a parallel camera.
    """
    K = _clean(camera.intrinsics((1, 1), "corner").K)
    half = " - 0.5" if origin == "center" else ""
    (fx, skew, cx), (_, fy, cy) = ([f"{value:.{_GIVEN_DIGITS}g}" for value in row] for row in K[:2])
    s = "0" if skew == "0" else f"{skew} W"
    return f"[[{fx} W, {s}, {cx} W{half}], [0, {fy} H, {cy} H{half}], [0, 0, 1]]"


def _clean(part: Floats) -> Floats:
    """Replace rounding errors by zeros, without signs."""
    return np.where(np.abs(part) <= _TINY * np.abs(part).max(), 0.0, part)


def _table(name: str, part: Floats, digits: int = _DIGITS) -> list[str]:
    """Return rows with the name before the first, each column as narrow as possible."""
    texts = [[f"{value:.{digits}g}" for value in row] for row in part.tolist()]
    widths = [max(map(len, column)) for column in zip(*texts, strict=True)]
    rows = ["  ".join(map(str.rjust, row, widths)) for row in texts]
    return [f"{name if not number else ' '}  {row}" for number, row in enumerate(rows)]
