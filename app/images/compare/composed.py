"""The pictures of the compare view, made on the GPU: difference, wipe, marked pixels.

They have the images' own size, and are drawn again only if something has changed.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.app.images.passes import Pass
from lucida.app.images.shown import Held, Picture
from lucida.renderer.compare.raster_and_ray import AGREE, LABEL_COLORS, SHADING
from lucida.renderer.images.difference import ABSOLUTE_COLORS, CHANNELS, FULL_SCALE, SIGNED_COLORS
from lucida.renderer.images.frame import Frame
from lucida.renderer.raster.display import COMPONENTS
from lucida.renderer.raster.resources import Owner, new_texture
from lucida.renderer.raster.targets import Textures
from lucida.renderer.system.memo import Memo

SIDES = "left", "right"  # of a wipe; everything else is "left"
RIM = 250  # a label: the dark border of a mark
MOST_ENLARGED = 0.002  # of the pixels; a cause that has more is not enlarged
LARGER_EVERY = 400  # pixels of the image's shorter side: there a mark is one pixel larger each way


@dataclass(frozen=True)
class Mapping:
    """The mapping from a difference to a colour; see renderer/images/difference.py."""

    channel: str = "color"
    component: str = "rgb"
    gain: float = 1.0
    signed: bool = False


class Composed:
    """The pictures, in a context that must be current in every call. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._difference = Pass(context, "difference.frag")
        self._compose = {side: Pass(context, "compose.frag") for side in SIDES}
        self._owner = Owner()
        self._maps = {
            False: self._row(ABSOLUTE_COLORS),
            True: self._row(SIGNED_COLORS),
        }
        self._label_colors = self._row(LABEL_COLORS)
        self._ray: dict[str, moderngl.Texture] = {}
        self._ray_frame: Frame | None = None
        self._no_ids = self._owner.own(new_texture(context, (1, 1), 1, np.int32))
        self._marks: moderngl.Texture | None = None
        self._mark = Memo(_write_marks)

    def color_map(self, signed: bool) -> moderngl.Texture:
        """Return the colour map as one row of pixels, for a colour bar."""
        return self._maps[signed]

    def difference(self, raster: Textures, drawn: object, ray: Frame, mapping: Mapping) -> Picture:
        """Return false colours, RGBA8, at the frame's size, which must be the textures' too.

        drawn: identifies the content of the raster textures.
        """
        if ray is not self._ray_frame:
            self._drop_ray()
            self._ray_frame = ray
        first = (raster.color if mapping.channel == "color" else raster.surface), drawn
        if mapping.channel == "id":
            objects = (raster.object, drawn), self._of_ray("id")
            return self._subtract(ray.size, first, first, mapping, objects)
        return self._subtract(ray.size, first, self._of_ray(mapping.channel), mapping)

    def _subtract(
        self,
        size: tuple[int, int],
        raster: Held,
        ray: Held,
        mapping: Mapping,
        objects: tuple[Held, Held] | None = None,
    ) -> Picture:
        first, second = objects or ((self._no_ids, None),) * 2
        signed, channel = mapping.signed and objects is None, mapping.channel
        return self._difference.draw(
            size,
            {
                "raster": raster,
                "ray": ray,
                "raster_object": first,
                "ray_object": second,
                "colors": (self._maps[signed], None),
            },
            channel=CHANNELS.index(channel),
            component=COMPONENTS[mapping.component] if channel == "color" else -1,
            gain=mapping.gain / FULL_SCALE[channel],
            has_sign=signed,
        )

    def compose(
        self,
        size: tuple[int, int],
        picture: Held,
        muted: bool = False,
        labels: NDArray[np.uint8] | None = None,
        enlarged: bool = True,
        side: str = SIDES[0],
    ) -> Picture:
        """Return `picture` at (width, height), with its marked pixels.

        muted: gray and dark. labels: those of renderer/compare/raster_and_ray.py, uint8
        (height, width): the pixels to mark in their causes' colours. enlarged: with a border, so
        that they are visible from a distance. side: one of SIDES; the next picture of a side
        overwrites its last one.
        """
        marks, colors = self._upload_marks(labels, enlarged), (self._label_colors, None)
        return self._compose[side].draw(
            size,
            {"picture": picture, "marks": marks or colors, "colors": colors},
            extent=(float(size[0]), float(size[1])),
            muted=float(muted),
            has_marks=marks is not None,
        )

    def release(self) -> None:
        self._drop_ray()
        if self._marks is not None:
            self._marks.release()
        self._owner.release()
        for compose in self._compose.values():
            compose.release()
        self._difference.release()

    def _row(self, colors: NDArray[np.uint8]) -> moderngl.Texture:
        rgba = np.full((1, len(colors), 4), 255, np.uint8)
        rgba[0, :, :3] = colors
        texture = self._owner.own(new_texture(self._gl, (len(colors), 1), 4, np.uint8))
        texture.write(rgba)
        return texture

    def _of_ray(self, channel: str) -> Held:
        assert self._ray_frame is not None
        if channel not in self._ray:
            values = np.ascontiguousarray(self._ray_frame.channel(channel))
            height, width = values.shape[:2]
            components = values.shape[2] if values.ndim == 3 else 1
            texture = new_texture(self._gl, (width, height), components, values.dtype)
            texture.write(values)
            self._ray[channel] = texture
        return self._ray[channel], None

    def _drop_ray(self) -> None:
        for texture in self._ray.values():
            texture.release()
        self._ray.clear()

    def _upload_marks(self, labels: NDArray[np.uint8] | None, enlarged: bool) -> Held | None:
        if labels is None:
            return None
        height, width = labels.shape
        if self._marks is None or self._marks.size != (width, height):
            if self._marks is not None:
                self._marks.release()
                self._marks = None
            self._marks = new_texture(self._gl, (width, height), 1, np.uint8)
        self._mark(self._marks, labels, enlarged)
        return self._marks, (labels, enlarged)


def _write_marks(texture: moderngl.Texture, labels: NDArray[np.uint8], enlarged: bool) -> None:
    texture.write(marks(labels) if enlarged else np.ascontiguousarray(labels))


def marks(labels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the labels with each differing pixel enlarged to 3 x 3, or more in a large image, in a
    border of RIM, so that it is visible from a distance. A cause with very many pixels is not
    enlarged.

    Unexplained pixels are never covered by explained ones.
    """
    i, j = np.nonzero(labels)
    found = labels[i, j]
    few = np.bincount(found, minlength=256)[found] <= MOST_ENLARGED * labels.size
    i, j, found = i[few], j[few], found[few]
    if not len(i):
        return np.ascontiguousarray(labels)
    height, width = labels.shape
    near = 1 + min(height, width) // LARGER_EVERY  # reach of the colour; the border's is one more
    edge = near + 1
    bad = found >= SHADING
    grown = np.full((height + 2 * edge, width + 2 * edge), AGREE, np.uint8)  # nothing wraps
    grown[edge:-edge, edge:-edge] = labels
    for di in range(2 * edge + 1):
        for dj in range(2 * edge + 1):
            grown[i + di, j + dj] = RIM
    for chosen in (~bad, bad):
        for di in range(1, 2 * edge):
            for dj in range(1, 2 * edge):
                grown[i[chosen] + di, j[chosen] + dj] = found[chosen]
    grown = grown[edge:-edge, edge:-edge]
    grown[i, j] = found  # neighbours that are enlarged do not hide what is there
    return np.ascontiguousarray(grown)
