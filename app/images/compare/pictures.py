"""The marks on the pixels that differ, as a picture. Pure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.compare.raster_and_ray import AGREE, LABEL_COLORS, SHADING

Bytes = NDArray[np.uint8]
RIM = 250  # a label: the dark border of a mark
MOST_ENLARGED = 0.002  # part of all pixels; a cause with more is not enlarged
LARGER_EVERY = 400  # pixels of the shorter side per pixel of a mark's enlargement


def marked_picture(labels: Bytes, is_large: bool) -> Bytes:
    """Return the differing pixels in the colours of their causes, uint8 (H, W, 4), others
    transparent.

    labels: see renderer/compare/raster_and_ray.py. is_large: the pixels are large enough to see;
    otherwise the marks are enlarged.
    """
    if not is_large:
        labels = enlarged(labels)
    picture = np.empty((*labels.shape, 4), np.uint8)
    picture[..., :3], picture[..., 3] = LABEL_COLORS[labels], 255 * (labels != AGREE)
    return picture


def enlarged(labels: Bytes) -> Bytes:
    """Return the labels with each differing pixel enlarged to 3 x 3, or more in a large image, in a
    border of RIM, so that it is visible from a distance. A cause with very many pixels is not
    enlarged.

    Unexplained pixels are never covered by explained ones.
    """
    i, j = np.nonzero(labels)
    found = labels[i, j]
    few = np.bincount(found, minlength=256)[found] <= MOST_ENLARGED * labels.size
    i, j, found = i[few], j[few], found[few]
    near = 1 + min(labels.shape) // LARGER_EVERY  # reach of the colour; the border's is one more
    edge, bad = near + 1, found >= SHADING
    grown = np.pad(labels, edge)  # so that nothing wraps around
    for chosen, inset in ((slice(None), 0), (~bad, 1), (bad, 1)):
        for di in range(inset, 2 * edge + 1 - inset):
            for dj in range(inset, 2 * edge + 1 - inset):
                grown[i[chosen] + di, j[chosen] + dj] = found[chosen] if inset else RIM
    grown = grown[edge:-edge, edge:-edge]
    grown[i, j] = found  # enlarged neighbours do not hide a pixel's own label
    return grown
