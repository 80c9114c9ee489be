"""Intersections of rays with spheres and triangles: the correct answers, and how clear each one is.

An answer's margin is the distance of the ray from where the answer would change, as a fraction of
the object's size. If the margin is small, rounding decides; such rays are never asked for.
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
    with np.errstate(all="ignore"):
        if shape["type"] == "sphere":
            return sphere_hits(origin, direction, shape["center"], shape["radius"])
        return triangle_hits(origin, direction, shape["a"], shape["b"], shape["c"])


def sphere_hits(
    origin: ArrayLike, direction: ArrayLike, center: ArrayLike, radius: float
) -> tuple[Floats, Floats]:
    """Solve |o + t d - c| = r. Margins: from the outline, and from the origin to the surface, in
    radii.
    """
    o, d = np.asarray(origin, float), np.asarray(direction, float)
    from_center = o - np.asarray(center, float)
    squared = np.sum(d * d, axis=-1)
    middle = -np.sum(from_center * d, axis=-1) / squared  # t of the point closest to the centre
    nearest = from_center + middle[..., None] * d
    inside = radius**2 - np.sum(nearest * nearest, axis=-1)
    half = np.sqrt(np.maximum(inside, 0.0) / squared)
    near, far = middle - half, middle + half
    t = np.where(near > 0, near, far)
    t = np.where((inside > 0) & (t > 0), t, np.inf)
    at_surface = np.abs(np.linalg.norm(from_center, axis=-1) / radius - 1)
    return t, np.minimum(np.abs(inside) / radius**2, at_surface)


def triangle_hits(
    origin: ArrayLike, direction: ArrayLike, a: ArrayLike, b: ArrayLike, c: ArrayLike
) -> tuple[Floats, Floats]:
    """Solve o + t d = a + beta (b - a) + gamma (c - a) by Cramer's rule; both sides count. Margins:
    from the edges, as barycentric coordinates, and from the origin to the plane, in lengths of d.

    Source: Marschner and Shirley, Fundamentals of Computer Graphics, "Ray-Triangle Intersection".
    """
    o, d = np.asarray(origin, float), np.asarray(direction, float)
    corner = np.asarray(a, float)
    first, second = np.asarray(b, float) - corner, np.asarray(c, float) - corner
    across = np.cross(first, second)
    along = np.sum(d * across, axis=-1)
    away = corner - o
    t = np.sum(away * across, axis=-1) / along
    beta = np.sum(np.cross(d, away) * -second, axis=-1) / along
    gamma = np.sum(np.cross(d, away) * first, axis=-1) / along
    alpha = 1 - beta - gamma
    least = np.minimum(np.minimum(alpha, beta), gamma)
    flat = np.abs(along) <= 1e-12 * np.linalg.norm(across) * np.linalg.norm(d, axis=-1)
    hit = ~flat & (least > 0) & (t > 0)
    margin = np.where(flat, 1.0, np.minimum(np.abs(least), np.abs(t)))
    return np.where(hit, t, np.inf), margin


def tolerance(
    origin: ArrayLike, direction: ArrayLike, shape: Shape, t: float, rounding: float
) -> float:
    """Return the largest difference from t due to rounding alone; see kinds/hits.py.

    rounding: relative error of each number. 0 for a miss, which has no t.
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
