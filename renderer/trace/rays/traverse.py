"""Single rays on the wide trees: closest hit and any hit.

These functions trace incoherent rays: shadows, reflections, and the user's own. The lanes are the
16 children of a node, or the 16 triangles of a leaf. A shading kernel may call closest_hit and
any_hit.

Rays and arithmetic are float32, relative to the ray's origin; spheres are float64.

Sources: Kay and Kajiya 1986 (slabs); Wald, Benthin and Boulos, "Getting Rid of Packets", 2008;
Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013 (triangles).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import BOX, CORNERS, FIRST_LEAF, WIDTH
from lucida.renderer.trace.bvh.instances import HAS_HOLES, IS_SINGLE_SIDED, IS_UNMOVED
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import emitted
from lucida.renderer.trace.reference.vectors import (
    dot,
    minus,
    plus,
    rotated,
    times,
    transformed,
    triple,
)
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    lowest_bit,
    mask_of,
    select,
    smallest,
    splat,
    vmax,
    vmin,
)
from lucida.renderer.trace.vector.memory import load, store

from .holes import without_holes

_ROUNDING = np.float32(5e-7)  # relative: more than the total rounding error of a box test
_STEEP = np.float32(1e-9)  # least size of a direction's component, relative to the largest
_DEPTHS = LANES  # scratch: depths of the waiting nodes, after those of a node's children


class SpaceRay(NamedTuple):
    """A ray in an instance's space (or the world's), prepared for boxes and for triangles.

    near, far: columns of a node's boxes with the planes that the ray hits first and last.
    enter, leave: 1 / direction, slightly reduced and enlarged. enter_add, leave_add: the matching
    -origin / direction, with slack outwards.
    axes: columns of a leaf's coordinates x, y, z, where z is the axis of the direction's largest
    component. origin: in these axes. shear: maps the direction to (0, 0, 1). single_sided: 1 to
    ignore triangles' backs, else 0. space: the instance, if it has holes, else -1.
    """

    near: tuple[int, int, int]
    far: tuple[int, int, int]
    enter: tuple[np.float32, np.float32, np.float32]
    leave: tuple[np.float32, np.float32, np.float32]
    enter_add: tuple[np.float32, np.float32, np.float32]
    leave_add: tuple[np.float32, np.float32, np.float32]
    axes: tuple[np.int64, np.int64, np.int64]
    origin: tuple[np.float32, np.float32, np.float32]
    shear: tuple[np.float32, np.float32, np.float32]
    single_sided: np.float32
    space: np.int64


@inlined
def _steep(x, least):
    return x if abs(x) > least else math.copysign(least, x)


@inlined
def space_ray(origin, direction, attributes, space):
    """Prepare a ray.

    origin, direction: (3,) float64 in that space, direction not 0. attributes: of the instance
    `space`.
    """
    ox, oy, oz = np.float32(origin[0]), np.float32(origin[1]), np.float32(origin[2])
    dx, dy, dz = np.float32(direction[0]), np.float32(direction[1]), np.float32(direction[2])
    ax, ay, az = abs(dx), abs(dy), abs(dz)
    # For boxes, avoid division by 0, and infinity times 0.
    least = max(ax, ay, az) * _STEEP
    one = np.float32(1)
    ix, iy, iz = one / _steep(dx, least), one / _steep(dy, least), one / _steep(dz, least)
    smaller, larger = one - _ROUNDING, one + _ROUNDING
    enter, leave = (
        (ix * smaller, iy * smaller, iz * smaller),
        (ix * larger, iy * larger, iz * larger),
    )
    sx, sy, sz = abs(ox * ix) * _ROUNDING, abs(oy * iy) * _ROUNDING, abs(oz * iz) * _ROUNDING
    near = (
        (0 if ix >= 0 else 3) * WIDTH,
        (1 if iy >= 0 else 4) * WIDTH,
        (2 if iz >= 0 else 5) * WIDTH,
    )
    far = 3 * WIDTH - near[0], 5 * WIDTH - near[1], 7 * WIDTH - near[2]
    # For triangles, z is the axis of the largest component. Branchless, because the branch would
    # be unpredictable.
    is_x, is_y = (ax >= ay) & (ax >= az), ay >= az
    z = np.int64(0) if is_x else (np.int64(1) if is_y else np.int64(2))
    x = np.int64(0) if z == 2 else z + 1
    slope = _turned(is_x, is_y, dx, dy, dz)
    inverse = _turned(is_x, is_y, ix, iy, iz)[2]
    return SpaceRay(
        near,
        far,
        enter,
        leave,
        (-ox * enter[0] - sx, -oy * enter[1] - sy, -oz * enter[2] - sz),
        (-ox * leave[0] + sx, -oy * leave[1] + sy, -oz * leave[2] + sz),
        (x * WIDTH, (3 - x - z) * WIDTH, z * WIDTH),
        _turned(is_x, is_y, ox, oy, oz),
        (slope[0] * inverse, slope[1] * inverse, inverse),
        np.float32(1) if attributes & IS_SINGLE_SIDED else np.float32(0),
        np.int64(space) if attributes & HAS_HOLES else np.int64(-1),
    )


@inlined
def _turned(is_x, is_y, x, y, z):
    """Return (x, y, z) permuted cyclically, with x last if is_x, else y if is_y, else z."""
    return (
        y if is_x else (z if is_y else x),
        z if is_x else (x if is_y else y),
        x if is_x else (y if is_y else z),
    )


@emitted
def children_on_ray(box, node, ray, t_min, t_max):
    """Return (mask, depths): children of a node that the ray enters within [t_min, t_max]."""
    at = node * BOX
    near, far, enter, leave = ray.near, ray.far, ray.enter, ray.leave
    t0 = vmax(
        fma(load(box, at + near[0]), enter[0], splat(ray.enter_add[0])),
        fma(load(box, at + near[1]), enter[1], splat(ray.enter_add[1])),
    )
    tz = fma(load(box, at + near[2]), enter[2], splat(ray.enter_add[2]))
    t0 = vmax(t0, vmax(tz, t_min))
    t1 = vmin(
        fma(load(box, at + far[0]), leave[0], splat(ray.leave_add[0])),
        fma(load(box, at + far[1]), leave[1], splat(ray.leave_add[1])),
    )
    tz = fma(load(box, at + far[2]), leave[2], splat(ray.leave_add[2]))
    t1 = vmin(t1, vmin(tz, t_max))
    return t0 <= t1, t0


@inlined
def triangles_on_ray(corner, leaf, ray, t_min, t_max):
    """Return (bits, t): the leaf's triangles that the ray hits within (t_min, t_max), and their t.

    Two triangles with a common edge compute exactly opposite numbers for it, since products
    commute. The edge functions therefore do not use fma().
    """
    at = leaf * CORNERS
    a = _sheared(corner, at, ray)
    b = _sheared(corner, at + 3 * WIDTH, ray)
    c = _sheared(corner, at + 6 * WIDTH, ray)
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = a, b, c
    e0, e1, e2 = cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax
    zero, scale = np.float32(0), ray.shear[2]
    inside = (vmin(vmin(e0, e1), e2) >= zero) | (vmax(vmax(e0, e1), e2) <= zero)
    # t is a mean of the corners' t weighted by the edge functions, and never outside their range.
    # Compute it even if no triangle is hit, because mispredicting a branch would cost more.
    area = e0 + e1 + e2
    t = (e0 * az + e1 * bz + e2 * cz) * scale / area
    inside = inside & (area != zero) & (t > t_min) & (t < t_max)
    inside = inside & (area * (scale * ray.single_sided) >= zero)
    return bits(inside), select(inside, t, np.float32(np.inf))


@emitted
def _sheared(corner, at, ray):
    """Return a corner of 16 triangles relative to the origin, sheared so that the ray is the z
    axis.
    """
    z = load(corner, at + ray.axes[2]) - ray.origin[2]
    x = fma(z, -ray.shear[0], load(corner, at + ray.axes[0]) - ray.origin[0])
    y = fma(z, -ray.shear[1], load(corner, at + ray.axes[1]) - ray.origin[1])
    return x, y, z


@inlined
def instance_ray(world, space, origin, direction, passes_backs):
    """Return the ray in an instance's space; t stays the same.

    passes_backs: ignore the backs of single-sided surfaces, as viewing rays do but light does not.
    """
    attributes = world.attributes[space]
    if not passes_backs:
        attributes &= ~np.int32(IS_SINGLE_SIDED)
    if attributes & IS_UNMOVED:
        return space_ray(origin, direction, attributes, space)
    m, at = world.object_from_world, 12 * space
    origin, direction = transformed(m, at, origin), rotated(m, at, direction)
    return space_ray(origin, direction, attributes, space)


@inlined
def top_ray(world, origin, direction):
    """Return the ray in the space of the upper tree."""
    from_middle = minus(origin, triple(world.middle, 0))
    return space_ray(from_middle, direction, np.int32(0), np.int64(-1))


@inlined
def sphere_on_ray(world, sphere, origin, direction, t_min, t_max):
    """Return the least t within (t_min, t_max) where the ray hits a sphere; inf if there is none.

    Source: Haines et al., "Precision Improvements for Ray/Sphere Intersection", 2019.
    """
    at, spheres = 4 * sphere, world.spheres
    f, radius = minus(origin, triple(spheres, at)), spheres[at + 3]
    a, b = dot(direction, direction), -dot(f, direction)
    nearest = plus(f, times(b / a, direction))
    left_over = radius * radius - dot(nearest, nearest)
    if left_over < 0.0:
        return np.inf
    q = b + math.copysign(math.sqrt(a * left_over), b)
    first, second = (dot(f, f) - radius * radius) / q, q / a
    near, far = min(first, second), max(first, second)
    if t_min < near < t_max:
        return near
    return far if t_min < far < t_max else np.inf


@inlined
def _push_nearest_last(found, depth, child, node, top, floats, ints):
    """Push the children in `found` with their depths, the nearest on top. Return the new height."""
    store(floats, 0, depth)
    base = top
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        # Insertion sort, since there are few.
        t, i = floats[lane], top
        while i > base and floats[_DEPTHS + i - 1] < t:
            floats[_DEPTHS + i], ints[i] = floats[_DEPTHS + i - 1], ints[i - 1]
            i -= 1
        floats[_DEPTHS + i], ints[i] = t, child[node * WIDTH + lane]
        top += 1
    return top


@inlined
def closest_in_instance(world, ray, root, base, t_min, t_max, floats, ints):
    """Return (t, slot) of the closest triangle of an instance; (t_max, -1) if there is none.

    base: the stack's height.
    """
    closest, slot = t_max, np.int64(-1)
    floats[_DEPTHS + base], ints[base] = np.float32(-np.inf), root
    top = base + 1
    while top > base:
        top -= 1
        if floats[_DEPTHS + top] >= closest:
            continue
        node = np.int64(ints[top])
        if node >= 0:
            inside, depth = children_on_ray(world.box, node, ray, t_min, closest)
            top = _push_nearest_last(bits(inside), depth, world.child, node, top, floats, ints)
            continue
        leaf = FIRST_LEAF - node
        found, t = triangles_on_ray(world.corner, leaf, ray, t_min, closest)
        if found != 0 and ray.space >= 0:
            found = without_holes(world, ray, leaf, found)
            t = select(mask_of(found), t, np.float32(np.inf))
        if found != 0:
            closest = smallest(t)
            slot = leaf * WIDTH + lowest_bit(bits(t == closest))
    return closest, slot


@inlined
def closest_hit(world, origin, direction, t_min, t_max, floats, ints):
    """Return (t, slot, space) of the closest hit along a ray: world space, t_min < t < t_max.

    slot: of a triangle of instance `space`, or FIRST_LEAF - k for sphere k, or -1 for no hit, with
    t inf.
    floats, ints: scratch of one thread, the stack's size and 16 more elements.
    """
    closest, slot, in_space = t_max, np.int64(-1), np.int64(-1)
    if world.is_empty:
        return np.float32(np.inf), slot, in_space
    ray = top_ray(world, origin, direction)
    floats[_DEPTHS], ints[0] = np.float32(-np.inf), world.top
    top = 1
    while top > 0:
        top -= 1
        if floats[_DEPTHS + top] >= closest:
            continue
        node = np.int64(ints[top])
        if node >= 0:
            inside, depth = children_on_ray(world.top_box, node, ray, t_min, closest)
            top = _push_nearest_last(bits(inside), depth, world.top_child, node, top, floats, ints)
            continue
        item = FIRST_LEAF - node
        if item >= world.instances:
            sphere = item - world.instances
            t = np.float32(sphere_on_ray(world, sphere, origin, direction, t_min, closest))
            if t < closest:
                closest, slot, in_space = t, FIRST_LEAF - sphere, np.int64(-1)
            continue
        inner = instance_ray(world, item, origin, direction, True)
        t, found_slot = closest_in_instance(
            world, inner, world.root[item], top, t_min, closest, floats, ints
        )
        if found_slot >= 0:
            closest, slot, in_space = t, found_slot, item
    return (closest if slot != -1 else np.float32(np.inf)), slot, in_space


@inlined
def any_in_instance(world, ray, root, base, t_min, t_max, ints):
    """Return True if the ray hits any triangle of an instance."""
    ints[base] = root
    top = base + 1
    while top > base:
        top -= 1
        node = np.int64(ints[top])
        if node >= 0:
            inside, _ = children_on_ray(world.box, node, ray, t_min, t_max)
            top = _push_any(bits(inside), world.child, node, top, ints)
        else:
            found, _ = triangles_on_ray(world.corner, FIRST_LEAF - node, ray, t_min, t_max)
            if found != 0 and ray.space >= 0:
                found = without_holes(world, ray, FIRST_LEAF - node, found)
            if found != 0:
                return True
    return False


@inlined
def _push_any(found, child, node, top, ints):
    while found != 0:
        ints[top] = child[node * WIDTH + lowest_bit(found)]
        found &= found - 1
        top += 1
    return top


@inlined
def any_hit(world, origin, direction, t_min, t_max, ints):
    """Return True if a shadow ray hits anything, including backs, with t_min < t < t_max.

    Stops at the first hit found, in no particular order.
    """
    if world.is_empty:
        return False
    ray = top_ray(world, origin, direction)
    ints[0] = world.top
    top = 1
    while top > 0:
        top -= 1
        node = np.int64(ints[top])
        if node >= 0:
            inside, _ = children_on_ray(world.top_box, node, ray, t_min, t_max)
            top = _push_any(bits(inside), world.top_child, node, top, ints)
            continue
        item = FIRST_LEAF - node
        if item >= world.instances:
            sphere = item - world.instances
            if sphere_on_ray(world, sphere, origin, direction, t_min, t_max) < np.inf:
                return True
            continue
        inner = instance_ray(world, item, origin, direction, False)
        if any_in_instance(world, inner, world.root[item], top, t_min, t_max, ints):
            return True
    return False
