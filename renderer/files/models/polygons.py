"""Cut the polygons of model files into triangles."""

from __future__ import annotations

import math

import mapbox_earcut
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.system.errors import LucidaError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TURNED = 1e-9  # part of a polygon's area below which a triangle of its fan is not turned over


def check_corners(corners: Ints, count: int) -> None:
    """Raise LucidaError if a face uses one of `count` vertices that does not exist."""
    if len(corners) and (corners.min() < 0 or corners.max() >= count):
        wrong = corners.min() if corners.min() < 0 else corners.max()
        raise LucidaError("faces", f"use vertex {wrong} of {count}", "export the model again")


def triangulated(
    points: Floats, corners: Ints, counts: Ints, images: ModelImages | None = None
) -> tuple[Ints, Ints]:
    """Return (places, owner): triangles as places in `corners`, (t, 3), and their polygons, (t,).

    points: (n, 3). corners: the points of all polygons, one polygon after another. counts: the
    number of corners of each. A polygon becomes a fan around its first corner if none of the fan's
    triangles is turned over; otherwise ears are clipped in the polygon's plane, so that concave
    ones and holes that are joined to the border by an edge are right.

    images: notes polygons that have no area or cross themselves.
    """
    if (counts == 3).all():
        return np.arange(3 * len(counts)).reshape(-1, 3), np.arange(len(counts))
    starts = np.cumsum(counts) - counts
    polygons = np.flatnonzero(counts > 2)
    fan = counts[polygons] - 2
    first = np.cumsum(fan) - fan
    owner = np.repeat(polygons, fan)
    second = np.repeat(starts[polygons] + 1 - first, fan) + np.arange(len(owner))
    places = np.stack([starts[owner], second, second + 1], axis=1)
    if not len(owner):
        return places, owner
    x, y, z = points[corners[places]].transpose(2, 1, 0)
    with np.errstate(all="ignore"):
        (ax, bx), (ay, by), (az, bz) = (axis[1:] - axis[0] for axis in (x, y, z))
        cross = np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
        area = np.add.reduceat(cross, first, axis=1)  # twice the polygon's
        along = (cross * np.repeat(area, fan, axis=1)).sum(axis=0)
        squared = (area * area).sum(axis=0)
        turned = np.minimum.reduceat(along, first) < -TURNED * squared
        triangles = np.add.reduceat((cross * cross).sum(axis=0), first)
        is_odd = (fan > 1) & (squared <= TURNED**2 * triangles)
    odd = [*np.flatnonzero(counts < 3).tolist(), *polygons[is_odd].tolist()]
    found, owners = [], []
    for polygon, normal in zip(polygons[turned].tolist(), area.T[turned], strict=True):
        span = np.arange(starts[polygon], starts[polygon] + counts[polygon])
        ears, is_whole = _ears(points[corners[span]], normal)
        if not is_whole:
            odd.append(polygon)
        if len(ears):
            found.append(span[ears])
            owners.append(np.full(len(ears), polygon))
    if odd and images is not None:
        crossing = f"{len(odd)} polygons have no area or cross themselves"
        images.note(f"{crossing}, the first is number {min(odd) + 1}", "shapes")
    if not found:
        return places, owner
    kept = ~np.isin(owner, np.concatenate(owners))
    places = np.concatenate([places[kept], *found])
    owner = np.concatenate([owner[kept], *owners])
    order = np.argsort(owner, kind="stable")
    return places[order], owner[order]


def _ears(points: Floats, normal: Floats) -> tuple[Ints, bool]:
    """Return the triangles (t, 3) of one polygon's corners, in its turn, and True if they have its
    area: it does not cross itself.

    normal: twice the polygon's area long.
    """
    axis = int(np.abs(normal).argmax())
    flat = np.delete(points - points[0], axis, axis=1)
    if not np.isfinite(flat).all():
        return np.zeros((0, 3), np.int64), False
    ends = np.array([len(flat)], np.uint32)
    ears = mapbox_earcut.triangulate_float64(flat, ends).reshape(-1, 3).astype(np.int64)
    a, b, c = points[ears.T]
    areas = np.cross(b - a, c - a)
    is_back = areas @ normal < 0
    is_whole = math.isclose(np.abs(areas[:, axis]).sum(), abs(normal[axis]), rel_tol=1e-6)
    return np.where(is_back[:, None], ears[:, ::-1], ears), is_whole
