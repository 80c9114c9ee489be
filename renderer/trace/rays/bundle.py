"""Bundles of 16 rays in lanes with similar directions: their common bounds, and their tests.

A bundle has up to 16 rays whose directions have the same signs and the same largest component, for
a mesh that is double-sided and has no holes. Each test is, for a lane, exactly that of traverse.py
for its ray: hits, and t, do not depend on the other rays.

A bundle's spread bounds its rays together: the intervals of their origins and of 1 / direction. One
vector then holds what is tested against it: 16 boxes of a node, or of a leaf's triangles.

Sources: Wald, Slusallek, Benthin and Wagner, "Interactive Rendering with Coherent Ray Tracing",
2001; Boulos, Wald and Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets",
2006.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.trace.bvh.bvh16 import BOX, CORNERS, WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.rays.traverse import ROUNDING, STEEP, SpaceRay, intersect_sheared
from renderer.trace.simd.lanes import (
    LANES,
    bits,
    bits_of_f32,
    f32_of_bits,
    fma,
    select,
    smallest,
    splat,
    vabs,
    vmax,
    vmin,
)
from renderer.trace.simd.memory import load, store

COLUMNS = 18  # vectors in a stored bundle, for ray_of_lane()
_WIDER = np.float32(1e-6)  # relative: more than the rounding errors of a test against a spread
_FAR = np.float32(3e38)
_COHERENT = np.float32(0.3)  # range of a bundle's slopes, relative to their largest component


class Spread(NamedTuple):
    """The intervals of a bundle: origins, and 1 / direction (x, y, z each)."""

    origin_low: tuple[np.float32, np.float32, np.float32]
    origin_high: tuple[np.float32, np.float32, np.float32]
    least: tuple[np.float32, np.float32, np.float32]
    most: tuple[np.float32, np.float32, np.float32]


@inlined
def rays_in_lanes(origin, direction, turns):
    """Return (enter, leave, enter_add, leave_add, origin, shear) of 16 SpaceRays, three F32 each.

    origin, direction: three F32 each. turns: of each ray.
    """
    ox, oy, oz = origin
    dx, dy, dz = direction
    ax, ay, az = vabs(dx), vabs(dy), vabs(dz)
    least = vmax(vmax(ax, ay), az) * STEEP
    one = np.float32(1)
    ix, iy, iz = (
        one / _steep(dx, ax, least),
        one / _steep(dy, ay, least),
        one / _steep(dz, az, least),
    )
    smaller, larger = one - ROUNDING, one + ROUNDING
    enter = (ix * smaller, iy * smaller, iz * smaller)
    leave = (ix * larger, iy * larger, iz * larger)
    sx, sy, sz = vabs(ox * ix) * ROUNDING, vabs(oy * iy) * ROUNDING, vabs(oz * iz) * ROUNDING
    is_x, is_y = turns < np.int32(8), turns < np.int32(16)
    x, y, _ = _turned(is_x, is_y, dx, dy, dz)
    inverse = select(is_x, ix, select(is_y, iy, iz))
    return (
        enter,
        leave,
        (-ox * enter[0] - sx, -oy * enter[1] - sy, -oz * enter[2] - sz),
        (-ox * leave[0] + sx, -oy * leave[1] + sy, -oz * leave[2] + sz),
        _turned(is_x, is_y, ox, oy, oz),
        (x * inverse, y * inverse, inverse),
    )


@inlined
def _turned(is_x, is_y, x, y, z):
    """Return (x, y, z) permuted cyclically, with x last if is_x, else y if is_y, else z."""
    return (
        select(is_x, y, select(is_y, z, x)),
        select(is_x, z, select(is_y, x, y)),
        select(is_x, x, select(is_y, y, z)),
    )


@inlined
def space_ray_of(turn, parts):
    """Return the SpaceRay of a turn, from the parts that rays_in_lanes() returns."""
    enter, leave, enter_add, leave_add, origin, shear = parts
    near = (
        WIDTH * (3 * (turn & 1)),
        WIDTH * (1 + 3 * ((turn >> 1) & 1)),
        WIDTH * (2 + 3 * ((turn >> 2) & 1)),
    )
    z = turn >> 3
    x = np.int64(0) if z == 2 else z + 1
    return SpaceRay(
        near,
        (3 * WIDTH - near[0], 5 * WIDTH - near[1], 7 * WIDTH - near[2]),
        enter,
        leave,
        enter_add,
        leave_add,
        (x * WIDTH, (3 - x - z) * WIDTH, z * WIDTH),
        origin,
        shear,
        np.float32(0),
        np.int64(-1),
    )


@inlined
def _steep(x, size, least):
    sign = bits_of_f32(x) & np.int32(-0x80000000)
    return select(size > least, x, f32_of_bits(bits_of_f32(least) | sign))


@inlined
def turns_of(direction):
    """Return each ray's octant and largest axis, which must be equal in a bundle: I32, 0 to 23.

    Bits 0 to 2: x, y, z are negative (including -0). Above them: the number of the largest
    component.
    """
    dx, dy, dz = direction
    ax, ay, az = vabs(dx), vabs(dy), vabs(dz)
    z = select(ay >= az, splat(np.int32(8)), np.int32(16))
    z = select((ax >= ay) & (ax >= az), np.int32(0), z)
    x, y = bits_of_f32(dx) >> np.int32(31), bits_of_f32(dy) >> np.int32(31)
    w = bits_of_f32(dz) >> np.int32(31)
    return z | (x & np.int32(1)) | (y & np.int32(2)) | (w & np.int32(4))


@inlined
def regular(ray):
    """Return the mask of the rays whose numbers are finite: others would spoil a spread."""
    zero = np.float32(0)
    return (ray.enter_add[0] * zero + ray.enter_add[1] * zero + ray.enter_add[2] * zero) == zero


@inlined
def store_rays(columns, parts):
    """Store rays for ray_of_lane()."""
    at = 0
    for part in parts:
        store(columns, at, part[0])
        store(columns, at + LANES, part[1])
        store(columns, at + 2 * LANES, part[2])
        at += 3 * LANES


@inlined
def ray_of_lane(columns, turn, lane):
    """Return one of 16 stored rays."""
    return space_ray_of(
        turn,
        (
            _three(columns, lane),
            _three(columns, lane + 3 * LANES),
            _three(columns, lane + 6 * LANES),
            _three(columns, lane + 9 * LANES),
            _three(columns, lane + 12 * LANES),
            _three(columns, lane + 15 * LANES),
        ),
    )


@inlined
def _three(columns, at):
    return columns[at], columns[at + LANES], columns[at + 2 * LANES]


@inlined
def spread_of(origin, ray, mask):
    """Return the spread of the bundle's rays in the mask; origin: three F32."""
    return Spread(
        (least_of(origin[0], mask), least_of(origin[1], mask), least_of(origin[2], mask)),
        (most_of(origin[0], mask), most_of(origin[1], mask), most_of(origin[2], mask)),
        (
            _less(least_of(ray.enter[0], mask)),
            _less(least_of(ray.enter[1], mask)),
            _less(least_of(ray.enter[2], mask)),
        ),
        (
            _more(most_of(ray.enter[0], mask)),
            _more(most_of(ray.enter[1], mask)),
            _more(most_of(ray.enter[2], mask)),
        ),
    )


