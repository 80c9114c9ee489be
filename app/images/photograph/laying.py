"""A photograph over a picture of an image, composed on the GPU.

There is one target for each picture, redrawn only if something has changed. The result is only for
display: the images, and the values read from them, are unchanged.
"""

from __future__ import annotations

import math
from collections.abc import Hashable

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.app.images.passes import Pass
from lucida.app.images.photograph.model import WHOLE, Parts
from lucida.app.images.placement import Placement
from lucida.app.images.shown import Picture
from lucida.renderer.raster.resources import new_texture


class Laying:
    """The composition, in a context that must be current in every call. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._passes: dict[Hashable, tuple[bool, Pass]] = {}
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
        covered: Parts,
        opacity: float = 1.0,
    ) -> Picture:
        """Return the picture of an image, placed in a window by `placement`, with the photograph.

        name: each picture is drawn over by the next of that name. covered: the part of the image
        that the photograph covers. opacity: from 0 to 1.
        """
        if self.texture is None:
            return picture
        size, at_whole = picture.texture.size, covered == WHOLE
        smaller = level(self.texture.size, placement, size, covered)
        exact = smaller == 0.0 and at_whole and self.texture.size == placement.size
        return self._pass(name, exact).draw(
            size,
            {"picture": picture.held, "photograph": (self.texture, None)},
            extent=(float(size[0]), float(size[1])),
            shown=placement.visible_parts,
            covered=covered,
            opacity=opacity,
            pixels=(float(placement.size[0]), float(placement.size[1])),
            level=smaller,
        )

    def _pass(self, name: Hashable, exact: bool) -> Pass:
        """Return the pass of that name; a new one if the shader differs."""
        if name in self._passes and self._passes[name][0] != exact:
            self._passes.pop(name)[1].release()
        if name not in self._passes:
            self._passes[name] = exact, Pass(self._gl, "photograph.frag", {"EXACT": exact})
        return self._passes[name][1]

    def release(self) -> None:
        self.take(None)
        for _, made in self._passes.values():
            made.release()
        self._passes.clear()


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
