"""GPU resources: making them, owning them, and OpenGL's complaints as one line.

Owns nothing of what they hold.
"""

from __future__ import annotations

import ctypes
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
    0 to 1; four of them are stored as store_as_screen() says).

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
    if components == 4 and kind == "f1":
        store_as_screen(context, texture)
    texture.filter = moderngl.NEAREST, moderngl.NEAREST
    texture.repeat_x = texture.repeat_y = False
    return texture


def store_as_screen(context: moderngl.Context, texture: moderngl.Texture) -> None:
    """Has OpenGL store the 8-bit colours of a texture as screens have them, blue first, and forget
    its contents. What is written and read stays red first.

    For no other surfaces does Mesa's software renderer take its quick ways: what is plain, or a
    picture, then takes a third to a half of the time, and copying to the window a tenth. moderngl
    does not ask for it: where it does not say how to find OpenGL's functions, nothing is done.
    """
    load = getattr(getattr(context.mglo, "_context", None), "load_opengl_function", None)
    address = load("glTexImage2D") if load is not None else None
    if address:
        texture.use(context.max_texture_units - 1)  # where moderngl's own work goes on
        form = (_TEXTURE_2D, 0, _RGBA, *texture.size, 0, _BGRA, _UNSIGNED_BYTE)
        ctypes.CFUNCTYPE(None, *(ctypes.c_int,) * 8, ctypes.c_void_p)(address)(*form, None)


_TEXTURE_2D, _RGBA, _BGRA, _UNSIGNED_BYTE = 0x0DE1, 0x1908, 0x80E1, 0x1401


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
