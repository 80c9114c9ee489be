"""Shaders over whole pictures, run again only if their inputs have changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl

from lucida.app.images.shown import Held, Picture
from lucida.renderer.raster.resources import Owner
from lucida.renderer.raster.screen_pass import SizedTarget, cover, new_array, plain_state
from lucida.renderer.system.memo import Memo


class Pass:
    """A fragment shader over a whole picture."""

    def __init__(
        self,
        context: moderngl.Context,
        fragment: str,
        constants: Mapping[str, bool] | None = None,
    ) -> None:
        self._gl = context
        self._owner = Owner()
        self._screen = new_array(self._owner, context, "screen.vert", fragment, constants)
        self._target = self._owner.own(SizedTarget(context))
        self._draw = Memo(_draw)

    def draw(self, size: tuple[int, int], textures: dict[str, Held], **uniforms: Any) -> Picture:
        """Draw a picture of `size`. textures, uniforms: by their names in the shader."""
        target = self._target.of_size(size)
        inputs = tuple(textures.items()), tuple(uniforms.items())
        return Picture(target[0], self._draw(self._gl, self._screen, target[1], *inputs))

    def release(self) -> None:
        self._owner.release()


def _draw(
    gl: moderngl.Context,
    screen: moderngl.VertexArray,
    framebuffer: moderngl.Framebuffer,
    textures: tuple[tuple[str, Held], ...],
    uniforms: tuple[tuple[str, Any], ...],
) -> object:
    """Draw, and return an object that identifies the result."""
    with plain_state(gl, len(textures)):
        framebuffer.use()
        units = {name: unit for unit, (name, _) in enumerate(textures)}
        for name, (source, _) in textures:
            source.use(units[name])
        cover(screen, **units, **dict(uniforms))
    return object()
