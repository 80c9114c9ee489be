"""The marked pixel, while the images change their size.

Owns the rule: the mark keeps its place on the image plane, and so its viewing ray, as nearly as a
pixel can; beyond the image's edge, it is the nearest pixel. It is always found from where the user
has put it, so that many changes (a window that is being resized) do not carry it away.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.state.options import Pixel
from renderer.scene.model import View

Size = tuple[int, int]  # (width, height)


@dataclass(frozen=True)
class Anchor:
    """pixel, size: what was marked, in an image of which size; it may lie outside. now: where that
    is, in an image of the size now_size."""

    pixel: Pixel
    size: Size
    now: Pixel
    now_size: Size


def followed(
    marked: Pixel | None, anchor: Anchor | None, view: View, size: Size
) -> tuple[Pixel | None, Anchor | None]:
    """The mark in an image of `size`, and its anchor. A mark that is not where the anchor has put
    it was set anew, in the image as it is now."""
    if marked is None:
        return None, None
    if anchor is None or anchor.now != marked:
        now = _inside(marked, size)
        return now, Anchor(marked, size, now, size)
    if anchor.now_size == size:
        return marked, anchor
    now = moved(anchor.pixel, anchor.size, view, size)
    return now, Anchor(anchor.pixel, anchor.size, now, size)


def moved(pixel: Pixel, size: Size, view: View, new_size: Size) -> Pixel:
    """The pixel of an image of new_size that the viewing ray of a pixel of another size goes
    through; the nearest where none does."""
    if size == new_size:
        return pixel
    x, y = view.for_size(size).image_point(*pixel, size)
    left, right, bottom, top = view.for_size(new_size).viewport
    column = math.floor((float(x) - left) / (right - left) * new_size[0])
    row = math.floor((top - float(y)) / (top - bottom) * new_size[1])
    return _inside((row, column), new_size)


def _inside(pixel: Pixel, size: Size) -> Pixel:
    return min(max(pixel[0], 0), size[1] - 1), min(max(pixel[1], 0), size[0] - 1)
