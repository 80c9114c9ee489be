"""Targets: the textures that images of one size are drawn into.

Owns framebuffers and their attachments. Knows nothing of scenes or cameras.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.raster.resources import Owner, check, new_texture

Region = tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class Textures:
    """What the rasterizer drew, on the GPU; row 0 of each texture is the image's top row.

    color: RGBA32F, linear light. surface: RGBA32F, the normal, and t (infinity: nothing hit).
    object, primitive: R32I, -1 where nothing is hit. They stay the rasterizer's own: its next
    draw() draws over them, or replaces them where the size changes.
    """

    color: moderngl.Texture
    surface: moderngl.Texture
    object: moderngl.Texture
    primitive: moderngl.Texture


class Targets:
    """Framebuffers of one size, (width, height).

    seen: takes primitives and depth. shaded: takes the rest, and only reads the depth.
    """

    def __init__(self, context: moderngl.Context, size: tuple[int, int]) -> None:
        largest = context.info["GL_MAX_TEXTURE_SIZE"]
        if max(size) > largest:
            raise LucidaError(
                "size",
                f"{size[0]}x{size[1]} is too large for the graphics driver",
                f"stay within {largest} a side, or use --renderer ray",
            )
        self.size = size
        self._owner = Owner()
        try:
            self._build(context, size)
        except moderngl.Error as error:
            self.release()
            problem = f"{size[0]}x{size[1]}: {error}"
            raise LucidaError("size", problem, "choose a smaller image") from None
        except LucidaError:
            self.release()
            raise

    def _build(self, context: moderngl.Context, size: tuple[int, int]) -> None:
        own = self._owner.own
        self.textures = Textures(
            color=own(new_texture(context, size, 4, np.float32)),
            surface=own(new_texture(context, size, 4, np.float32)),
            object=own(new_texture(context, size, 1, np.int32)),
            primitive=own(new_texture(context, size, 1, np.int32)),
        )
        depth = own(context.depth_renderbuffer(size))
        check(context, f"a depth buffer of {size[0]}x{size[1]}")
        textures = self.textures
        self.seen = own(context.framebuffer([textures.primitive], depth))
        shaded = [textures.color, textures.surface, textures.object]
        self.shaded = own(context.framebuffer(shaded, depth))
        self.shaded.depth_mask = False

    def read(
        self, channel: str, region: Region | None = None
    ) -> NDArray[np.float32] | NDArray[np.int32]:
        """A channel (renderer/frame.py) of the last image, or of a part of it; waits until it is
        drawn. region: first row and column, one past the last of each."""
        top, left, bottom, right = region or (0, 0, self.size[1], self.size[0])
        width, height = right - left, bottom - top
        where = (left, top, width, height)
        if channel in ("id", "primitive"):
            numbers = np.empty((height, width), np.int32)
            source, attachment = (self.shaded, 2) if channel == "id" else (self.seen, 0)
            source.read_into(
                numbers, viewport=where, components=1, attachment=attachment, dtype="i4"
            )
            return numbers
        values = np.empty((height, width, 4), np.float32)
        attachment = 0 if channel == "color" else 1
        self.shaded.read_into(
            values, viewport=where, components=4, attachment=attachment, dtype="f4"
        )
        return np.ascontiguousarray(values[..., 3] if channel == "depth" else values[..., :3])

    def release(self) -> None:
        self._owner.release()
