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


def new_surface(context: moderngl.Context, size: tuple[int, int]) -> moderngl.Texture:
    """A texture of 8-bit colours, without filtering, for what is copied to the window, or drawn
    there by picture.frag. OpenGL stores it as screens have it, blue first; what is written and read
    is red first, as in any other. Raises LucidaError where there is no memory for it.

    For such surfaces only does Mesa's software renderer take its quick ways: filling, enlarging
    and copying then take a tenth to a half of the time. Mesa 22.3 draws wrongly by one of them:
    where a surface is drawn to another, multiplied by a colour that varies. That is what ImGui
    does: it must never be given one.
    """
    texture = new_texture(context, size, 4, np.uint8)
    # moderngl does not ask for it: where it does not say how to find OpenGL's functions, this is
    # a texture like any other.
    load = getattr(getattr(context.mglo, "_context", None), "load_opengl_function", None)
    address = load("glTexImage2D") if load is not None else None
    if address:
        texture.use(context.max_texture_units - 1)  # where moderngl's own work goes on
        form = (_TEXTURE_2D, 0, _RGBA, *size, 0, _BGRA, _UNSIGNED_BYTE)
        ctypes.CFUNCTYPE(None, *(ctypes.c_int,) * 8, ctypes.c_void_p)(address)(*form, None)
        try:
            check(context, f"a surface of {size[0]}x{size[1]}")
        except LucidaError:
            texture.release()
            raise
    return texture


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
