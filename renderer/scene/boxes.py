"""Axis-aligned boxes of points, and around transformed boxes, as lowest and highest corners."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

F64 = NDArray[np.float64]


def extent(vertices: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the lowest and the highest corner (3,) of points (n, 3), n > 0, in C order."""
    # Use long rows, because NumPy takes ten times as long along rows of three.
    whole = len(vertices) // 64 * 64
    parts = [vertices[whole:]]
    if whole:
        rows = vertices[:whole].reshape(-1, 64 * 3)
        parts += [rows.min(0).reshape(64, 3), rows.max(0).reshape(64, 3)]
    corners = np.concatenate(parts)
    return corners.min(0), corners.max(0)


_CORNERS = np.array(list(np.ndindex(2, 2, 2)))


def corners_of(bounds: NDArray[Any]) -> F64:
    """Return the corners (..., 8, 3) of boxes (..., 2, 3), in world space or any other."""
    corners: F64 = np.asarray(bounds, np.float64)[..., _CORNERS, np.arange(3)]
    return corners


def world_boxes(world_from_object: F64, bounds: F64) -> tuple[F64, F64]:
    """Return boxes around transformed boxes: lowest and highest corners, (n, 3) each.

    bounds: (n, 2, 3). Source: Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems 1990.
    """
    linear, position = world_from_object[:, :3, :3], world_from_object[:, :3, 3]
    first, second = linear * bounds[:, None, 0], linear * bounds[:, None, 1]
    return (
        np.minimum(first, second).sum(2) + position,
        np.maximum(first, second).sum(2) + position,
    )
