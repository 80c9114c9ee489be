"""The range of an image's finite depths, found on the GPU and left there.

A chain of textures reduces an image to one pixel. The false colours read the range from that
texture, so that nothing waits for the GPU; the numbers can be read a frame later.
"""

from __future__ import annotations

import moderngl
import numpy as np

from lucida.renderer.images.shared_numbers import FARTHEST

from .resources import Owner
from .screen_pass import SizedTarget, Target, cover, new_array, plain_state

SIDE = 16  # of the blocks in range.frag


class DepthRange:
    """The range of one image at a time, in a context that must be current."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = Owner()
        self._screen: moderngl.VertexArray | None = None  # compiled on first use
        self._targets: list[SizedTarget] = []
        self._buffer = self._owner.own(context.buffer(reserve=8))
        self._asked = False
        self._numbers: tuple[float, float] | None = None

    def measure(self, texture: moderngl.Texture) -> moderngl.Texture:
        """Return one pixel, RG32F: the least and the greatest finite value of a texture's fourth
        component.

        The next call overwrites it. Raises LucidaError.
        """
        if self._screen is None:
            constants = {"SIDE": SIDE}
            self._screen = new_array(self._owner, self._gl, "screen.vert", "range.frag", constants)
        source = texture
        levels = self._levels(texture.size)
        with plain_state(self._gl):
            for level, framebuffer in levels:
                framebuffer.use()
                source.use(0)
                cover(self._screen, source=0, is_range=source is not texture)
                source = level
        source.read_into(self._buffer)  # into a GPU buffer, without waiting
        self._asked = True
        return source

    @property
    def unfinished(self) -> bool:
        """True if numbers() has not been called since the last measurement."""
        return self._asked

    def numbers(self) -> tuple[float, float] | None:
        """Return the last range, nearest and farthest; None if nothing was hit or measured.

        Call this a frame later: immediately, it would wait for the GPU.
        """
        if self._asked:
            low, high = np.frombuffer(self._buffer.read(), np.float32).tolist()
            self._numbers = (low, high) if low <= high < FARTHEST else None
            self._asked = False
        return self._numbers

    def release(self) -> None:
        self._owner.release()

    def _levels(self, size: tuple[int, int]) -> list[Target]:
        """Return targets that get smaller by SIDE each, down to one pixel."""
        levels: list[Target] = []
        while not levels or size != (1, 1):
            size = -(-size[0] // SIDE), -(-size[1] // SIDE)
            if len(levels) == len(self._targets):
                self._targets.append(self._owner.own(SizedTarget(self._gl, 2, "float32")))
            levels.append(self._targets[len(levels)].of_size(size))
        return levels
