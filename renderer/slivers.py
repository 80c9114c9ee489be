"""Bounds on float32's error in the edges of triangles that are seen as slivers, for
renderer/edges.py.

An edge is where (p + q) x (q - p) . (x, y, 1) is 0, for its ends' positions p and q in the image
(packets/triangle.py, edge_function). If both are seen from the eye in nearly the same direction, or
in opposite ones, that is a small difference of large products, and the edge's direction is wrong.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Floats

Numbers = NDArray[np.integer] | NDArray[np.floating]

_ROUNDINGS = 2.0**-21  # eight roundings: corners, their differences, products, and sums


def unknown_edge_px(
    size: tuple[int, int], p: Floats, q: Floats, is_parallel: bool, i: Numbers, j: Numbers
) -> Floats:
    """Return the largest error, in pixels, of the position of an edge p to q in float32, at pixels
    (i, j).

    p, q (n, 3): its ends, from seen_corners().
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
        # The ends are rounded, too. Beyond its ends, only an edge that passes the eye is visible;
        # there the rounding rotates it.
        first, second = p[:, :2] / p[:, 2:], q[:, :2] / q[:, 2:]
        beyond = np.linalg.norm(pixel - first, axis=1) + np.linalg.norm(pixel - second, axis=1)
        beyond /= np.linalg.norm(second - first, axis=1)
        beyond = np.where((p[:, 2] > 0) & (q[:, 2] > 0), 1.0, beyond)
        ends = np.linalg.norm(first, axis=1) + np.linalg.norm(second, axis=1)
        unknown: Floats = _ROUNDINGS * (wrong + ends * beyond)
    return np.where(np.isfinite(unknown), unknown, 0.0)


def seen_corners(camera: Camera, size: tuple[int, int], corners: Floats) -> Floats:
    """Return world points in the image (n, 3, 3): pixels from its centre, right and down,
    multiplied by t in perspective; and t. Points behind the eye also have a position.
    """
    left, right, bottom, top = camera.viewport
    matrix = camera.camera_from_world
    x, y, z = np.moveaxis(corners @ matrix[:3, :3].T + matrix[:3, 3], 2, 0)
    t = -z if camera.is_parallel else -z / camera.distance
    weight = 1.0 if camera.is_parallel else t
    column = (x - (left + right) / 2 * weight) * (size[0] / (right - left))
    row = ((top + bottom) / 2 * weight - y) * (size[1] / (top - bottom))
    seen: Floats = np.stack([column, row, t], axis=2)
    return seen
