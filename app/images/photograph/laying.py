"""A photograph over or behind a picture of an image, composed on the GPU.

There is one target for each picture, redrawn only if something has changed. The result is only for
display: the images, and the values read from them, are unchanged.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from app.images.passes import Pass
from app.images.photograph.model import WHOLE, Parts
from app.images.placement import Placement
from app.images.shown import Held, Picture
from renderer.raster.resources import Owner, new_texture


@dataclass(frozen=True)
class LaidPhotograph:
    """The laying of a photograph. covered: the part of the image. opacity: from 0 to 1. behind:
    only where nothing is hit.
    """

    covered: Parts
    opacity: float = 1.0
    behind: bool = False


class Laying:
    """The composition, in a context that must be current in every call. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = Owner()
        self._none = self._owner.own(new_texture(context, (1, 1), 1, np.int32))
        self._passes: dict[Hashable, tuple[tuple[bool, bool], Pass]] = {}
        self.texture: moderngl.Texture | None = None

    def take(self, pixels: NDArray[np.uint8] | None) -> None:
        """Replace the photograph by this one, uint8 (height, width, 4); None removes it."""
        if self.texture is not None:
            self.texture.release()
            self.texture = None
        if pixels is not None:
            height, width = pixels.shape[:2]
            texture = new_texture(self._gl, (width, height), 4, np.uint8)
            texture.write(np.ascontiguousarray(pixels))
            texture.build_mipmaps()
            texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
            self.texture = texture

    def laid(
        self,
        name: Hashable,
        picture: Picture,
        placement: Placement,
        laid: LaidPhotograph,
        objects: Held | None = None,
    ) -> Picture:
        """Return the picture of an image, placed in a window by `placement`, with the photograph.

        Laying behind needs objects: the number of each pixel's object, int32, row 0 at the top;
        without them nothing is laid. name: each picture is drawn over by the next of that name.
        """
        if self.texture is None or (laid.behind and objects is None):
            return picture
        size, at_whole = picture.texture.size, laid.covered == WHOLE
        smaller = level(self.texture.size, placement, size, laid.covered)
        exact = smaller == 0.0 and at_whole and self.texture.size == placement.size
        return self._pass(name, exact, laid.behind).draw(
            size,
            {
                "picture": picture.held,
                "photograph": (self.texture, None),
                "objects": objects if objects is not None and laid.behind else (self._none, None),
            },
            extent=(float(size[0]), float(size[1])),
            shown=placement.visible_parts,
            covered=laid.covered,
            opacity=laid.opacity,
            pixels=(float(placement.size[0]), float(placement.size[1])),
            level=smaller,
        )

    def _pass(self, name: Hashable, exact: bool, behind: bool) -> Pass:
        """Return the pass of that name; a new one if the shader differs."""
        kind = exact, behind
        if name in self._passes and self._passes[name][0] != kind:
            self._passes.pop(name)[1].release()
        if name not in self._passes:
            constants = {"EXACT": exact, "BEHIND": behind}
            self._passes[name] = kind, Pass(self._gl, "photograph.frag", constants)
        return self._passes[name][1]

    def release(self) -> None:
        self.take(None)
        for _, made in self._passes.values():
            made.release()
        self._passes.clear()
        self._owner.release()


def level(photo: tuple[int, int], placement: Placement, size: tuple[int, int], at: Parts) -> float:
    """Return how often the photograph is halved if a target of `size` pixels shows it smaller than
    it is.

    0: its own pixels are visible.
    """
    left, top, right, bottom = placement.visible_parts
    across = photo[0] * (right - left) / (size[0] * (at[2] - at[0]))
    down = photo[1] * (bottom - top) / (size[1] * (at[3] - at[1]))
    times = max(across, down)
    return math.log2(times) if times > 1.01 else 0.0
