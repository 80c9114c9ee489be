"""Keep the marked pixel when the images change their size.

The mark keeps its place on the image plane, and therefore its viewing ray, as closely as a pixel
can. Beyond the image's edge, it is the nearest pixel. It is always derived from the user's mark, so
that it does not drift while a window is resized.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.model import View


@dataclass(frozen=True)
class Anchor:
    """A mark as the user set it.

    pixel, size: the marked pixel, perhaps outside, and the size of its image. now: the same place
    in an image of the size now_size.
    """

    pixel: Pixel
    size: Size
    now: Pixel
    now_size: Size

    def is_of(self, marked: Pixel | None, marked_size: Size | None) -> bool:
        """Return True if a mark is still where this anchor has put it."""
        return (self.now, self.now_size) == (marked, marked_size)


def followed(
    marked: Pixel | None, marked_size: Size | None, anchor: Anchor | None, view: View, size: Size
) -> tuple[Pixel | None, Anchor | None]:
    """Return the mark in an image of `size`, and its anchor. marked_size: of the image in which it
    was set; None for the present one. A mark that differs from the anchor's was set again, or comes
    from a session or from undo.
    """
    if marked is None:
        return None, None
    if anchor is None or not anchor.is_of(marked, marked_size):
        own = marked_size or size
        anchor = Anchor(marked, own, _inside(marked, own), own)
    if anchor.now_size != size:
        now = moved(anchor.pixel, anchor.size, view, size)
        anchor = Anchor(anchor.pixel, anchor.size, now, size)
    return anchor.now, anchor


def moved(pixel: Pixel, size: Size, view: View, new_size: Size) -> Pixel:
    """Return the pixel of an image of new_size with the viewing ray of a pixel at another size, or
    the nearest one.
    """
    if size == new_size:
        return pixel
    x, y = view.for_size(size).image_point(*pixel, size)
    left, right, bottom, top = view.for_size(new_size).viewport
    column = math.floor((float(x) - left) / (right - left) * new_size[0])
    row = math.floor((top - float(y)) / (top - bottom) * new_size[1])
    return _inside((row, column), new_size)


def _inside(pixel: Pixel, size: Size) -> Pixel:
    return min(max(pixel[0], 0), size[1] - 1), min(max(pixel[1], 0), size[0] - 1)
