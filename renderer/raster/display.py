"""The display transform on the GPU: from linear light to what a screen shows.

Owns 8-bit textures for the screen. Knows nothing of scenes or of who shows them.
"""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from renderer.raster.programs import set_uniform
from renderer.raster.resources import check, new_texture
from renderer.raster.sources import link

MOST_PICTURES = 8


class Display:
    """Draws linear textures as 8-bit sRGB ones in a context, which must be current.

    Each source texture has a picture of its own, so that several can be on the screen at once;
    the MOST_PICTURES last used are kept.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._program = link(context, "screen.vert", "display.frag")
        self._screen = context.vertex_array(self._program, [])
        self._pictures: dict[int, tuple[moderngl.Texture, moderngl.Framebuffer]] = {}
        self._uploaded: moderngl.Texture | None = None

    def draw(self, texture: moderngl.Texture, exposure_ev: float = 0.0) -> moderngl.Texture:
        """An RGBA8 texture of the same size: 2^exposure_ev * colour, clamped, as sRGB.

        The texture returned is drawn over by the next draw() of the same source.
        """
        gl = self._gl
        picture, framebuffer = self._picture(texture)
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.NOTHING)
            gl.wireframe = False
            gl.clear_samplers(0, 1)
            framebuffer.use()
            texture.use(0)
            set_uniform(self._program, "linear_color", 0)
            set_uniform(self._program, "window_depth", 0.5)
            exposure = 2.0 ** min(max(exposure_ev, -100.0), 100.0)
            set_uniform(self._program, "exposure", exposure)
            self._screen.render(moderngl.TRIANGLES, vertices=3)
        finally:
            before.use()
        return picture

    def upload(self, color: NDArray[np.float32]) -> moderngl.Texture:
        """A frame's color, float32 (height, width, 3), as a texture for draw(); one at a time."""
        height, width = color.shape[:2]
        if self._uploaded is None or self._uploaded.size != (width, height):
            if self._uploaded is not None:
                self._uploaded.release()
                self._uploaded = None
            self._uploaded = new_texture(self._gl, (width, height), 3, "float32")
        self._uploaded.write(np.ascontiguousarray(color, np.float32))
        return self._uploaded

    def release(self) -> None:
        while self._pictures:
            self._drop(next(iter(self._pictures)))
        for resource in (self._uploaded, self._screen, self._program):
            if resource is not None:
                resource.release()
        self._uploaded = None

    def _picture(self, source: moderngl.Texture) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        kept = self._pictures.pop(source.glo, None)
        if kept is not None and kept[0].size != source.size:
            self._pictures[source.glo] = kept
            self._drop(source.glo)
            kept = None
        if kept is None:
            texture = new_texture(self._gl, source.size, 4, "uint8")
            kept = texture, self._gl.framebuffer([texture])
            check(self._gl, "a picture")
        self._pictures[source.glo] = kept  # the last used comes last
        if len(self._pictures) > MOST_PICTURES:
            self._drop(next(iter(self._pictures)))
        return kept

    def _drop(self, glo: int) -> None:
        texture, framebuffer = self._pictures.pop(glo)
        framebuffer.release()
        texture.release()
