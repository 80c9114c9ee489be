"""A sphere against a tile's pixels, exactly: 16 pixels in lanes.

Owns the ray equation of a sphere as polynomials of the image point. Knows nothing of trees.

Along the ray o + t d, with f = o - centre in units of the radius, the sphere is where
    a t^2 - 2 b t + c = 0,   a = d . d,   b = -f . d,   c = f . f - 1.
d and f are affine in the image point, and one of them is constant; so a, c and the discriminant
b b - a c = a - |f x d|^2 are polynomials of degree 2, and b one of degree 1. They are set up in
float64 around the first pixel of a square or a tile, where they are evaluated in float32: the
outline (discriminant 0) is as exact in the narrowest view as in a wide one.
"""

from __future__ import annotations

import numpy as np

from renderer.trace.compile.compiled import inlined
from renderer.trace.packets.tile import (
    BEST,
    FIRST_SPHERE,
    LEAST,
    SEEN,
    SQUARE,
    SQUARES,
)
from renderer.trace.packets.view import ACROSS, DOWN, SHARED, VARYING
from renderer.trace.scalar.vectors import cross, dot, minus, plus, times
from renderer.trace.simd.lanes import (
    LANES,
    bits,
    fma,
    lane_column,
    lane_row,
    select,
    smallest,
    splat,
    vabs,
    vsqrt,
)
from renderer.trace.simd.math import normalized_lanes
from renderer.trace.simd.memory import load, store

_X, _Y, _Z = np.arange(3)
_CHORD = np.float32(5e-7)  # relative: more than z and the chord's middle are rounded by


@inlined
def _numbers(array, at):
    return array[at], array[at + 1], array[at + 2]


@inlined
def sphere_ray(view, spheres, sphere, x, y):
    """(f, its changes across and down; d, its changes) at the image point (x, y), float64.

    f in radii; d so that the parameter is Z.
    """
    radius = spheres[4 * sphere + 3]
    centre = _numbers(spheres, 4 * sphere)
    ray, zero = view.ray, (0.0, 0.0, 0.0)
    across, down, shared = _numbers(ray, ACROSS), _numbers(ray, DOWN), _numbers(ray, SHARED)
    varying = plus(_numbers(ray, VARYING), plus(times(x, across), times(y, down)))
    per_f, per_d = 1.0 / radius, view.scale / radius
    if view.parallel:
        return (
            (times(per_f, minus(varying, centre)), times(per_f, across), times(per_f, down)),
            (times(per_d, shared), zero, zero),
        )
    return (
        (times(per_f, minus(shared, centre)), zero, zero),
        (times(per_d, varying), times(per_d, across), times(per_d, down)),
    )


@inlined
def moment(f, d):
    """f x d: affine as well. Its value, and its changes across and down."""
    return (
        cross(f[0], d[0]),
        plus(cross(f[1], d[0]), cross(f[0], d[1])),
        plus(cross(f[2], d[0]), cross(f[0], d[2])),
    )


@inlined
def _square(p, constant, sign):
    """constant + sign |p|^2, p affine: coefficients of 1, x, y, x x, x y, y y, as float32."""
    return (
        np.float32(constant + sign * dot(p[0], p[0])),
        np.float32(sign * 2.0 * dot(p[0], p[1])),
        np.float32(sign * 2.0 * dot(p[0], p[2])),
        np.float32(sign * dot(p[1], p[1])),
        np.float32(sign * 2.0 * dot(p[1], p[2])),
        np.float32(sign * dot(p[2], p[2])),
    )


@inlined
def sphere_equation(f, d):
    """The polynomials (a, b, c, discriminant) of sphere_ray()'s (f, d)."""
    a, c = _square(d, 0.0, 1.0), _square(f, -1.0, 1.0)
    m = moment(f, d)
    b = (
        np.float32(-dot(f[0], d[0])),
        np.float32(-dot(f[1], d[0]) - dot(f[0], d[1])),
        np.float32(-dot(f[2], d[0]) - dot(f[0], d[2])),
    )
    discriminant = (
        np.float32(dot(d[0], d[0]) - dot(m[0], m[0])),
        np.float32(2.0 * dot(d[0], d[1]) - 2.0 * dot(m[0], m[1])),
        np.float32(2.0 * dot(d[0], d[2]) - 2.0 * dot(m[0], m[2])),
        np.float32(dot(d[1], d[1]) - dot(m[1], m[1])),
        np.float32(2.0 * dot(d[1], d[2]) - 2.0 * dot(m[1], m[2])),
        np.float32(dot(d[2], d[2]) - dot(m[2], m[2])),
    )
    return a, b, c, discriminant


@inlined
def quadratic(p, x, y):
    """A polynomial at 16 image points, relative to where it was set up."""
    in_x = fma(x, p[3], fma(y, p[4], splat(p[1])))
    return fma(x, in_x, fma(y, fma(y, p[5], splat(p[2])), splat(p[0])))


