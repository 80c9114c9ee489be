"""An image as it is kept in one of the kinds, and what is seen when it is exposed afterwards.

Owns the way there and back. Knows nothing of windows. Float kinds keep linear
light, unexposed; the others keep what a picture taken at some exposure has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.laboratory.bitmaps import METHODS
from app.laboratory.kinds import BITMAP, GRAY, Kind
from renderer.images.display import Bytes, from_srgb, luminance, to_srgb8

HALF_LARGEST = 65504.0  # half float's largest number


@dataclass(frozen=True, eq=False)
class Stored:
    """kind: what it is kept as. array: bool (H, W) for a bitmap, uint8 (H, W) for gray, uint8
    (H, W, 3) for colour, float16 or float32 (H, W, 3), linear light. taken_ev: the exposure at
    which it was taken; it is in the array of all kinds but the float ones."""

    kind: Kind
    array: NDArray
    taken_ev: float

    @property
    def size(self) -> tuple[int, int]:
        return self.array.shape[1], self.array.shape[0]

    @property
    def storage_bytes(self) -> int:
        return self.kind.storage_bytes(self.size)


def store(color: ArrayLike, kind: Kind, taken_ev: float = 0.0, method: str = "threshold") -> Stored:
    """A linear image (H, W, 3) as it is kept in `kind`.

    taken_ev: the picture's exposure, in stops. method: one of bitmaps.METHODS, for bitmaps: it is
    given the luminance, Rec. 709's weights of red, green and blue. Numbers beyond half float's
    largest become that; NaN is black in all but single float.
    """
    linear = np.asarray(color, np.float32)
    if kind is BITMAP:
        with np.errstate(over="ignore", invalid="ignore"):
            exposed = luminance(linear) * np.float32(2.0**taken_ev)
        return Stored(kind, METHODS[method](exposed), taken_ev)
    if kind is GRAY:
        return Stored(kind, to_srgb8(luminance(linear), taken_ev), taken_ev)
    if not kind.is_float:
        return Stored(kind, to_srgb8(linear, taken_ev), taken_ev)
    if kind.name == "half":
        finite = np.clip(np.nan_to_num(linear), -HALF_LARGEST, HALF_LARGEST)
        return Stored(kind, finite.astype(np.float16), taken_ev)
    return Stored(kind, linear.copy(), taken_ev)


def shown(stored: Stored, after_ev: float = 0.0) -> Bytes:
    """The stored image exposed by a further `after_ev` stops and displayed: uint8 (H, W, 3), sRGB.

    What was clipped when it was stored stays white at any exposure, and the steps between 8-bit
    numbers show as bands when it is brightened; float kinds lose neither.
    """
    gain_ev = after_ev + stored.taken_ev if stored.kind.is_float else after_ev
    if stored.array.dtype == np.uint8:
        table = to_srgb8(from_srgb(np.arange(256, dtype=np.uint8)), gain_ev)
        picture = table[stored.array]
    elif stored.array.dtype == np.bool_:
        black, white = to_srgb8([0.0, 1.0], gain_ev)
        picture = np.where(stored.array, white, black)
    else:
        picture = to_srgb8(stored.array, gain_ev)
    return np.repeat(picture[..., None], 3, axis=2) if picture.ndim == 2 else picture


def clipped(color: ArrayLike, taken_ev: float = 0.0) -> NDArray[np.bool_]:
    """Return where a picture taken at that exposure loses light: bool (H, W), a channel is
    above 1.
    """
    with np.errstate(over="ignore"):
        exposed = np.asarray(color, np.float32) * np.float32(2.0**taken_ev)
    return np.asarray((exposed > 1).any(axis=-1))


def levels(picture: Bytes) -> int:
    """Return the number of different values in the fullest channel of a picture (H, W, 3), at most
    256.
    """
    planes = (picture[..., channel].reshape(-1) for channel in range(picture.shape[2]))
    return max(int(np.count_nonzero(np.bincount(plane))) for plane in planes)
