"""Tables: arrays of the flat scene as textures that shaders index, one element a texel or more.

Owns how a long array is wrapped into a 2D texture (shaders/chunks/tables.glsl reads it back).
Knows nothing of what the numbers mean.
"""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError

TABLE_WIDTH = 4096  # a power of two; texel() in tables.glsl shifts by its logarithm


class Table:
    """A float32 or int32 array on the GPU. name: for messages. array: (n, ..., components).

    Raises LucidaError where the array is longer than the driver's textures.
    """

    def __init__(self, context: moderngl.Context, name: str, array: NDArray) -> None:
        self.components = array.shape[-1]
        texels = array.size // self.components
        rows = max(1, -(-texels // TABLE_WIDTH))
        largest = context.info["GL_MAX_TEXTURE_SIZE"]
        if max(TABLE_WIDTH, rows) > largest:
            raise LucidaError(
                "scene",
                f"{name}: {texels} texels do not fit into the driver's textures ({largest} a side)",
                "simplify the model, or draw it with --renderer ray",
            )
        # The last row is filled up: a texture is written as a rectangle.
        self.texels = np.zeros((rows * TABLE_WIDTH, self.components), array.dtype)
        self.count = texels
        self.texture = new_texture(context, (TABLE_WIDTH, rows), self.components, array.dtype)
        self.write(array)

    def write(self, array: NDArray | None = None) -> None:
        """Uploads; None: what the caller has put into `texels` itself."""
        if array is not None:
            self.texels[: self.count] = array.reshape(self.count, self.components)
        self.texture.write(self.texels)

    def release(self) -> None:
        self.texture.release()


def new_texture(
    context: moderngl.Context, size: tuple[int, int], components: int, dtype: np.dtype | str
) -> moderngl.Texture:
    """A texture without filtering. Raises LucidaError where there is no memory for it."""
    kind = {"float32": "f4", "int32": "i4", "uint8": "f1"}[np.dtype(dtype).name]
    texture = context.texture(size, components, dtype=kind)
    check(context, f"a texture of {size[0]}x{size[1]}")
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
