"""GPU resources: making them, owning them, and OpenGL's complaints as one line.

Owns nothing of what they hold.
"""

from __future__ import annotations

from typing import Any, Protocol, TypeVar

import moderngl
import numpy as np

from renderer.errors import LucidaError


class Resource(Protocol):
    def release(self) -> None: ...


AnyResource = TypeVar("AnyResource", bound=Resource)


class Owner:
    """Resources that are given back together, the last one first."""

    def __init__(self) -> None:
        self._owned: list[Resource] = []

    def own(self, resource: AnyResource) -> AnyResource:
        self._owned.append(resource)
        return resource

    def release(self) -> None:
        """Twice does no harm."""
        while self._owned:
            self._owned.pop().release()


def new_texture(
    context: moderngl.Context, size: tuple[int, int], components: int, dtype: Any
) -> moderngl.Texture:
    """A texture without filtering. dtype: float32, float16, int32, or uint8 (0 to 255 for
    0 to 1).

    Raises LucidaError where there is no memory for it.
    """
    kinds = {"float32": "f4", "float16": "f2", "int32": "i4", "uint8": "f1"}
    kind = kinds[np.dtype(dtype).name]
    _ = context.error  # what somebody else in a window's context has left is not this texture's
    texture = context.texture(size, components, dtype=kind)
    try:
        check(context, f"a texture of {size[0]}x{size[1]}")
    except LucidaError:
        texture.release()
        raise
    texture.filter = moderngl.NEAREST, moderngl.NEAREST
    texture.repeat_x = texture.repeat_y = False
    return texture


def check(context: moderngl.Context, doing: str) -> None:
    """Raises LucidaError where OpenGL has reported an error since it was last asked."""
    error = context.error
    if error == "GL_NO_ERROR":
        return
    if error == "GL_OUT_OF_MEMORY":
        raise LucidaError(
            "OpenGL", f"no memory for {doing}", "choose a smaller image or a smaller model"
        )
    raise LucidaError("OpenGL", f"{error} at {doing}", "update the graphics driver")