@inlined
def affine(p, x, y):
    return fma(x, p[1], fma(y, p[2], splat(p[0])))


@inlined
def sphere_depths(equation, x, y):
    """(near, far, mask): Z of the two points of the sphere on each ray; mask: there are any.

    Each root in the form in which nothing cancels: with q = b +- sqrt(discriminant), of b's sign,
    the roots are c / q and q / a (Haines et al., Ray Tracing Gems, 2019, ch. 7).
    """
    a, c = quadratic(equation[0], x, y), quadratic(equation[2], x, y)
    b, discriminant = affine(equation[1], x, y), quadratic(equation[3], x, y)
    root = vsqrt(select(discriminant >= np.float32(0), discriminant, np.float32(0)))
    ahead = b >= np.float32(0)
    q = b + select(ahead, root, -root)
    first, second = c / q, q / a
    near, far = select(ahead, first, second), select(ahead, second, first)
    return near, far, discriminant >= np.float32(0)


@inlined
def intersect_sphere(view, spheres, sphere, tile, least, floats, ints):
    """Intersect a sphere with the tile's rays. Return the tile's new least key."""
    box = view.sphere_box
    left, top = box[4 * sphere], box[4 * sphere + 1]
    right, bottom = box[4 * sphere + 2], box[4 * sphere + 3]
    if left > tile.x_high or right < tile.x_low or top > tile.y_high or bottom < tile.y_low:
        return least
    f, d = sphere_ray(view, spheres, sphere, np.float64(tile.x), np.float64(tile.y))
    equation = sphere_equation(f, d)
    last = np.float32(SQUARE - 1)
    for square in range(SQUARES):
        dx, dy = np.float32((square & 3) * SQUARE), np.float32((square >> 2) * SQUARE)
        x, y = tile.x + dx, tile.y + dy
        if left > x + last or right < x or top > y + last or bottom < y:
            continue
        # The nearer point that lies within near and far.
        near, far, hit = sphere_depths(equation, lane_column() + dx, lane_row() + dy)
        z = select((near > view.z_near) & (near < view.z_far), near, far)
        hit = hit & (z > view.z_near) & (z < view.z_far)
        key = -z if view.parallel else splat(np.float32(1)) / z
        best = load(floats, BEST + LANES * square)
        hit = hit & (key > best)
        if bits(hit) == 0:
            continue
        best = select(hit, key, best)
        store(floats, BEST + LANES * square, best)
        seen = load(ints, SEEN + LANES * square)
        number = np.int32(FIRST_SPHERE - sphere)
        store(ints, SEEN + LANES * square, select(hit, splat(number), seen))
        floats[LEAST + square] = smallest(best)
    return smallest(load(floats, LEAST))


@inlined
def sphere_normal(view, spheres, sphere, first, z):
    """Outward unit normals of a sphere where a square's pixels see it, F32; z: the depths seen.

    From the ray's point nearest to the centre, d x (f x d) / a, half a chord back or forth: no
    difference of large numbers, however far away the sphere is.
    """
    f, d = sphere_ray(view, spheres, sphere, np.float64(first[0]), np.float64(first[1]))
    m = moment(f, d)
    equation = sphere_equation(f, d)
    x, y = lane_column(), lane_row()
    a, b = quadratic(equation[0], x, y), affine(equation[1], x, y)
    discriminant = quadratic(equation[3], x, y)
    dx, dy, dz = _component(d, _X, x, y), _component(d, _Y, x, y), _component(d, _Z, x, y)
    mx, my, mz = _component(m, _X, x, y), _component(m, _Y, x, y), _component(m, _Z, x, y)
    inverse = splat(np.float32(1)) / a
    # Half the chord, as a parameter.
    half = vsqrt(select(discriminant > np.float32(0), discriminant, np.float32(0))) * inverse
    half = select(is_near_hit(z, b * inverse), -half, half)
    return normalized_lanes(
        (
            fma(dy * mz - dz * my, inverse, half * dx),
            fma(dz * mx - dx * mz, inverse, half * dy),
            fma(dx * my - dy * mx, inverse, half * dz),
        )
    )


@inlined
def is_near_hit(z, middle):
    """Which pixels see the nearer of a sphere's two hits. z: of the hit; middle: of the chord's.

    Far away, where rounding makes all three one, the nearer is the one that is seen.
    """
    return z <= fma(vabs(middle), _CHORD, middle)


@inlined
def sphere_normal_at(view, spheres, sphere, point):
    """Outward unit normals of a sphere at 16 points of it, relative to the view's near_point."""
    x, y, z = minus(_numbers(spheres, 4 * sphere), _numbers(view.near_point, 0))
    return normalized_lanes(
        (point[0] - np.float32(x), point[1] - np.float32(y), point[2] - np.float32(z))
    )


@inlined
def _component(p, axis, x, y):
    """One coordinate of an affine vector at 16 image points."""
    value = fma(x, np.float32(p[1][axis]), splat(np.float32(p[0][axis])))
    return fma(y, np.float32(p[2][axis]), value)
