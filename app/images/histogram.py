"""The histogram of an image as displayed: of red, green and blue.

Pure NumPy on an image that has been traced or read back already.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.images.pixelvalues import color_bytes
from app.state.options import ImageOptions

VALUES = 256
MOST_PIXELS = 1 << 19  # of a larger image, every n-th row and column: the shape is the same
HIGHEST = 10  # the bar that counts for the height: those of a plain background are cut
ROOM = 1.3  # over the highest bar that is not cut


@dataclass(frozen=True, eq=False)
class Histogram:
    """The counts of an image's values.

    counts: of pixels, float32 (3, 256). top: the count that fills the height; higher bars are cut.
    every: which rows and columns are counted: 1 for all.
    """

    counts: NDArray[np.float32]
    top: float
    every: int


def histogram(color: NDArray[np.float32], options: ImageOptions) -> Histogram:
    """Count linear colours (height, width, 3) after the display transform of the options."""
    every = max(1, math.ceil(math.sqrt(color.shape[0] * color.shape[1] / MOST_PIXELS)))
    shown = color_bytes(color[::every, ::every], options)
    counts = [np.bincount(shown[..., k].ravel(), minlength=VALUES) for k in range(3)]
    order = np.sort(np.concatenate(counts))
    high = order[-HIGHEST] or order[-1]
    return Histogram(np.array(counts, np.float32), ROOM * max(float(high), 1.0), every)
