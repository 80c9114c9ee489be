"""Pictures of an answer as arrays: the given image, the correct one, their difference. Pure.

Light is linear, (H, W, 3); pictures are uint8 (H, W, 3), sRGB.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.reports.picture import changed_pixels, difference_picture
from lucida.app.instruments.mistakes.model import told_difference
from lucida.renderer.images.display import to_srgb8

Bytes = NDArray[np.uint8]
SAME_COLOR = (70, 110, 160)  # in the difference: another ray that happens to have the same colour
SAME = "the same colours"  # though rays are wrong
IMAGES = ("render", "to-gray", "to-bitmap")  # kinds of functions whose answers are images
LARGEST_SIDE = 512  # of an image that a function made


@dataclass(frozen=True, eq=False)
class CodePictures:
    """Pictures of an answer."""

    given: Bytes
    right: Bytes
    difference: Bytes
    told: str  # the size of the difference, in words

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
    """Return the pictures of two images.

    came: the pixels that have an answer, bool (H, W).
    wrong: the wrong ones, whatever their colour.
    """
    shown = to_srgb8(np.where(came[..., None], given, 0), exposure_ev)
    wanted = to_srgb8(right, exposure_ev)
    changed = changed_pixels(wanted, shown) & came
    difference = difference_picture(wanted, changed)
    difference[wrong & came & ~changed] = SAME_COLOR
    told = told_difference(changed) if changed.any() else "none" if not wrong.any() else SAME
    if not came.all():
        told = f"{np.count_nonzero(~came)} of {came.size} missing"
    return CodePictures(shown, wanted, difference, told)


def image_pair(right: object, given: object) -> CodePictures | None:
    """Return both images if the answer is an image, in linear light or gray from 0 to 1; None
    otherwise.
    """
    pair = [np.asarray(one) for one in (right, given)]
    if any(one.dtype.kind not in "fiub" or one.ndim not in (2, 3) for one in pair):
        return None
    if pair[0].shape != pair[1].shape or not min(pair[0].shape[:2]) >= 1:
        return None
    if max(pair[0].shape[:2]) > LARGEST_SIDE or (pair[0].ndim == 3 and pair[0].shape[2] != 3):
        return None
    first, second = (
        (one if one.ndim == 3 else np.repeat(one[..., None], 3, axis=2)).astype(np.float32)
        for one in pair
    )
    came = np.logical_and.reduce(np.isfinite(second), axis=2)
    return compared(second, first, came, np.zeros(came.shape, bool))
