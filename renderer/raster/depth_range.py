"""The range of an image's finite depths, found on the GPU and left there.

A chain of textures reduces an image to one pixel. The false colours read the range from that
texture, so that nothing waits for the GPU; the numbers can be read a frame later.
"""

from __future__ import annotations

import moderngl
import numpy as np

from renderer.raster.programs import set_uniform
from renderer.raster.resources import new_texture
from renderer.raster.sources import link
from renderer.shared_numbers import FARTHEST

SIDE = 16  # of the blocks in range.frag


class DepthRange:
    """The range of one image at a time, in a context, which must be current."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._program: moderngl.Program | None = None  # compiled on first use
        self._screen: moderngl.VertexArray | None = None
        self._levels: list[tuple[moderngl.Texture, moderngl.Framebuffer]] = []
        self._measured: tuple[int, int] | None = None
        self._buffer = context.buffer(reserve=8)
        self._asked = False
        self._numbers: tuple[float, float] | None = None

    def measure(self, texture: moderngl.Texture) -> moderngl.Texture:
        """Return one pixel, RG32F: the least and the greatest finite value of a texture's fourth
        component.

        The next call overwrites it. Raises LucidaError.
        """
        gl, (program, screen) = self._gl, self._pass()
        self._resize(texture.size)
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.NOTHING)
            gl.wireframe = False
            gl.clear_samplers(0, 1)
            source = texture
            for level, framebuffer in self._levels:
                framebuffer.use()
                source.use(0)
                set_uniform(program, "source", 0)
                set_uniform(program, "is_range", source is not texture)
                set_uniform(program, "window_depth", 0.5)
                screen.render(moderngl.TRIANGLES, vertices=3)
                source = level
        finally:
            before.use()
        source.read_into(self._buffer)  # into a GPU buffer, without waiting
        self._asked = True
        return source

    @property
    def unfinished(self) -> bool:
        """True if numbers() has not been called since the last measurement."""
        return self._asked

    def numbers(self) -> tuple[float, float] | None:
        """Return the last range, nearest and farthest; None if nothing was hit, or nothing was
        measured.

        Call this a frame later: immediately, it would wait for the GPU.
        """
        if self._asked:
            low, high = np.frombuffer(self._buffer.read(), np.float32).tolist()
            self._numbers = (low, high) if low <= high < FARTHEST else None
            self._asked = False
        return self._numbers

    def release(self) -> None:
        self._drop()
        for resource in (self._buffer, self._screen, self._program):
            if resource is not None:
                resource.release()

    def _pass(self) -> tuple[moderngl.Program, moderngl.VertexArray]:
        if self._program is None or self._screen is None:
            self._program = link(self._gl, "screen.vert", "range.frag", {"SIDE": SIDE})
            self._screen = self._gl.vertex_array(self._program, [])
        return self._program, self._screen

    def _resize(self, size: tuple[int, int]) -> None:
        if self._measured == size:
            return
        self._drop()
        width, height = size
        while not self._levels or (width, height) != (1, 1):
            width, height = -(-width // SIDE), -(-height // SIDE)
            texture = new_texture(self._gl, (width, height), 2, np.float32)
            self._levels.append((texture, self._gl.framebuffer([texture])))
        self._measured = size

    def _drop(self) -> None:
        self._measured = None
        while self._levels:
            texture, framebuffer = self._levels.pop()
            framebuffer.release()
            texture.release()
