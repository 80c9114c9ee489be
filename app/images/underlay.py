"""Pictures and plain grounds under ImGui's windows, put into the framebuffer before ImGui draws.

ImGui draws a picture, and a ground too, as a textured, blended rectangle. Where OpenGL runs on the
CPU, that takes longer than everything else that it draws. A copy takes next to nothing, and so does
clearing a part. Both work for whatever has only the background under it. An enlarged picture is
drawn: OpenGL's own enlarging copy takes three times as long.
"""

from __future__ import annotations

import moderngl

from app.images.shown import Picture
from app.widgets.surface import Target, copy_pixels
from renderer.raster.programs import set_uniform
from renderer.raster.resources import Owner
from renderer.raster.screen_pass import new_array

Box = tuple[int, int, int, int]  # left, top, right, bottom: framebuffer pixels, row 0 at the top
Rgb = tuple[float, float, float]


class Underlay:
    """The underlay of one window, in its context."""

    def __init__(self) -> None:
        self._placed: list[tuple[Picture, Box]] = []
        self.grounds: list[tuple[Box, Rgb]] = []
        self._owner = Owner()
        self._enlarge: moderngl.VertexArray | None = None  # compiled on first use

    def begin_frame(self) -> None:
        """Once a frame, before anything is put into it."""
        self._placed.clear()
        self.grounds.clear()

    def fill(self, box: Box, color: Rgb) -> None:
        """A window's ground, under all pictures."""
        self.grounds.append((box, color))

    def put(self, picture: Picture, box: Box) -> None:
        """A picture made for this (see ShownImage.picture), enlarged to the nearest pixel."""
        self._placed.append((picture, box))

    def paint(self, target: Target) -> None:
        """Draws what was put into it since the frame's beginning; leaves the target bound."""
        width, height = target.size
        for (left, top, right, bottom), color in self.grounds:
            left, top = max(left, 0), max(top, 0)
            right, bottom = min(right, width), min(bottom, height)
            if left < right and top < bottom:
                part = left, height - bottom, right - left, bottom - top
                target.framebuffer.clear(*color, 1.0, viewport=part)
        for picture, (left, top, right, bottom) in self._placed:
            size = right - left, bottom - top
            if picture.texture.size == size:
                box = left, height - bottom, right, height - top
                source = picture.framebuffer.glo, (0, 0, *size)
                copy_pixels(*source, target.framebuffer.glo, box)
            else:
                self._enlarged(picture.texture, target, (left, height - bottom, *size))
        target.framebuffer.use()

    def _enlarged(
        self, picture: moderngl.Texture, target: Target, viewport: tuple[int, int, int, int]
    ) -> None:
        """Draws all of a picture into a viewport, to the nearest pixel."""
        gl, framebuffer = picture.ctx, target.framebuffer
        if self._enlarge is None:
            self._enlarge = new_array(self._owner, gl, "picture.vert", "picture.frag")
        gl.enable_only(moderngl.NOTHING)
        gl.clear_samplers(0, 1)
        picture.use(0)
        set_uniform(self._enlarge.program, "picture", 0)
        framebuffer.viewport = viewport
        framebuffer.use()
        self._enlarge.render(moderngl.TRIANGLES, vertices=6)
        framebuffer.viewport = 0, 0, *target.size

    def release(self) -> None:
        self._owner.release()
        self._enlarge = None
