"""A texture: an image on a surface, its coordinates, and its packed form for renderers.

In coordinates (u, v), u points to the right and v up; (0, 0) is the image's lower left corner and
(1, 1) its upper right one. Beyond these, the image is repeated (repeat), mirrored and repeated in
turn (mirror), or continued by the nearest texel of its border (clamp). Light is interpolated
linearly between the middles of four texels, in both directions, and always at full resolution,
however many texels a pixel covers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import number, numbers
from lucida.renderer.images.display import from_srgb
from lucida.renderer.images.shared_numbers import TEXEL_BITS
from lucida.renderer.system.errors import LucidaError

from .limits import TEXTURE_SIDE

WRAPS = ("repeat", "mirror", "clamp")  # by number
LARGEST_SCALE = 1e5
OPACITY_STEPS = 1 << 20


def is_final(value: object) -> bool:
    """Return True for an array that cannot be written, and can therefore be shared."""
    while isinstance(value, np.ndarray) and not value.flags.writeable:
        if value.flags.owndata:
            return True
        value = value.base
    return False


@dataclass(frozen=True, eq=False)
class Texture:
    """An image on a surface. texels: uint8 (height, width, 3), sRGB, row 0 at the top; or (height,
    width, 4) with opacity, which only cutouts use; read-only.

    wrap: along u and v, of WRAPS. scale, offset, rotate_deg: the lookup is at scale * (u, v),
    turned counter-clockwise by rotate_deg, + offset. file: the image file; None for an image that
    was made, or is inside another file.
    """

    texels: NDArray[np.uint8] = field(repr=False)
    wrap: tuple[str, str] = ("repeat", "repeat")
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)
    file: Path | None = None
    rotate_deg: float = 0.0

    def __post_init__(self) -> None:
        texels = self.texels
        if not is_final(texels):
            texels = np.array(texels, order="C")  # the caller's own array may change
        if texels.dtype != np.uint8 or texels.ndim != 3 or texels.shape[2] not in (3, 4):
            problem = f"is {texels.dtype} of shape {texels.shape}"
            raise LucidaError("texels", problem, "give uint8, height x width x 3 or 4")
        if not 1 <= min(texels.shape[:2]) <= max(texels.shape[:2]) <= TEXTURE_SIDE:
            problem = f"is {texels.shape[1]}x{texels.shape[0]}"
            raise LucidaError("texels", problem, f"give 1 to {TEXTURE_SIDE} pixels a side")
        texels.setflags(write=False)
        object.__setattr__(self, "texels", texels)
        object.__setattr__(self, "wrap", tuple(self.wrap))
        for way in self.wrap:
            if way not in WRAPS or len(self.wrap) != 2:
                raise LucidaError("wrap", f"{way!r} is unknown", f"give two of {', '.join(WRAPS)}")
        for name in ("scale", "offset"):
            object.__setattr__(self, name, _pair(name, getattr(self, name)))
        turn = number("rotate_deg", self.rotate_deg)
        if abs(turn) > LARGEST_SCALE:
            raise LucidaError("rotate_deg", f"{turn:g} is too large", "give degrees, e.g. 90")
        object.__setattr__(self, "rotate_deg", turn)

    @property
    def size(self) -> tuple[int, int]:
        """Return (width, height)."""
        return self.texels.shape[1], self.texels.shape[0]

    @property
    def place(self) -> NDArray[np.float64]:
        """Return the matrix (2, 3) from (u, v, 1) to the coordinates of the lookup."""
        turn = math.radians(self.rotate_deg % 360.0)
        cosine, sine = math.cos(turn), math.sin(turn)
        if self.rotate_deg % 90.0 == 0.0:
            cosine, sine = round(cosine), round(sine)
        (a, d), (u, v) = self.scale, self.offset
        return np.array([[cosine * a, -sine * d, u], [sine * a, cosine * d, v]])

    def in_texels(self, size: tuple[int, int] | None = None) -> NDArray[np.float64]:
        """Return the matrix (2, 3) from (u, v, 1) to texel coordinates, columns and rows from the
        image's upper left corner. size: (width, height) of the image if it was resized.
        """
        width, height = size or self.size
        columns, rows = self.place
        return np.array([columns * width, (np.array([0.0, 0.0, 1.0]) - rows) * height])


def placed_alike(first: Texture, second: Texture) -> bool:
    """Return True if two textures show the same place at the same coordinates."""
    return first.wrap == second.wrap and bool(np.allclose(first.place, second.place, atol=1e-6))


def packed_texels(texels: NDArray[np.uint8]) -> NDArray[np.int32]:
    """Return texels in the renderers' form, one number each, (height, width): red in the lowest
    TEXEL_BITS, then green and blue, each the square root of linear light.

    A square root is close to the sRGB curve, and one multiplication inverts it. With 10 bits, the
    error is less than a fifth of an 8-bit step of sRGB.
    """
    return _packed(
        _roots(from_srgb(np.arange(256, dtype=np.uint8)).astype(np.float64))[texels[..., :3]]
    )


def packed_light(light: NDArray[np.floating]) -> NDArray[np.int32]:
    """Return packed_texels() of linear light, (height, width, 3), 0 to 1."""
    return _packed(_roots(np.clip(light, 0, 1)))


def _roots(light: NDArray[np.floating]) -> NDArray[np.int32]:
    return np.rint(np.sqrt(light) * ((1 << TEXEL_BITS) - 1)).astype(np.int32)


def _packed(roots: NDArray[np.int32]) -> NDArray[np.int32]:
    packed: NDArray[np.int32] = (
        roots[..., 0] | roots[..., 1] << TEXEL_BITS | roots[..., 2] << 2 * TEXEL_BITS
    )
    return packed


def packed_opacity(texels: NDArray[np.uint8], cutout: float) -> NDArray[np.int32]:
    """Return the opacity of texels minus `cutout`, (height, width): less than 0 in a hole. All
    numbers are exact in float32.
    """
    each = np.rint((np.arange(256) / 255 - min(cutout, 2.0)) * OPACITY_STEPS).astype(np.int32)
    opacity = texels[..., 3] if texels.shape[2] == 4 else np.full(texels.shape[:2], 255, np.uint8)
    return np.asarray(each[opacity])


def _pair(name: str, value: Iterable[float]) -> tuple[float, float]:
    first, second = numbers(name, value, 2)
    if (largest := max(abs(first), abs(second))) > LARGEST_SCALE:
        raise LucidaError(name, f"{largest:g} is too large", f"stay within {LARGEST_SCALE:g}")
    return first, second


WHITE = Texture(np.full((1, 1, 3), 255, np.uint8))  # the texture of a metal without one
