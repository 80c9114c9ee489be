"""Targets: the framebuffers and textures for images of one size."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.errors import LucidaError

from .lens_targets import LensTargets
from .resources import Owner, check, new_texture

Region = tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class Textures:
    """The rasterizer's image on the GPU; row 0 of each texture is the image's top row.

    color: RGBA32F, linear light. surface: RGBA32F, the normal, and t (infinity if nothing is hit).
    object, primitive: R32I, -1 if nothing is hit. The rasterizer owns them; its next draw()
    overwrites them, or replaces them if the size changes.
    """

    color: moderngl.Texture
    surface: moderngl.Texture
    object: moderngl.Texture
    primitive: moderngl.Texture


class Targets:
    """Framebuffers of one size, (width, height).

    seen: receives primitives and depth. shaded: receives the rest, and only reads the depth. lens:
    further targets for the image of a lens.
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
        self.lens = self._owner.own(LensTargets(context))
        try:
            self._build(context, size)
        except moderngl.Error as error:
            self.release()
            problem = f"{size[0]}x{size[1]}: {error}"
            raise LucidaError("size", problem, "select a smaller image") from None
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
        self.depth = depth = own(context.depth_renderbuffer(size))
        check(context, f"a depth buffer of {size[0]}x{size[1]}")
        textures = self.textures
        self.seen = own(context.framebuffer([textures.primitive], depth))
        shaded = [textures.color, textures.surface, textures.object]
        self.shaded = own(context.framebuffer(shaded, depth))
        self.shaded.depth_mask = False

    def read(
        self, channels: Iterable[str], region: Region | None = None
    ) -> dict[str, NDArray[np.float32] | NDArray[np.int32]]:
        """Return channels (see frame.py) of the last image, or of a part of it, by name. Wait until
        it is drawn.

        region: first row and column, one past the last of each.
        """
        read: dict[tuple[moderngl.Framebuffer, int], NDArray] = {}  # two channels share a texture
        arrays = {}
        for channel in channels:
            source, attachment, parts = self._place_of(channel)
            if (source, attachment) not in read:
                read[source, attachment] = self._attachment(source, attachment, region)
            arrays[channel] = np.ascontiguousarray(read[source, attachment][..., parts])
        return arrays

    def _place_of(self, channel: str) -> tuple[moderngl.Framebuffer, int, Any]:
        """Return framebuffer, attachment, and components."""
        return {
            "color": (self.shaded, 0, slice(3)),
            "normal": (self.shaded, 1, slice(3)),
            "depth": (self.shaded, 1, 3),
            "id": (self.shaded, 2, 0),
            "primitive": (self.seen, 0, 0),
        }[channel]

    def _attachment(
        self, source: moderngl.Framebuffer, attachment: int, region: Region | None
    ) -> NDArray:
        """Return float32 (height, width, 4), or int32 (height, width, 1)."""
        top, left, bottom, right = region or (0, 0, self.size[1], self.size[0])
        texture = source.color_attachments[attachment]
        assert isinstance(texture, moderngl.Texture)
        shape = bottom - top, right - left, texture.components
        values = np.empty(shape, np.float32 if texture.dtype == "f4" else np.int32)
        source.read_into(
            values,
            viewport=(left, top, right - left, bottom - top),
            components=texture.components,
            attachment=attachment,
            dtype=texture.dtype,
        )
        return values

    def release(self) -> None:
        self._owner.release()
