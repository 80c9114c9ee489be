"""Render targets of a frame, and copies between them, in the window's own context."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cache
from typing import Any

import imgui_bundle  # noqa: F401  # before glfw, so that both use the same GLFW library

# isort: split
import glfw
import moderngl
import numpy as np

from lucida.renderer.system.errors import LucidaError


@dataclass(frozen=True)
class Target:
    """A framebuffer for a frame. size: (width, height) in pixels."""

    framebuffer: moderngl.Framebuffer
    size: tuple[int, int]

    def read(self) -> np.ndarray:
        """Return the drawn pixels, uint8 (height, width, 3), row 0 at the top. Call before the
        swap.
        """
        width, height = self.size
        data = self.framebuffer.read((0, 0, width, height), components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]


def copy_pixels(
    source: int, source_box: tuple[int, ...], target: int, target_box: tuple[int, ...]
) -> None:
    """Copy colours between two framebuffers, given by their GL names, to the nearest pixel.

    Boxes: left, bottom, right, top. Leaves both bound, unknown to moderngl.
    """
    for kind, name in ((_READ_FRAMEBUFFER, source), (_DRAW_FRAMEBUFFER, target)):
        _gl("glBindFramebuffer", kind, name)
    _gl("glBlitFramebuffer", *source_box, *target_box, _COLOR_BUFFER_BIT, _NEAREST)


_READ_FRAMEBUFFER, _DRAW_FRAMEBUFFER = 0x8CA8, 0x8CA9
_COLOR_BUFFER_BIT, _NEAREST = 0x4000, 0x2600


def _gl(name: str, *numbers: int) -> None:
    """Call an OpenGL function that moderngl does not offer."""
    address = _address_in(ctypes.cast(glfw.get_current_context(), ctypes.c_void_p).value or 0, name)
    _callable_at(address, len(numbers))(*numbers)


@cache
def _address_in(context: int, name: str) -> int:
    """Return a function's address in a context, which must be current.

    Cached: asking takes longer than many of the functions.
    """
    address = glfw.get_proc_address(name)
    if not address:
        raise LucidaError("OpenGL", f"{name} is missing", "update the graphics driver")
    return ctypes.cast(address, ctypes.c_void_p).value or 0


@cache
def _callable_at(address: int, numbers: int) -> Any:
    """Return the function at an address, which takes this many numbers."""
    return ctypes.CFUNCTYPE(None, *(ctypes.c_int for _ in range(numbers)))(address)
