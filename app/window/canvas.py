"""An offscreen target for the window's frames, of which only the finished ones are shown.

ImGui hides its windows for some frames while they move. Those frames are drawn offscreen, and the
last picture stays. On the null platform the window's own framebuffer keeps its initial size, at
most that of an imaginary monitor of 1920 x 1080; a canvas may have any size.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np

from lucida.renderer.raster.resources import new_texture

MOST_KEPT = 30  # frames in a row that are not shown, so that an error cannot freeze the window
Size = tuple[int, int]


@dataclass(frozen=True)
class Target:
    """A framebuffer for a frame. size: (width, height) in pixels."""

    framebuffer: moderngl.Framebuffer
    size: tuple[int, int]

    def read(self) -> np.ndarray:
        """Return the drawn pixels, uint8 (height, width, 3), row 0 at the top. Call before the
        swap.
        """
        width, height = self.size
        data = self.framebuffer.read((0, 0, width, height), components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]


class WindowCanvas:
    """The canvas of one window, in its context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._shown: moderngl.Framebuffer | None = None
        self._beside: moderngl.Framebuffer | None = None  # for frames that are not shown
        self._kept = 0
        self.keeps = False

    def bind(self, size: Size, unfinished: bool) -> Target:
        """Bind the frame's target. Call before ImGui draws.

        size: (width, height) of the frame, in pixels. unfinished: True to keep showing the last
        picture if that has the same size.
        """
        fits = self._shown is None or self._shown.size == size
        self.keeps = unfinished and fits and self._kept < MOST_KEPT
        self._kept = self._kept + 1 if unfinished else 0
        if self.keeps:
            self._beside = self._sized(self._beside, size)
            drawn = self._beside
        else:
            self._shown = self._sized(self._shown, size)
            drawn = self._shown
            if self._beside is not None:
                _release(self._beside)
                self._beside = None
        drawn.use()
        return Target(drawn, size)

    @property
    def shown(self) -> Target | None:
        """The picture that the window shows; None before there is one."""
        return Target(self._shown, self._shown.size) if self._shown is not None else None

    def show(self, in_window: bool) -> None:
        """Copy the picture into the window, for the swap, or bind it to be read."""
        if self._shown is None:
            return
        if in_window:
            self._context.copy_framebuffer(self._context.screen, self._shown)
        else:
            self._shown.use()

    def _sized(self, old: moderngl.Framebuffer | None, size: Size) -> moderngl.Framebuffer:
        if old is not None and old.size == size:
            return old
        new = self._context.framebuffer([new_texture(self._context, size, 4, "uint8")])
        new.use()
        # Release it last, because moderngl binds it again while creating the new one.
        if old is not None:
            _release(old)
        return new


def _release(target: moderngl.Framebuffer) -> None:
    for part in (*target.color_attachments, target):
        part.release()
