"""Targets: the textures that one image size is drawn into.

Owns framebuffers and their attachments. Knows nothing of scenes or cameras.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl

from renderer.errors import LucidaError
from renderer.raster.tables import check, new_texture


@dataclass(frozen=True, eq=False)
class Textures:
    """What the rasterizer drew, on the GPU; row 0 of each texture is the image's top row.

    color: RGBA32F, linear light. surface: RGBA32F, the normal, and t (infinity: nothing hit).
    object, primitive: R32I, -1 where nothing is hit. They are the rasterizer's own, and are drawn over or
    replaced by its next draw().
    """

    color: moderngl.Texture
    surface: moderngl.Texture
    object: moderngl.Texture
    primitive: moderngl.Texture


class Targets:
    """Framebuffers of one size, (width, height): `seen` takes primitives and depth, `shaded` the rest; it only
    reads the depth."""

    def __init__(self, context: moderngl.Context, size: tuple[int, int]) -> None:
        largest = context.info["GL_MAX_TEXTURE_SIZE"]
        if max(size) > largest:
            raise LucidaError(
                "size",
                f"{size[0]}x{size[1]} is too large for the graphics driver",
                f"stay within {largest} a side, or render with --renderer ray",
            )
        self.size = size
        self._owned: list = []
        try:
            self.textures = Textures(
                color=self._own(new_texture(context, size, 4, "float32")),
                surface=self._own(new_texture(context, size, 4, "float32")),
                object=self._own(new_texture(context, size, 1, "int32")),
                primitive=self._own(new_texture(context, size, 1, "int32")),
            )
            depth = self._own(context.depth_renderbuffer(size))
            check(context, f"a depth buffer of {size[0]}x{size[1]}")
            self.seen = self._own(context.framebuffer([self.textures.primitive], depth))
            self.shaded = self._own(
                context.framebuffer(
                    [self.textures.color, self.textures.surface, self.textures.object], depth
                )
            )
            self.shaded.depth_mask = False
        except moderngl.Error as error:
            self.release()
            raise LucidaError(
                "size", f"{size[0]}x{size[1]}: {error}", "choose a smaller image"
            ) from None
        except LucidaError:
            self.release()
            raise

    def _own(self, resource):  # type: ignore[no-untyped-def]
        self._owned.append(resource)
        return resource

    def release(self) -> None:
        for resource in reversed(self._owned):
            resource.release()
        self._owned.clear()
