"""What float32 does not know of the edges of triangles that are seen as slivers.

Owns these bounds, for renderer/edges.py. Knows nothing of scenes.

An edge is where (p + q) x (q - p) . (x, y, 1) is 0, of its ends' places in the image
(packets/triangle.py, edge_function). Where both are seen nearly in one direction, or in opposite
ones, from the eye, that is a small difference of large products, and turns about them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Floats

Numbers = NDArray[np.integer] | NDArray[np.floating]

_ROUNDINGS = 2.0**-21  # eight: of corners, their differences, products, and sums


def unknown_edge_px(
    size: tuple[int, int], p: Floats, q: Floats, is_parallel: bool, i: Numbers, j: Numbers
) -> Floats:
    """How far from where it is, in pixels, an edge p to q may be in float32, at pixels (i, j).

    p, q (n, 3): its ends, of seen_corners().
    """
    if is_parallel:
        p, q = (np.column_stack([end[:, :2], np.ones(len(end))]) for end in (p, q))
    (x1, y1, h1), (x2, y2, h2) = (p + q).T, (q - p).T
    pixel = np.stack([j - (size[0] - 1) / 2, i - (size[1] - 1) / 2], axis=1)
    x, y = np.abs(pixel).T
    wrong = (np.abs(y1 * h2) + np.abs(h1 * y2)) * x + (np.abs(h1 * x2) + np.abs(x1 * h2)) * y
    wrong += np.abs(x1 * y2) + np.abs(y1 * x2)
    with np.errstate(divide="ignore", invalid="ignore"):
        wrong /= np.hypot(y1 * h2 - h1 * y2, h1 * x2 - x1 * h2)
        # The ends themselves are rounded. Only an edge that passes the eye is seen beyond them,
        # where that turns it.
        first, second = p[:, :2] / p[:, 2:], q[:, :2] / q[:, 2:]
        beyond = np.linalg.norm(pixel - first, axis=1) + np.linalg.norm(pixel - second, axis=1)
        beyond /= np.linalg.norm(second - first, axis=1)
        beyond = np.where((p[:, 2] > 0) & (q[:, 2] > 0), 1.0, beyond)
        ends = np.linalg.norm(first, axis=1) + np.linalg.norm(second, axis=1)
        unknown: Floats = _ROUNDINGS * (wrong + ends * beyond)
    return np.where(np.isfinite(unknown), unknown, 0.0)


def seen_corners(camera: Camera, size: tuple[int, int], corners: Floats) -> Floats:
    """Points of the world in the image (n, 3, 3): pixels from its middle, right and down, in
    perspective multiplied by t; and t. Points behind the eye have their place, too."""
    left, right, bottom, top = camera.viewport
    matrix = camera.camera_from_world
    x, y, z = np.moveaxis(corners @ matrix[:3, :3].T + matrix[:3, 3], 2, 0)
    t = -z if camera.is_parallel else -z / camera.distance
    weight = 1.0 if camera.is_parallel else t
    column = (x - (left + right) / 2 * weight) * (size[0] / (right - left))
    row = ((top + bottom) / 2 * weight - y) * (size[1] / (top - bottom))
    seen: Floats = np.stack([column, row, t], axis=2)
    return seen
