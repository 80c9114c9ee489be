"""An image as a height field: a function over its plane, seen from in front and above. Pure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.images.display import Bytes, luminance, to_srgb8

TALL, DEEP = 0.4, 0.5  # the height of white, and the plane from front to back, of the picture's
SLANT = 0.2  # of the picture's width, by which the back is moved to the right
LINES = 24  # along the plane from left to right
DARKER = 0.45  # of their colour


def height_field(color: NDArray[np.float32], size: tuple[int, int], exposure_ev: float) -> Bytes:
    """Return a picture (height, width, 3) of a landscape that is as high as the image is bright.

    color: linear, (H, W, 3). size: (width, height) of the picture. Its height is luminance in
    linear light, up to 1. Row 1 of the image is at the back.
    """
    width, height = size
    picture = np.zeros((height, width, 3), np.uint8)
    tall, deep, slant = int(TALL * height), int(DEEP * height), int(SLANT * width)
    if min(tall, deep, width - slant) < 2:
        return picture
    across = np.linspace(0, color.shape[1] - 1, width - slant).round().astype(int)
    along = np.linspace(0, color.shape[0] - 1, deep).round().astype(int)
    seen = color[along][:, across] * np.float32(2.0**exposure_ev)
    heights = (np.clip(luminance(seen), 0, 1) * tall).round().astype(int)
    ground = to_srgb8(seen)
    up = np.arange(tall, -1, -1)[:, None]
    every = max(1, deep // LINES)
    first = (height - tall - deep) // 2
    for k in range(deep):  # from the back: what is nearer covers what is behind it
        left = round(slant * (1 - k / deep))
        block = picture[first + k : first + k + tall + 1, left : left + width - slant]
        np.copyto(block, ground[k], where=(up <= heights[k])[..., None])
        if k % every == 0:
            line = (ground[k] * DARKER).astype(np.uint8)
            np.copyto(block, line, where=(up == heights[k])[..., None])
    return picture
