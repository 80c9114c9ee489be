"""The pixels that a kernel writes, and the frame made from them.

An image has buffers, and is divided into blocks. This module does not need numba.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.frame import Frame
from lucida.renderer.system.errors import LucidaError

from .buffers import Buffers

BLOCK = 32  # pixels: side of the square that a thread traces at a time

# Shape of a pixel, dtype, and the value of a miss (for color, the background).
_LAYOUT: dict[str, tuple[tuple[int, ...], type, float]] = {
    "color": ((3,), np.float32, 0),
    "depth": ((), np.float32, np.inf),
    "normal": ((3,), np.float32, 0),
    "id": ((), np.int32, -1),
    "primitive": ((), np.int32, -1),
}


class Rows(NamedTuple):
    """Some rows of an image of (width, height) `size`: from `first` up to, not including, `end`.

    They equal those of the whole image, bit for bit, if `first` is a multiple of BLOCK.
    """

    size: tuple[int, int]
    first: int
    end: int


class Image(NamedTuple):
    """Buffers as in Frame; a channel that was not requested (has_...: False) has 0 x 0 pixels.

    finished: uint8 (rows, columns) of blocks, 1 if a block is traced.
    """

    width: int
    height: int
    finished: NDArray[np.uint8]
    color: NDArray[np.float32]
    depth: NDArray[np.float32]
    normal: NDArray[np.float32]
    id: NDArray[np.int32]
    primitive: NDArray[np.int32]
    has_color: bool
    has_depth: bool
    has_normal: bool
    has_id: bool
    has_primitive: bool


def new_image(
    size: tuple[int, int], channels: tuple[str, ...], buffers: Buffers | None = None
) -> Image:
    """Return an image with uninitialised buffers. Raises LucidaError if memory is exhausted.

    buffers: the pool for their memory; None for fresh memory.
    """
    width, height = size
    layouts = [
        ((height, width, *pixel) if name in channels else (0, 0, *pixel), dtype)
        for name, (pixel, dtype, _) in _LAYOUT.items()
    ]
    try:
        arrays = (buffers or Buffers()).arrays(layouts)
    except MemoryError:
        raise LucidaError(
            "size", f"{width}x{height} exceeds the memory", "make it smaller"
        ) from None
    parts: dict[str, Any] = dict(zip(_LAYOUT, arrays, strict=True))
    parts |= {f"has_{name}": name in channels for name in _LAYOUT}
    finished = np.zeros((-(-height // BLOCK), -(-width // BLOCK)), np.uint8)
    return Image(width, height, finished, **parts)


def to_frame(image: Image, background: tuple[float, float, float], time_s: float) -> Frame:
    """Return the frame of these buffers. Unfinished blocks are filled with misses."""
    complete = bool(image.finished.all())
    channels = {name: getattr(image, name) for name in _LAYOUT if getattr(image, f"has_{name}")}
    if not complete:
        missing = image.finished == 0
        pixels = np.repeat(np.repeat(missing, BLOCK, axis=0), BLOCK, axis=1)
        pixels = pixels[: image.height, : image.width]
        for name, buffer in channels.items():
            buffer[pixels] = background if name == "color" else _LAYOUT[name][2]
    return Frame((image.width, image.height), **channels, time_s=time_s, complete=complete)
