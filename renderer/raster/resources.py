"""GPU resources: creation, ownership, and OpenGL errors in one line."""

from __future__ import annotations

from typing import Any, Protocol, TypeVar

import moderngl
import numpy as np

from lucida.renderer.system.errors import LucidaError


class Resource(Protocol):
    def release(self) -> None: ...


AnyResource = TypeVar("AnyResource", bound=Resource)


class Owner:
    """Resources that are released together, the last one first."""

    def __init__(self) -> None:
        self._owned: list[Resource] = []

    def own(self, resource: AnyResource) -> AnyResource:
        self._owned.append(resource)
        return resource

    def release(self) -> None:
        """Release them all. Safe to call twice."""
        while self._owned:
            self._owned.pop().release()


def new_texture(
    context: moderngl.Context, size: tuple[int, int], components: int, dtype: Any
) -> moderngl.Texture:
    """Return a texture without filtering.

    dtype: float32, float16, int32, or uint8 (0 to 255 for 0 to 1). Raises LucidaError if memory is
    exhausted.
    """
    kinds = {"float32": "f4", "float16": "f2", "int32": "i4", "uint8": "f1"}
    kind = kinds[np.dtype(dtype).name]
    _ = context.error  # clear errors left by other code in a window's context
    texture = context.texture(size, components, dtype=kind)
    _check_texture(context, texture)
    texture.filter = moderngl.NEAREST, moderngl.NEAREST
    texture.repeat_x = texture.repeat_y = False
    return texture


def _check_texture(context: moderngl.Context, texture: moderngl.Texture) -> None:
    try:
        check(context, f"a texture of {texture.width}x{texture.height}")
    except LucidaError:
        texture.release()
        raise


def check(context: moderngl.Context, doing: str) -> None:
    """Raise LucidaError if OpenGL has reported an error since the last check."""
    error = context.error
    if error == "GL_NO_ERROR":
        return
    if error == "GL_OUT_OF_MEMORY":
        raise LucidaError(
            "OpenGL", f"no memory for {doing}", "select a smaller image or a smaller model"
        )
    if error == "GL_UNKNOWN_ERROR":  # moderngl's word for GL_CONTEXT_LOST
        raise LucidaError(
            "OpenGL",
            f"the context is lost at {doing}",
            "start the program again; update the graphics driver if this recurs",
        )
    raise LucidaError("OpenGL", f"{error} at {doing}", "update the graphics driver")