@inlined
def are_coherent(ray, mask):
    """Return True if the rays of a bundle, in the mask, stay close to each other for a while."""
    x, y = ray.shear[0], ray.shear[1]
    across = most_of(x, mask) - least_of(x, mask)
    up = most_of(y, mask) - least_of(y, mask)
    return max(across, up) < _COHERENT


@inlined
def least_of(x, mask):
    """Return the least of the mask's lanes."""
    return smallest(select(mask, x, _FAR))


@inlined
def most_of(x, mask):
    return -smallest(select(mask, -x, _FAR))


@inlined
def _less(x):
    return x - abs(x) * _WIDER


@inlined
def _more(x):
    return x + abs(x) * _WIDER


@inlined
def boxes_in_spread(near, far, ray, spread, t_min, t_max):
    """Return (mask, depths): which of 16 boxes any ray of a bundle may hit within [t_min, t_max].

    near, far: three F32 each, the planes that the rays hit first and last.
    """
    x0, x1 = _slab(near[0], far[0], spread, 0, ray.near[0] == 0)
    y0, y1 = _slab(near[1], far[1], spread, 1, ray.near[1] == WIDTH)
    z0, z1 = _slab(near[2], far[2], spread, 2, ray.near[2] == 2 * WIDTH)
    t0 = vmax(vmax(x0, y0), vmax(z0, t_min))
    t1 = vmin(vmin(x1, y1), vmin(z1, t_max))
    return t0 <= t1, t0


