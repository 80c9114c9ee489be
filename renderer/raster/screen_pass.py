"""Passes over whole images: their OpenGL state, uniforms, and the targets that they draw into."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import moderngl

from .programs import set_uniform
from .resources import Owner, check, new_texture
from .sources import Constant, link

Size = tuple[int, int]
Target = tuple[moderngl.Texture, moderngl.Framebuffer]


@contextmanager
def plain_state(context: moderngl.Context, samplers: int = 1) -> Iterator[None]:
    """Turn off depth test, culling and blending, and reset the first texture units after a window's
    widgets. Bind the present framebuffer again at the end.
    """
    before = context.detect_framebuffer()
    try:
        context.enable_only(moderngl.NOTHING)
        context.wireframe = False
        context.clear_samplers(0, samplers)
        yield
    finally:
        context.enable_only(moderngl.NOTHING)
        before.use()


def new_array(
    owner: Owner,
    context: moderngl.Context,
    vertex: str,
    fragment: str,
    constants: Mapping[str, Constant] | None = None,
) -> moderngl.VertexArray:
    """Return a vertex array without buffers, and its program, both owned by `owner`."""
    return owner.own(
        context.vertex_array(owner.own(link(context, vertex, fragment, constants)), [])
    )


def set_uniforms(program: moderngl.Program, **values: Any) -> None:
    for name, value in values.items():
        set_uniform(program, name, value)


def cover(screen: moderngl.VertexArray, **uniforms: Any) -> None:
    """Run a program with screen.vert on each pixel of the bound framebuffer."""
    set_uniforms(screen.program, window_depth=0.5, **uniforms)
    screen.render(moderngl.TRIANGLES, vertices=3)


class SizedTarget:
    """A texture to draw into, recreated if another size is requested.

    dtype: see new_texture.
    """

    def __init__(
        self,
        context: moderngl.Context,
        components: int = 4,
        dtype: str = "uint8",
    ) -> None:
        self._gl, self._components = context, components
        self._dtype = dtype
        self._made: Target | None = None

    def of_size(self, size: Size) -> Target:
        """Return texture and framebuffer. Raises LucidaError if memory is exhausted."""
        if self._made is None or self._made[0].size != size:
            self.release()
            texture = new_texture(self._gl, size, self._components, self._dtype)
            self._made = texture, self._gl.framebuffer([texture])
            check(self._gl, f"a picture of {size[0]}x{size[1]}")
        return self._made

    def release(self) -> None:
        made, self._made = self._made, None
        if made is not None:
            texture, framebuffer = made
            framebuffer.release()
            texture.release()
