"""Pictures of an answer as arrays: the given image, the right one, their difference. Pure.

Light is linear, (H, W, 3); pictures are uint8 (H, W, 3), sRGB.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from renderer.difference import false_color, most
from renderer.images.display import encode_srgb, to_srgb8

Bytes = NDArray[np.uint8]
SAME_COLOR = (70, 84, 104)  # in the difference: another ray that happens to have the same colour
LEAST_SEEN = 1.5 / 255
LARGEST_SIDE = 512  # of an image that a function made


@dataclass(frozen=True, eq=False)
class CodePictures:
    """came: which pixels of the given one are there, bool (H, W)."""

    given: Bytes
    right: Bytes
    difference: Bytes
    came: NDArray[np.bool_]

    @property
    def size(self) -> tuple[int, int]:
        height, width = self.right.shape[:2]
        return width, height


def compared(
    given: NDArray[np.float32],
    right: NDArray[np.float32],
    came: NDArray[np.bool_],
    wrong: NDArray[np.bool_],
    exposure_ev: float = 0.0,
) -> CodePictures:
    """wrong: pixels that are wrong, whatever their colour."""
    given = np.where(came[..., None], given, 0).astype(np.float32)
    apart = np.abs(most(encode_srgb(right) - encode_srgb(given)))
    difference = false_color(apart, "color")
    difference[wrong & came & (apart < LEAST_SEEN)] = SAME_COLOR
    difference[~came] = 0
    return CodePictures(to_srgb8(given, exposure_ev), to_srgb8(right, exposure_ev), difference, came)


def image_pair(right: object, given: object) -> CodePictures | None:
    """The images of an answer that is one, in linear light or gray from 0 to 1; None of others."""
    pair = [np.asarray(one) for one in (right, given)]
    if any(one.dtype.kind not in "fiub" or one.ndim not in (2, 3) for one in pair):
        return None
    if pair[0].shape != pair[1].shape or not 1 <= max(pair[0].shape[:2]) <= LARGEST_SIDE:
        return None
    if pair[0].ndim == 3 and pair[0].shape[2] != 3:
        return None
    first, second = (
        (one if one.ndim == 3 else np.repeat(one[..., None], 3, axis=2)).astype(np.float32)
        for one in pair
    )
    came = np.isfinite(second).all(axis=2)
    return compared(second, first, came, np.zeros(came.shape, bool))