@inlined
def _slab(near, far, spread, axis, rises):
    # The first ray to enter starts nearest to the near plane; the last to leave, farthest from far.
    first = spread.origin_high[axis] if rises else spread.origin_low[axis]
    last = spread.origin_low[axis] if rises else spread.origin_high[axis]
    least, most = spread.least[axis], spread.most[axis]
    near, far = near - first, far - last
    return vmin(near * least, near * most), vmax(far * least, far * most)


@inlined
def children_in_spread(box, node, ray, spread, t_min, t_max):
    """Return (mask, depths): which of a node's children may be hit; see boxes_in_spread()."""
    at = node * BOX
    near, far = ray.near, ray.far
    return boxes_in_spread(
        (load(box, at + near[0]), load(box, at + near[1]), load(box, at + near[2])),
        (load(box, at + far[0]), load(box, at + far[1]), load(box, at + far[2])),
        ray,
        spread,
        t_min,
        t_max,
    )


@inlined
def rays_on_child(box, at, ray, t_min, t_max):
    """Return the mask of the rays that enter one child; at: the index of its low x."""
    near, far, enter, leave = ray.near, ray.far, ray.enter, ray.leave
    t0 = vmax(
        fma(enter[0], box[at + near[0]], ray.enter_add[0]),
        fma(enter[1], box[at + near[1]], ray.enter_add[1]),
    )
    tz = fma(enter[2], box[at + near[2]], ray.enter_add[2])
    t0 = vmax(t0, vmax(tz, t_min))
    t1 = vmin(
        fma(leave[0], box[at + far[0]], ray.leave_add[0]),
        fma(leave[1], box[at + far[1]], ray.leave_add[1]),
    )
    tz = fma(leave[2], box[at + far[2]], ray.leave_add[2])
    t1 = vmin(t1, vmin(tz, t_max))
    return t0 <= t1


@inlined
def triangles_in_spread(corner, leaf, ray, spread, t_min, t_max):
    """Return the bits of a leaf's triangles whose boxes may be hit."""
    at = leaf * CORNERS
    x0, x1 = _extent(corner, at)
    y0, y1 = _extent(corner, at + WIDTH)
    z0, z1 = _extent(corner, at + 2 * WIDTH)
    near = (
        x0 if ray.near[0] == 0 else x1,
        y0 if ray.near[1] == WIDTH else y1,
        z0 if ray.near[2] == 2 * WIDTH else z1,
    )
    far = (
        x1 if ray.near[0] == 0 else x0,
        y1 if ray.near[1] == WIDTH else y0,
        z1 if ray.near[2] == 2 * WIDTH else z0,
    )
    return bits(boxes_in_spread(near, far, ray, spread, t_min, t_max)[0])


@inlined
def _extent(corner, at):
    a, b, c = load(corner, at), load(corner, at + 3 * WIDTH), load(corner, at + 6 * WIDTH)
    return vmin(vmin(a, b), c), vmax(vmax(a, b), c)


@inlined
def rays_on_triangle(corner, at, ray, t_min, t_max):
    """Return (mask, t): which of a bundle's rays hit a triangle within (t_min, t_max), and where.

    at: the index of x of its first corner.
    """
    a = _sheared(corner, at, ray)
    b = _sheared(corner, at + 3 * WIDTH, ray)
    c = _sheared(corner, at + 6 * WIDTH, ray)
    return intersect_sheared(a, b, c, ray.shear[2], np.float32(0), t_min, t_max)


@inlined
def _sheared(corner, at, ray):
    """Return a corner relative to each ray's origin, sheared so that the ray is the z axis."""
    z = corner[at + ray.axes[2]] - ray.origin[2]
    x = fma(z, -ray.shear[0], corner[at + ray.axes[0]] - ray.origin[0])
    y = fma(z, -ray.shear[1], corner[at + ray.axes[1]] - ray.origin[1])
    return x, y, z
