"""An image on its way to the screen: its look, and the visible part.

A picture is drawn again only if its inputs have changed.

ImGui samples every texture linearly. A picture of exactly its size on the screen is therefore
reproduced exactly, with square enlarged pixels and no blur. Only the visible part of a magnified
image is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl

from lucida.renderer.raster import Display, Look, Section
from lucida.renderer.raster.resources import new_texture
from lucida.renderer.system.memo import Memo

from .placement import Placement, Size


@dataclass(frozen=True, eq=False)
class DepthBounds:
    """The depths from white to the darkest gray, on the GPU; each measurement has a new object."""

    texture: moderngl.Texture


@dataclass(frozen=True, eq=False)
class Picture:
    """The visible part of an image. made: an object that is new whenever the content is."""

    texture: moderngl.Texture
    made: object


# A texture for Display.show(), and an object that is new whenever the texture's pixels are.
Source = tuple[moderngl.Texture, object]


class _Target:
    """A picture's texture and framebuffer, and the cached drawing into them."""

    def __init__(self, context: moderngl.Context, texture: moderngl.Texture) -> None:
        self.texture, self.framebuffer = texture, context.framebuffer([texture])
        self.draw = Memo(_show)

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


class Pictures:
    """Images in a context, which must be current in every call. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._display = Display(context)
        self._pictures: dict[str, _Target] = {}
        self._retired: list[_Target] = []

    def picture(
        self,
        name: str,
        look: Look,
        placement: Placement,
        source: Source,
        depths: DepthBounds | None = None,
    ) -> Picture:
        """Return the visible part of an image in a window.

        name: of the picture, which the next call with the same name overwrites. The texture stays
        until the frame after the next, even if another replaces it. source: of the look's channel.
        """
        section = section_of(placement, source[0].size)
        needed = depths if look.channel == "depth" else None
        target = self._of_size(name, visible_size(placement))
        made = target.draw(self._display, source, look, section, target.framebuffer, needed)
        return Picture(target.texture, made)

    def begin_frame(self) -> None:
        """Release textures that the frame before the last may have shown.

        Call this once a frame.
        """
        for picture in self._retired:
            picture.release()
        self._retired.clear()

    def release(self) -> None:
        self._retired += self._pictures.values()
        self._pictures.clear()
        self.begin_frame()
        self._display.release()

    def _of_size(self, name: str, size: Size) -> _Target:
        """Return the target of a picture."""
        picture = self._pictures.get(name)
        if picture is None or picture.texture.size != size:
            # The window may show the old one in this frame, so its OpenGL name must not be reused.
            if picture is not None:
                self._retired.append(self._pictures.pop(name))
            picture = _Target(self._gl, new_texture(self._gl, size, 4, "uint8"))
            self._pictures[name] = picture
        return picture


def _show(
    display: Display,
    source: Source,
    look: Look,
    section: Section,
    target: moderngl.Framebuffer,
    depths: DepthBounds | None,
) -> object:
    """Draw, and return an object that identifies the result."""
    display.show(source[0], look, section, target, depths.texture if depths else None)
    return object()


def section_of(placement: Placement, texels: Size) -> Section:
    """Return the part of an image's texture for a target of the visible part's size.

    texels: (width, height) of the texture, less than the image's if that is coarse. The nearest
    texel is used if pixels are magnified to whole squares, or represent several; otherwise, the
    mean over a screen pixel is used.
    """
    left, top, *_ = placement.visible
    per_pixel = texels[0] / placement.extent[0], texels[1] / placement.extent[1]
    coarse = texels != placement.size
    averaged = max(per_pixel) > 1.0001 or not (coarse or placement.whole)
    origin = float(placement.origin[0] - left), float(placement.origin[1] - top)
    return Section(origin, per_pixel, averaged)


def visible_size(placement: Placement) -> Size:
    """Return the (width, height) of the visible part of an image, in screen pixels."""
    left, top, right, bottom = placement.visible
    return right - left, bottom - top


def whole(size: Size) -> Placement:
    """Return the placement of an image at its own size."""
    return Placement(size, size, 1.0, (0, 0), size)
