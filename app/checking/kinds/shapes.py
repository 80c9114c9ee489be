"""Intersections of rays with spheres and triangles: the correct answers and their margins.

An answer's margin is the distance of the ray from one with another answer, as a fraction of the
object's size. If the margin is small, rounding decides; tasks never use such rays.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Shape = Mapping[str, Any]  # type, then center and radius, or a, b and c


def hits(origin: ArrayLike, direction: ArrayLike, shape: Shape) -> tuple[Floats, Floats]:
    """Return the smallest t > 0 at which each ray hits the object, inf for a miss, and the margins.

    origin, direction: (..., 3). Both results have the rays' shape.
    """
    found, margin = crossings(origin, direction, shape)
    return np.minimum.reduce([np.where(t > 0, t, np.inf) for t in found]), margin


def crossings(origin: ArrayLike, direction: ArrayLike, shape: Shape) -> tuple[list[Floats], Floats]:
    """Return every t, of any sign, at which each ray's line crosses the object, and the margins.

    A line that misses the object has NaN.
    """
    o, d = np.asarray(origin, float), np.asarray(direction, float)
    with np.errstate(all="ignore"):
        if shape["type"] == "sphere":
            return _sphere_crossings(o, d, np.asarray(shape["center"], float), shape["radius"])
        return _triangle_crossings(o, d, *(np.asarray(shape[name], float) for name in "abc"))


def _sphere_crossings(
    o: Floats, d: Floats, center: Floats, radius: float
) -> tuple[list[Floats], Floats]:
    """Solve |o + t d - c| = r. The margins are distances from the outline, and from the origin to
    the surface, in radii.
    """
    from_center = o - center
    squared = np.vecdot(d, d)
    middle = -np.vecdot(from_center, d) / squared  # t of the point closest to the centre
    nearest = from_center + middle[..., None] * d
    inside = radius**2 - np.vecdot(nearest, nearest)
    half = np.sqrt(inside / squared)  # NaN outside of the outline
    at_surface = np.abs(np.linalg.norm(from_center, axis=-1) / radius - 1)
    margin = np.minimum(np.abs(inside) / radius**2, at_surface)
    return [middle - half, middle + half], margin


def _triangle_crossings(
    o: Floats, d: Floats, a: Floats, b: Floats, c: Floats
) -> tuple[list[Floats], Floats]:
    """Solve o + t d = a + beta (b - a) + gamma (c - a) by Cramer's rule; both sides count. The
    margins are distances from the edges, as barycentric coordinates, and from the origin to the
    plane, in lengths of d.

    Source: Marschner and Shirley, Fundamentals of Computer Graphics, "Ray-Triangle Intersection".
    """
    first, second = b - a, c - a
    across = np.cross(first, second)
    along = np.vecdot(d, across)
    away = a - o
    t = np.vecdot(away, across) / along
    turned = np.cross(d, away)
    beta, gamma = -np.vecdot(turned, second) / along, np.vecdot(turned, first) / along
    least = np.minimum(np.minimum(1 - beta - gamma, beta), gamma)
    flat = np.abs(along) <= 1e-12 * np.linalg.norm(across) * np.linalg.norm(d, axis=-1)
    margin = np.where(flat, 1.0, np.minimum(np.abs(least), np.abs(t)))
    return [np.where(~flat & (least > 0), t, np.nan)], margin


def tolerance(
    origin: ArrayLike, direction: ArrayLike, shape: Shape, t: float, rounding: float
) -> float:
    """Return the largest difference from t due to rounding alone; see kinds/hits.py.

    rounding: relative error of each number. The result is 0 for a miss, which has no t.
    """
    if not np.isfinite(t):
        return 0.0
    o, d = np.asarray(origin, float), np.asarray(direction, float)
    length = float(np.linalg.norm(d))
    if shape["type"] == "sphere":
        center, radius = np.asarray(shape["center"], float), float(shape["radius"])
        largest = float(np.linalg.norm(o) + np.linalg.norm(center)) + radius
        from_center = o - center
        nearest = from_center - (from_center @ d) / (d @ d) * d
        half = float(np.sqrt(radius**2 - nearest @ nearest))
        return rounding * (largest + largest**2 / (2 * half)) / length
    a, b, c = (np.asarray(shape[name], float) for name in "abc")
    edges = max(float(np.linalg.norm(edge)) for edge in (b - a, c - a, c - b))
    largest = float(np.linalg.norm(o) + max(np.linalg.norm(corner) for corner in (a, b, c)))
    facing = abs(float(np.cross(b - a, c - a) @ d))
    return rounding * edges**2 * (largest + t * length) / facing
