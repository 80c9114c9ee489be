"""The display transform on the GPU: from an image's channels to 8-bit textures for a screen.

The false colours are computed there, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import moderngl
import numpy as np
from numpy.typing import NDArray

from .resources import Owner, new_texture
from .screen_pass import cover, new_array, plain_state, set_uniforms

SQUARES = 32


@dataclass(frozen=True)
class Look:
    """The appearance of an image.

    exposure_ev, transfer: of the colour. dissolved: the progress, 0 to 1, of dissolving the image
    into flat squares with the values of their middles, at last SQUARES in a row.
    """

    channel: Literal["color", "depth", "normal", "id"] = "color"
    exposure_ev: float = 0.0
    transfer: Literal["srgb", "linear"] = "srgb"
    dissolved: float = 0.0


@dataclass(frozen=True)
class Section:
    """The part of an image that a target shows.

    origin: the image's upper left corner in the target, in its pixels.
    texels_per_pixel: along x and y.
    averaged: area-weighted means; otherwise the nearest texel.
    """

    origin: tuple[float, float] = (0.0, 0.0)
    texels_per_pixel: tuple[float, float] = (1.0, 1.0)
    averaged: bool = False


class Display:
    """A renderer of images for the screen, in a context that must be current."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = Owner()
        self._screens: dict[tuple[bool, ...], moderngl.VertexArray] = {}

    def show(
        self,
        source: moderngl.Texture,
        look: Look,
        section: Section,
        target: moderngl.Framebuffer,
        depth_range: moderngl.Texture | None = None,
    ) -> None:
        """Draw an image into a target of 8-bit colours.

        source: a texture of the look's channel: linear light, the ray parameter in its fourth
        component, the normal, or objects as int32. depth_range: one pixel, see DepthRange; needed
        for the depth. Leaves the framebuffer binding unchanged, and depth test, culling and
        blending off.
        """
        with plain_state(self._gl, 3):
            target.use()
            # Samplers of different kinds must not share a unit, used or not.
            source.use(1 if look.channel == "id" else 0)
            if depth_range is not None:
                depth_range.use(2)
            cover(
                self._screen_of(look, section),
                exposure=exposure_factor(look.exposure_ev),
                origin=section.origin,
                texels_per_pixel=section.texels_per_pixel,
                square=max(1.0, source.width / SQUARES) ** look.dissolved,
            )

    def release(self) -> None:
        self._owner.release()

    def _screen_of(self, look: Look, section: Section) -> moderngl.VertexArray:
        """Return a program specialised for this look, compiled on first use. It takes a quarter of
        the time of a general one.
        """
        constants = {
            "SHOWS_COLOR": look.channel == "color",
            "SHOWS_DEPTH": look.channel == "depth",
            "SHOWS_NORMAL": look.channel == "normal",
            "IS_LINEAR": look.channel == "color" and look.transfer == "linear",
            "AVERAGED": section.averaged and not look.dissolved,
        }
        key = tuple(constants.values())
        if key not in self._screens:
            screen = new_array(self._owner, self._gl, "screen.vert", "display.frag", constants)
            set_uniforms(screen.program, values=0, numbers=1, depth_range=2)
            self._screens[key] = screen
        return self._screens[key]


def exposure_factor(exposure_ev: float) -> float:
    return 2.0 ** min(max(exposure_ev, -100.0), 100.0)


def upload(
    context: moderngl.Context, array: NDArray, texture: moderngl.Texture | None = None
) -> moderngl.Texture:
    """Upload a channel of a frame (renderer/images/frame.py) as a texture for Display.show().

    texture: one to overwrite; it is released if it does not fit. Raises LucidaError if memory is
    exhausted; the old texture is released then, too.
    """
    height, width = array.shape[:2]
    components = 1 if array.ndim == 2 else array.shape[2]
    dtype, kind = (np.int32, "i4") if array.dtype == np.int32 else (np.float32, "f4")
    form = (width, height), components, kind
    if texture is not None and (texture.size, texture.components, texture.dtype) != form:
        texture.release()
        texture = None
    if texture is None:
        texture = new_texture(context, (width, height), components, dtype)
        if components == 1 and kind == "f4":
            texture.swizzle = "RRRR"  # shaders read the ray parameter from the fourth component
    texture.write(np.ascontiguousarray(array))
    return texture
