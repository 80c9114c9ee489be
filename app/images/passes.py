"""Shaders over whole pictures, done again only where what they are given has changed.

Owns their targets. Knows nothing of what is in the pictures.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

import moderngl

from app.images.shown import Picture
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

    def made(self) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        """The last one; there must be one."""
        assert self._made is not None
        return self._made

    def release(self) -> None:
        if self._made is not None:
            texture, framebuffer = self._made
            self._made = None
            framebuffer.release()
            texture.release()


class Pass:
    """A fragment shader over a whole picture, done again only where its inputs have changed.

    count: how often it was done.
    """

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
        self._drawn: Hashable = None
        self.count = 0

    def draw(
        self,
        size: tuple[int, int],
        key: Hashable,
        textures: dict[str, moderngl.Texture],
        **uniforms: Any,
    ) -> moderngl.Texture:
        """key: what the textures hold, besides their names; the uniforms are compared here."""
        made = (size, key, tuple((n, t.glo) for n, t in textures.items()), *uniforms.items())
        texture, framebuffer = self._target.of_size(size)
        if made == self._drawn:
            return texture
        gl = self._gl
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.NOTHING)
            gl.wireframe = False
            gl.clear_samplers(0, len(textures))
            framebuffer.use()
            for unit, (name, source) in enumerate(textures.items()):
                source.use(unit)
                set_uniform(self._program, name, unit)
            set_uniform(self._program, "window_depth", 0.5)
            for name, value in uniforms.items():
                set_uniform(self._program, name, value)
            self._screen.render(moderngl.TRIANGLES, vertices=3)
        finally:
            before.use()
        self._drawn = made
        self.count += 1
        return texture

    def picture(self) -> Picture:
        """What was drawn last, as a window takes it."""
        return Picture(*self._target.made(), self._drawn)

    def forget(self) -> None:
        """The next draw() draws, whatever its inputs."""
        self._drawn = None

    def release(self) -> None:
        self._target.release()
        self._screen.release()
        self._program.release()


class Same:
    """An object as a part of a key: equal to itself only, and kept while the key is."""

    def __init__(self, thing: object) -> None:
        self._thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and other._thing is self._thing

    def __hash__(self) -> int:
        return id(self._thing)
