"""An image as it is kept in one of the kinds, and what is seen when it is exposed afterwards.

Floating point keeps linear light, unexposed; the others keep what a picture taken at some exposure
has.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.instruments.laboratory.kinds import BITMAP, FLOAT, GRAY, Kind
from lucida.renderer.images.display import Bytes, from_srgb, luminance, to_srgb8
from lucida.renderer.images.files import HALF


@dataclass(frozen=True, eq=False)
class Stored:
    """kind: what it is kept as. array: bool (H, W) for a bitmap, uint8 (H, W) for gray, uint8
    (H, W, 3) for colour, float32 (H, W, 3), linear light, for floating point. taken_ev: the
    exposure at which it was taken; it is in the array of all kinds but the last."""

    kind: Kind
    array: NDArray[Any]
    taken_ev: float


def store(color: ArrayLike, kind: Kind, taken_ev: float = 0.0) -> Stored:
    """Return a linear image (H, W, 3) as it is kept in `kind`.

    taken_ev: the picture's exposure, in stops. A bitmap is white where the gray is, like in PBM
    files, at least HALF.
    """
    linear = np.asarray(color, np.float32)
    if kind is FLOAT:
        return Stored(kind, linear, taken_ev)
    kept = to_srgb8(luminance(linear) if kind in (BITMAP, GRAY) else linear, taken_ev)
    return Stored(kind, kept >= HALF if kind is BITMAP else kept, taken_ev)


def shown(stored: Stored, after_ev: float = 0.0) -> Bytes:
    """Return the stored image, exposed by a further `after_ev` stops and displayed: uint8
    (H, W, 3), sRGB.

    What was clipped when it was stored stays clipped at any exposure; floating point loses nothing.
    """
    if stored.array.dtype == np.uint8:
        table = to_srgb8(from_srgb(np.arange(256, dtype=np.uint8)), after_ev)
        picture = table[stored.array]
    elif stored.array.dtype == np.bool_:
        black, white = to_srgb8([0.0, 1.0], after_ev)
        picture = np.where(stored.array, white, black)
    else:
        picture = to_srgb8(stored.array, after_ev + stored.taken_ev)
    return np.repeat(picture[..., None], 3, axis=2) if picture.ndim == 2 else picture
