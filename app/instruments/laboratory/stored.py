"""An image stored in one of the kinds, and its look when it is exposed afterwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.display import Bytes, from_srgb, luminance, to_srgb8
from lucida.renderer.images.files import HALF

from .kinds import BITMAP, COLOR, FLOAT, Kind


def kept(
    color: NDArray[np.float32], kind: Kind, taken_ev: float = 0.0, after_ev: float = 0.0
) -> Bytes:
    """Return a linear image (H, W, 3) as it is displayed after storage: uint8 (H, W, 3), sRGB.

    taken_ev, after_ev: exposures in stops, before and after it is stored. Floating point keeps
    linear light, and loses nothing. Bytes stay clipped. A bitmap is white where the gray is at
    least HALF, as in PBM files.
    """
    if kind is FLOAT:
        return to_srgb8(color, taken_ev + after_ev)
    stored = to_srgb8(color if kind is COLOR else luminance(color), taken_ev)
    if kind is BITMAP:
        stored = np.where(stored >= HALF, np.uint8(255), np.uint8(0))
    table = to_srgb8(from_srgb(np.arange(256, dtype=np.uint8)), after_ev)
    picture: Bytes = table[stored]
    return picture if kind is COLOR else np.repeat(picture[..., None], 3, axis=2)
