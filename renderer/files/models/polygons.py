"""Cut the polygons of model files into triangles."""

from __future__ import annotations

import mapbox_earcut
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.errors import LucidaError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TURNED = 1e-9  # smaller parts of a polygon's area do not count as inverted


def check_corners(corners: Ints, count: int) -> None:
    """Raise LucidaError if a face uses one of `count` vertices that does not exist."""
    if len(corners) and (corners.min() < 0 or corners.max() >= count):
        wrong = corners.min() if corners.min() < 0 else corners.max()
        raise LucidaError("faces", f"use vertex {wrong} of {count}", "export the model again")


def triangulated(points: Floats, corners: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """Return (places, owner): triangles as places in `corners`, (t, 3), and their polygons, (t,).

    points: (n, 3). corners: the points of all polygons, one polygon after another. counts: the
    number of corners of each. A polygon becomes a fan around its first corner if no triangle of the
    fan is inverted; otherwise, ears are clipped in the polygon's plane, which also handles concave
    polygons, and holes joined to the border by an edge.
    """
    starts = np.cumsum(counts) - counts
    places, owners = [np.zeros((0, 3), np.int64)], [np.zeros(0, np.int64)]
    for count in np.unique(counts[counts > 2]).tolist():
        polygons = np.flatnonzero(counts == count)
        spans = starts[polygons, None] + np.arange(count)
        first = np.broadcast_to(spans[:, :1], (len(spans), count - 2))
        fans = np.stack([first, spans[:, 1:-1], spans[:, 2:]], axis=2)
        if count > 3:
            turned, normals = _turned(points[corners[fans]])
            for polygon, normal in zip(np.flatnonzero(turned), normals[turned], strict=True):
                ears = spans[polygon][_ears(points[corners[spans[polygon]]], normal)]
                places.append(ears)
                owners.append(np.full(len(ears), polygons[polygon]))
            fans, polygons = fans[~turned], polygons[~turned]
        places.append(fans.reshape(-1, 3))
        owners.append(np.repeat(polygons, count - 2))
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(places)[order], owner[order]


def _turned(triangles: Floats) -> tuple[NDArray[np.bool_], Floats]:
    """Return a mask of polygons with an inverted triangle in their fan, and normals twice as long
    as the polygons' areas. triangles: of each polygon's fan, (polygons, triangles, corners, 3).
    """
    with np.errstate(all="ignore"):
        a, b, c = np.moveaxis(triangles, 2, 0)
        crosses = np.cross(b - a, c - a)
        normals = crosses.sum(axis=1)
        along = np.einsum("ijk,ik->ij", crosses, normals).min(axis=1)
        turned = along < -TURNED * np.einsum("ik,ik->i", normals, normals)
    return turned & np.isfinite(normals).all(axis=1), normals


def _ears(points: Floats, normal: Floats) -> Ints:
    """Return the triangles (t, 3) of one polygon's corners, wound about its normal."""
    flat = np.delete(points, np.abs(normal).argmax(), axis=1)
    ends = np.array([len(flat)], np.uint32)
    ears = mapbox_earcut.triangulate_float64(flat, ends).reshape(-1, 3).astype(np.int64)
    a, b, c = points[ears.T]
    is_back = np.cross(b - a, c - a) @ normal < 0
    return np.where(is_back[:, None], ears[:, ::-1], ears)
