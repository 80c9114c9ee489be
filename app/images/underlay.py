"""Pictures that stand under ImGui's windows: copied into the window's framebuffer before ImGui
draws over it.

Owns the list of one frame's pictures. Knows nothing of what they show, and of windows.

ImGui draws a picture as a textured, blended rectangle. Where OpenGL runs on the CPU, that takes
longer than everything else that it draws; a copy takes next to nothing. It can be had for whatever
has nothing but the background under it.
"""

from __future__ import annotations

from dataclasses import dataclass

from app.images.shown import Picture
from app.widgets.surface import Target, copy_pixels

Box = tuple[int, int, int, int]  # left, top, right, bottom: framebuffer pixels, row 0 at the top


@dataclass(frozen=True, eq=False)
class _Placed:
    picture: Picture
    box: Box


class Underlay:
    """Of one window, in its context."""

    def __init__(self) -> None:
        self._placed: list[_Placed] = []

    def begin_frame(self) -> None:
        """Once a frame, before anything is put into it."""
        self._placed.clear()

    def put(self, picture: Picture, box: Box) -> None:
        """A picture made for this (see ShownImage.picture), enlarged to the nearest pixel."""
        self._placed.append(_Placed(picture, box))

    def paint(self, target: Target) -> None:
        """Copies what was put into it since the frame's beginning; leaves the target bound."""
        height = target.size[1]
        for placed in self._placed:
            left, top, right, bottom = placed.box
            size = placed.picture.texture.size
            source = placed.picture.framebuffer.glo, (0, 0, *size)
            box = left, height - bottom, right, height - top
            copy_pixels(*source, target.framebuffer.glo, box)
        target.framebuffer.use()
