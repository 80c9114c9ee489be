"""A reconstruction's points as one of its cameras sees them, over its photograph. If they line up
with the photograph, the pose is correct. Pure.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .model import PoseSet

Bytes = NDArray[np.uint8]
MANY = (4, 20)  # pixels per point, above which points are larger
DARKER = 0.45  # the factor for a photograph's light under points


def with_points(poses: PoseSet, number: int, pixels: Bytes) -> Bytes:
    """Return the picture, uint8 (height, width, 3), darkened, with the points on it, the nearest on
    top.

    This takes a fraction of a second for millions of points: call it on a thread.
    """
    height, width = pixels.shape[:2]
    out = (DARKER * pixels).astype(np.uint8)
    camera = poses.cameras[number].camera
    places = poses.points.astype(float) + poses.origin
    row, column, t = camera.project(places, (width, height))
    with np.errstate(invalid="ignore"):
        seen = (t > 0) & (np.abs(row - height / 2) < height) & (np.abs(column - width / 2) < width)
    rows, columns = np.round(row[seen]).astype(int), np.round(column[seen]).astype(int)
    order = np.argsort(-t[seen], kind="stable")  # the farthest first
    side = 1 + sum(len(order) < width * height / many for many in MANY)  # a point's side in pixels
    for down in range(side):
        for right in range(side):
            i, j = rows[order] + down, columns[order] + right
            inside = (i >= 0) & (i < height) & (j >= 0) & (j < width)
            out[i[inside], j[inside]] = poses.colors[seen][order][inside]
    return out
