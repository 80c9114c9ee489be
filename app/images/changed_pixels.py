"""The pixels in which two displayed pictures differ visibly, and a picture of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]

SEEN = 2  # of 255: pixels that differ by more are marked
GRAY = 0.4  # brightness of the other pixels
MARK = (255, 176, 0)


def changed_pixels(right: Bytes, wrong: Bytes) -> NDArray[np.bool_]:
    """Return the pixels in which two displayed pictures differ visibly, (H, W)."""
    differs: NDArray[np.bool_] = (
        np.abs(right.astype(np.int16) - wrong.astype(np.int16)).max(axis=2) > SEEN
    )
    return differs


def difference_picture(right: Bytes, changed: NDArray[np.bool_]) -> Bytes:
    """Return the differing pixels, bright on the correct picture in dark gray."""
    gray = (GRAY * right.mean(axis=2)).astype(np.uint8)
    picture: Bytes = np.repeat(gray[..., None], 3, axis=2)
    picture[changed] = MARK
    return picture
