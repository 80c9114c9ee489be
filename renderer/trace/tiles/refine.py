"""The hits of a square's 16 pixels, computed once more in float64.

The parameter t and the hit's point are computed in views for which t's last place in float32 is too
coarse: very far away, or so narrow that it moves the point by a part of a pixel (view.py decides).
The visible primitives are known by then, so the cost is a plane or sphere for each one in a square.

Few views are coarse, and a square takes some nanoseconds. This code is therefore not inlined, which
would cost registers in all views; its results pass through the scratch.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import CORNERS, WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted
from lucida.renderer.trace.compile.stage import call_apart
from lucida.renderer.trace.reference.vectors import cross, dot, minus
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    lowest_bit,
    select,
    splat,
    to_f32,
    to_f64,
    vsqrt,
)
from lucida.renderer.trace.vector.math import dot_lanes, fma_lanes
from lucida.renderer.trace.vector.memory import load, store

from .smooth import camera_point
from .sphere import is_near_hit, key_at, moment, sphere_ray
from .tile import FIRST_SPHERE, NOTHING, scratch_of, square_points
from .view import ACROSS, DOWN, SHARED, VARYING


@inlined
def refine_square(view, world, tile, square, scratch):
    """Write exact_t (inf for no hit), rest_of_t and exact_point of a square's pixels.

    The points are relative to the view's near_point.
    """
    call_apart(_refine, (view, world, tile, square, scratch.coefficients, scratch.hit_slot))


@emitted
def packet_depths(view, square, scratch):
    """Return the depths Z that the packet found at a square's pixels."""
    best = load(scratch.best, LANES * square)
    return key_at(view, best)


@inlined
def _refine(view, world, tile, square, floats, ints):
    scratch = scratch_of(floats, ints)
    points = square_points(view, tile, square)
    exact = _exact_parameters(
        view, world, points, packet_depths(view, square, scratch), square, scratch
    )
    is_hit = load(scratch.hit_slot, LANES * square) != NOTHING
    t = select(is_hit, to_f32(exact), np.float32(np.inf))
    store(scratch.exact_t, 0, t)
    store(scratch.rest_of_t, 0, to_f32(exact - to_f64(t)))
    for axis in range(3):
        store(scratch.exact_point, LANES * axis, _coordinate(view, axis, points, exact))


@inlined
def _exact_parameters(view, world, points, z, square, scratch):
    """Return t of a square's pixels, F64. z: the depths that the packet found, F32."""
    seen = load(scratch.hit_slot, LANES * square)
    owner = load(scratch.hit_instance, LANES * square)
    exact = to_f64(z)
    left = bits(seen != NOTHING)
    while left != 0:
        lane = lowest_bit(left)
        number = scratch.hit_slot[LANES * square + lane]
        mask = seen == number
        if number <= FIRST_SPHERE:
            own = _sphere_depths(view, world.spheres, np.int64(FIRST_SPHERE) - number, points, z)
        else:
            space = np.int64(scratch.hit_instance[LANES * square + lane])
            mask = mask & (owner == np.int32(space))
            own = _plane_depths(view, world.corner, np.int64(number), space, points)
        exact = select(mask, own, exact)
        left &= ~bits(mask)
    return exact * view.scale


@emitted
def _plane_depths(view, corner, slot, space, points):
    """Return Z of the rays on a triangle's plane, F64: N . (p - a) = 0 in camera space."""
    at = slot // WIDTH * CORNERS + slot % WIDTH
    a = camera_point(view, space, corner, at)
    n = cross(
        minus(camera_point(view, space, corner, at + 3 * WIDTH), a),
        minus(camera_point(view, space, corner, at + 6 * WIDTH), a),
    )
    x, y = points.x, points.y
    column, row = to_f64(points.right), to_f64(points.down)

    def parallel():
        start = n[0] * (x - a[0]) + n[1] * (y - a[1])
        return a[2] - fma(column, n[0], fma(row, n[1], splat(start))) / n[2]

    def perspective():
        return dot(n, a) / fma(column, n[0], fma(row, n[1], splat(dot(n, (x, y, 1.0)))))

    return choose(view.parallel, parallel, perspective)


@emitted
def _sphere_depths(view, spheres, sphere, points, z):
    """Return Z of the rays' hits on a sphere, F64.
    z: the packet's depths, which select the root.
    """
    f, d = sphere_ray(view, spheres, sphere, points.x, points.y)
    m = moment(f, d)
    column, row = to_f64(points.right), to_f64(points.down)
    f, d, m = _lanes(f, column, row), _lanes(d, column, row), _lanes(m, column, row)
    a, b, c = dot_lanes(d, d), -dot_lanes(f, d), dot_lanes(f, f) - 1.0
    discriminant = a - dot_lanes(m, m)
    root = vsqrt(select(discriminant > 0.0, discriminant, 0.0))
    # Compute the root that would suffer cancellation as a quotient, as in sphere.py.
    ahead = b >= 0.0
    q = b + select(ahead, root, -root)
    near, far = select(ahead, c / q, q / a), select(ahead, q / a, c / q)
    return select(is_near_hit(z, to_f32(b / a)), near, far)


@emitted
def _lanes(p, column, row):
    """Return an affine vector at a square's pixels: three F64."""
    start = splat(p[0][0]), splat(p[0][1]), splat(p[0][2])
    return fma_lanes(column, p[1], fma_lanes(row, p[2], start))


@emitted
def _coordinate(view, axis, points, t):
    """Return one coordinate of the rays' points at t, F64, rounded only at the end."""
    ray, near = view.ray, view.near_point[axis]
    across, down, shared = ray[ACROSS + axis], ray[DOWN + axis], ray[SHARED + axis]
    start = ray[VARYING + axis] + points.x * across + points.y * down
    varying = fma(to_f64(points.right), across, fma(to_f64(points.down), down, splat(start)))
    return choose(
        view.parallel,
        lambda: to_f32(fma(t, shared, varying - near)),
        lambda: to_f32(fma(t, varying, splat(shared - near))),
    )
