"""Tables: arrays of the flat scene as textures that shaders index, with one or more texels per
element.

A long array is wrapped into a 2D texture; shaders/chunks/tables.glsl reads it back.
"""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import TABLE_SHIFT
from lucida.renderer.system.errors import LucidaError

from .resources import new_texture

TABLE_WIDTH = 1 << TABLE_SHIFT


class Table:
    """A float32 or int32 array on the GPU. name: for messages. array: (n, ..., components).

    Raises LucidaError if the array does not fit into the driver's largest texture.
    """

    def __init__(self, context: moderngl.Context, name: str, array: NDArray[Any]) -> None:
        components = array.shape[-1]
        self.count = array.size // components
        rows = max(1, -(-self.count // TABLE_WIDTH))
        largest = context.info["GL_MAX_TEXTURE_SIZE"]
        if max(TABLE_WIDTH, rows) > largest:
            raise LucidaError(
                "scene",
                f"{self.count} texels of {name} do not fit into the driver's textures "
                f"({largest} a side)",
                "simplify the model, or use --renderer ray",
            )
        # Pad the last row, because a texture is written as a rectangle.
        self.texels = np.zeros((rows * TABLE_WIDTH, components), array.dtype)
        self.texture = new_texture(context, (TABLE_WIDTH, rows), components, array.dtype)
        self.write(array)

    def write(self, array: NDArray[Any]) -> None:
        """Upload the array."""
        self.texels[: self.count] = array.reshape(self.texels[: self.count].shape)
        self.texture.write(self.texels)

    def write_rows(self, first: int, last: int) -> None:
        """Upload rows of `texels`, from `first` up to, not including, `last`."""
        part = self.texels[first * TABLE_WIDTH : last * TABLE_WIDTH]
        self.texture.write(part, viewport=(0, first, TABLE_WIDTH, last - first))

    def release(self) -> None:
        self.texture.release()
