"""One image on its way to the screen: linear light, display transform, the size it is shown at.

Owns the last two steps and their textures; redoes them only when something has changed. Knows
nothing of where the image comes from.

ImGui samples every texture linearly. A picture of the very size that it has on the screen comes
out exact, so that enlarged pixels are squares and nothing is blurred.
"""

from __future__ import annotations

import moderngl
from numpy import float32
from numpy.typing import NDArray

from renderer.raster import Display
from renderer.raster.resources import new_texture
from renderer.raster.sources import link


class ShownImage:
    """An image in a context, which must be current in every call. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        # A Display of its own: each keeps only the pictures that were drawn last.
        self._display, self._magnifier = Display(context), Magnifier(context)
        self._linear: moderngl.Texture | None = None
        self._made: tuple[float, tuple[int, int]] | None = None
        self._texture: moderngl.Texture | None = None

    def set_linear(self, texture: moderngl.Texture | None) -> None:
        """The image, in linear light: the caller's texture, or nothing."""
        self._linear, self._made, self._texture = texture, None, None

    def upload(self, color: NDArray[float32]) -> None:
        """The image as an array, float32 (height, width, 3), linear light."""
        self.set_linear(None)
        self.set_linear(self._display.upload(color))

    def texture(self, exposure_ev: float, size_px: tuple[int, int]) -> moderngl.Texture | None:
        """What to show at (width, height) framebuffer pixels; None without an image."""
        if self._linear is not None and self._made != (exposure_ev, size_px):
            picture = self._display.draw(self._linear, exposure_ev)
            self._texture = self._magnifier.show(picture, size_px)
            self._made = exposure_ev, size_px
        return self._texture

    def release(self) -> None:
        self.set_linear(None)
        self._magnifier.release()
        self._display.release()


class Magnifier:
    """Shows one picture in a context, which must be current in every call."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._program = link(context, "screen.vert", "magnify.frag")
        self._screen = context.vertex_array(self._program, [])
        self._target: tuple[moderngl.Texture, moderngl.Framebuffer] | None = None

    def show(self, picture: moderngl.Texture, size_px: tuple[int, int]) -> moderngl.Texture:
        """The picture at (width, height) framebuffer pixels; itself if it has that size.

        The texture is drawn over by the next call. Raises LucidaError where there is no memory.
        """
        if picture.size == size_px:
            return picture
        gl = self._gl
        texture, framebuffer = self._of_size(size_px)
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.NOTHING)
            gl.clear_samplers(0, 1)
            framebuffer.use()
            picture.use(0)
            self._program["picture"] = 0
            self._program["window_depth"] = 0.5
            self._program["texels_per_pixel"] = (
                picture.width / size_px[0],
                picture.height / size_px[1],
            )
            self._screen.render(moderngl.TRIANGLES, vertices=3)
        finally:
            before.use()
        return texture

    def release(self) -> None:
        self._drop()
        self._screen.release()
        self._program.release()

    def _of_size(self, size_px: tuple[int, int]) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        if self._target is None or self._target[0].size != size_px:
            self._drop()
            texture = new_texture(self._gl, size_px, 4, "uint8")
            self._target = texture, self._gl.framebuffer([texture])
        return self._target

    def _drop(self) -> None:
        if self._target is not None:
            texture, framebuffer = self._target
            self._target = None
            framebuffer.release()
            texture.release()
