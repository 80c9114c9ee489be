"""The intersections of a ray with a triangle, a sphere and a box. traverse.py has the BVH.

Rays, shapes and arithmetic are float64; boxes are stored in float32, and slightly too large.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lucida.renderer.trace.compile.compiled import inlined

from .vectors import dot, minus, plus, row, times

HUGE = 1e290  # replaces 1 / 0; finite, because 0 * inf would be NaN
ROUNDING = 1e-15  # relative to coordinates; more than a few float64 roundings
BOX_ROUNDING = 1.2e-7  # relative to boxes' coordinates; more than their rounding to float32


class BoxRay(NamedTuple):
    """A ray prepared for boxes. Columns of bounds: low x, y, z, high x, y, z."""

    inverse: tuple[float, float, float]  # 1 / direction
    enter: tuple[int, int, int]  # for each axis, the column of the plane that the ray hits first
    enter_from: tuple[float, float, float]  # the origin, moved to make boxes a little larger
    leave_from: tuple[float, float, float]


class ShearedRay(NamedTuple):
    """A ray prepared for triangles; axis z is that of the direction's largest component."""

    axes: tuple[int, int, int]  # the coordinates that become x, y and z
    origin: tuple[float, float, float]
    shear: tuple[float, float, float]  # maps the direction to (0, 0, 1)


@inlined
def _inverse(x):
    if abs(x) > 1.0 / HUGE:
        return 1.0 / x
    return math.copysign(HUGE, x)


@inlined
def box_ray(origin, direction, extent):
    """Prepare a ray for boxes.

    extent: the largest |coordinate| of the boxes, which scales the slack together with the
    origin's.

    The slack covers the rounding of boxes, of this test and of the triangle's, so that no box is
    missed whose triangle would be hit, even by a ray that runs in one of the box's faces.
    Source: after Ize, "Robust BVH Ray Traversal", 2013.
    """
    ox, oy, oz = origin
    slack = ROUNDING * max(abs(ox), abs(oy), abs(oz)) + BOX_ROUNDING * extent
    ix, iy, iz = _inverse(direction[0]), _inverse(direction[1]), _inverse(direction[2])
    sx, sy, sz = math.copysign(slack, ix), math.copysign(slack, iy), math.copysign(slack, iz)
    enter = (0 if ix >= 0.0 else 3, 1 if iy >= 0.0 else 4, 2 if iz >= 0.0 else 5)
    return BoxRay((ix, iy, iz), enter, (ox + sx, oy + sy, oz + sz), (ox - sx, oy - sy, oz - sz))


@inlined
def enter_box(bounds, node, ray, t_min, t_max):
    """Return the parameter at which the ray enters box `node`, or inf if not within [t_min, t_max].

    Source: slabs, Kay and Kajiya 1986; signs, Williams et al. 2005.
    """
    x, y, z = ray.enter
    near_x = (bounds[node, x] - ray.enter_from[0]) * ray.inverse[0]
    near_y = (bounds[node, y] - ray.enter_from[1]) * ray.inverse[1]
    near_z = (bounds[node, z] - ray.enter_from[2]) * ray.inverse[2]
    far_x = (bounds[node, 3 - x] - ray.leave_from[0]) * ray.inverse[0]
    far_y = (bounds[node, 5 - y] - ray.leave_from[1]) * ray.inverse[1]
    far_z = (bounds[node, 7 - z] - ray.leave_from[2]) * ray.inverse[2]
    near = max(max(near_x, near_y), max(near_z, t_min))
    far = min(min(far_x, far_y), min(far_z, t_max))
    return near if near <= far else np.inf


@inlined
def sheared_ray(origin, direction):
    """Choose the axes, and the shear that turns the direction into (0, 0, 1)."""
    ax, ay, az = abs(direction[0]), abs(direction[1]), abs(direction[2])
    z = 0 if ax >= ay and ax >= az else (1 if ay >= az else 2)
    x = z + 1 if z < 2 else 0
    y = x + 1 if x < 2 else 0
    dx, dy, dz = direction[x], direction[y], direction[z]
    return ShearedRay((x, y, z), (origin[x], origin[y], origin[z]), (dx / dz, dy / dz, 1.0 / dz))


@inlined
def hit_triangle(shapes, i, ray):
    """Return (t, b1, b2) of the ray's line in triangle i; t is NaN if it misses.

    shapes: float64 (n, 9), corners a, b, c, or NaN for a triangle that is never hit. b1, b2:
    barycentrics of b and c.

    In sheared coordinates, the ray is the z axis, and the test is whether a triangle of the plane
    contains the origin. Two triangles compute exactly opposite numbers for a common edge (products
    commute, rounding is symmetric). A rounded edge function never has the wrong sign; it may only
    become 0, which counts as inside. No ray therefore passes between the triangles.
    Source: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013.
    """
    x, y, z = ray.axes
    ox, oy, oz = ray.origin
    sx, sy, sz = ray.shear

    # Shear the corners relative to the origin.
    az, bz, cz = shapes[i, z] - oz, shapes[i, 3 + z] - oz, shapes[i, 6 + z] - oz
    ax, ay = (shapes[i, x] - ox) - sx * az, (shapes[i, y] - oy) - sy * az
    bx, by = (shapes[i, 3 + x] - ox) - sx * bz, (shapes[i, 3 + y] - oy) - sy * bz
    cx, cy = (shapes[i, 6 + x] - ox) - sx * cz, (shapes[i, 6 + y] - oy) - sy * cz

    # The three edge functions have the same sign inside, for either winding.
    e0 = cx * by - cy * bx
    e1 = ax * cy - ay * cx
    e2 = bx * ay - by * ax
    if (e0 < 0.0 or e1 < 0.0 or e2 < 0.0) and (e0 > 0.0 or e1 > 0.0 or e2 > 0.0):
        return np.nan, 0.0, 0.0
    area = e0 + e1 + e2
    if area == 0.0:  # seen edge-on
        return np.nan, 0.0, 0.0

    # t is a mean of the corners' t weighted by the edge functions, and never outside their range.
    t = (e0 * az + e1 * bz + e2 * cz) * sz / area
    return t, e1 / area, e2 / area


@inlined
def hit_sphere(shapes, i, origin, direction, t_min, t_max):
    """Return the least t within (t_min, t_max) of the ray's hits on sphere i; NaN if there is none.

    shapes: float64 (n, 9), of which centre and radius are used. A tangent ray counts as a hit.
    Source: Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere
    Intersection", Ray Tracing Gems 2019, ch. 7.
    """
    radius = np.float64(shapes[i, 3])
    f = minus(origin, row(shapes, i))
    a = dot(direction, direction)
    b = -dot(f, direction)
    # The ray passes through the sphere if its point nearest to the centre is inside.
    nearest = plus(f, times(b / a, direction))
    left_over = radius * radius - dot(nearest, nearest)
    if left_over < 0.0:
        return np.nan
    # Compute the root of larger magnitude first; the other follows without cancellation.
    q = b + math.copysign(math.sqrt(a * left_over), b)
    if q == 0.0:
        return np.nan
    first, second = (dot(f, f) - radius * radius) / q, q / a
    if first > second:
        first, second = second, first
    if t_min < first < t_max:
        return first
    if t_min < second < t_max:
        return second
    return np.nan
