"""Shaders over whole pictures, done again only where what they are given has changed.

Owns their targets. Knows nothing of what is in the pictures.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl

from app.images.shown import Held, Picture
from renderer.memo import Memo
from renderer.raster.programs import set_uniform
from renderer.raster.resources import new_texture
from renderer.raster.sources import link


class ByteTarget:
    """A texture of 8 bits to draw into, of the size that was asked for last."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._made: tuple[moderngl.Texture, moderngl.Framebuffer] | None = None

    def of_size(self, size: tuple[int, int]) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        """Raises LucidaError where there is no memory."""
        if self._made is None or self._made[0].size != size:
            self.release()
            texture = new_texture(self._gl, size, 4, "uint8")
            self._made = texture, self._gl.framebuffer([texture])
        return self._made

    def release(self) -> None:
        if self._made is not None:
            texture, framebuffer = self._made
            self._made = None
            framebuffer.release()
            texture.release()


class Pass:
    """A fragment shader over a whole picture, done again only where its inputs have changed."""

    def __init__(
        self,
        context: moderngl.Context,
        fragment: str,
        constants: Mapping[str, bool] | None = None,
    ) -> None:
        self._gl = context
        self._program = link(context, "screen.vert", fragment, constants or {})
        self._screen = context.vertex_array(self._program, [])
        self._target = ByteTarget(context)
        self._draw = Memo(_draw)

    def draw(
        self,
        size: tuple[int, int],
        textures: dict[str, Held],
        **uniforms: Any,
    ) -> Picture:
        """Draw a picture of `size`. textures, uniforms: by their names in the shader."""
        program, screen = self._program, self._screen
        target = self._target.of_size(size)
        inputs = tuple(textures.items()), tuple(uniforms.items())
        return Picture(*target, self._draw(self._gl, program, screen, target[1], *inputs))

    def release(self) -> None:
        self._target.release()
        self._screen.release()
        self._program.release()


def _draw(
    gl: moderngl.Context,
    program: moderngl.Program,
    screen: moderngl.VertexArray,
    framebuffer: moderngl.Framebuffer,
    textures: tuple[tuple[str, Held], ...],
    uniforms: tuple[tuple[str, Any], ...],
) -> object:
    """Draw, and return an object that stands for what was drawn."""
    before = gl.detect_framebuffer()
    try:
        gl.enable_only(moderngl.NOTHING)
        gl.wireframe = False
        gl.clear_samplers(0, len(textures))
        framebuffer.use()
        for unit, (name, (source, _)) in enumerate(textures):
            source.use(unit)
            set_uniform(program, name, unit)
        set_uniform(program, "window_depth", 0.5)
        for name, value in uniforms:
            set_uniform(program, name, value)
        screen.render(moderngl.TRIANGLES, vertices=3)
    finally:
        before.use()
    return object()
