"""From gray to one bit per pixel: a threshold, an ordered dither, and error diffusion.

Knows nothing of colours, files or windows. Values are linear light in 0..1, where 1 is white: the
dithers keep its mean, so that from afar a region of bits sends the light that the gray did.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.images.display import from_srgb
from renderer.images.files import HALF

Bits = NDArray[np.bool_]

# Linear light of the darkest gray that the threshold shows white: the PBM writer's, 128 of sRGB.
THRESHOLD = float((from_srgb(np.uint8(HALF)) + from_srgb(np.uint8(HALF - 1))) / 2)


def bayer(order: int) -> NDArray[np.int64]:
    """Bayer's matrix of 2^order rows: each of 0 .. 4^order - 1 once, neighbours far apart.

    Source: Bayer 1973, by its recursion M(2n) = [4M, 4M + 2; 4M + 3, 4M + 1].
    """
    matrix = np.zeros((1, 1), np.int64)
    for _ in range(order):
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return matrix


BAYER_8 = bayer(3)
BAYER_8.setflags(write=False)


def threshold(gray: ArrayLike, at: float = THRESHOLD) -> Bits:
    """White where the gray (height, width) is at least `at`."""
    return np.asarray(gray) >= at


def ordered(gray: ArrayLike) -> Bits:
    """White where the gray (height, width) exceeds the place's own threshold, (b + 0.5) / 64 with b
    of Bayer's 8 x 8 matrix, which repeats from the top left corner."""
    values = np.asarray(gray)
    height, width = values.shape
    limits = (BAYER_8 + 0.5) / BAYER_8.size
    i, j = np.ogrid[:height, :width]
    return values > limits[i % 8, j % 8]


def floyd_steinberg(gray: ArrayLike) -> Bits:
    """Row by row from the left: white where the value, with the errors so far, is at least 0.5;
    the error goes on to the right (7/16), below left (3/16), below (5/16), below right (1/16).

    gray: (height, width), clipped to 0..1. Pixels with the same j + 2i depend on none of each
    other: they are done together, as one wavefront, in float64 and with the sums in the order of
    the plain loop, so that not one bit differs from it. Source: Floyd and Steinberg 1976.
    """
    values = np.clip(np.nan_to_num(np.asarray(gray, float)), 0.0, 1.0)
    height, width = values.shape
    if not values.size:
        return np.zeros((height, width), np.bool_)
    # In row-major order, one row down and two columns left is `step` on; it must be above 0.
    row = max(width, 3)
    padded = np.zeros((height, row))
    padded[:, :width] = values
    flat, step = padded.reshape(-1), row - 2
    white = np.zeros(flat.size, np.bool_)
    # The errors of the last three wavefronts, by row; entry 0 stands for the row above the image.
    errors = [np.zeros(height + 1) for _ in range(4)]
    for k in range(width + 2 * (height - 1)):
        first = max(0, (k - width + 2) // 2)
        last = min(height - 1, k // 2)
        # A single column has every second wavefront empty: then first is last + 1.
        here, above = slice(first + 1, last + 2), slice(first, last + 1)
        one, two, three = (errors[(k - back) % 4] for back in (1, 2, 3))
        places = slice(k + first * step, k + last * step + 1, step)
        value = flat[places] + three[above] * (1 / 16)  # from above left
        value += two[above] * (5 / 16)  # from above
        value += one[above] * (3 / 16)  # from above right
        value += one[here] * (7 / 16)  # from the left
        bits = value >= 0.5
        white[places] = bits
        now = errors[k % 4]
        now[:] = 0.0
        np.subtract(value, bits, out=now[here])
    return white.reshape(height, row)[:, :width]


METHODS: dict[str, Callable[[ArrayLike], Bits]] = {
    "threshold": threshold,
    "ordered": ordered,
    "floyd-steinberg": floyd_steinberg,
}
TITLES = {
    "threshold": "Threshold",
    "ordered": "Ordered dither (8 x 8)",
    "floyd-steinberg": "Floyd-Steinberg",
}
