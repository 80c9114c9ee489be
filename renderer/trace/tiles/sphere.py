"""A sphere against a tile's pixels, exactly: 16 pixels in lanes.

Along the ray o + t d, with f = o - centre in units of the radius, the sphere is where
    a t^2 - 2 b t + c = 0,   a = d . d,   b = -f . d,   c = f . f - 1.
d and f are affine in the image point, and one of them is constant. Therefore a, c and the
discriminant b b - a c = a - |f x d|^2 are polynomials of degree 2, and b is one of degree 1. They
are set up in float64 around the first pixel of a square or a tile, where they are evaluated in
float32: the outline (discriminant 0) is as exact in the narrowest view as in a wide one.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted, f32
from lucida.renderer.trace.reference.vectors import cross, dot, minus, plus, times, triple
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    select,
    smallest,
    splat,
    vabs,
    vsqrt,
)
from lucida.renderer.trace.vector.math import fma_lanes, normalized_lanes, splat_lanes
from lucida.renderer.trace.vector.memory import load

from .tile import FIRST_SPHERE, SQUARE, SQUARES, depth_range, set_hits, square_points
from .view import ACROSS, DOWN, SHARED, VARYING

_CHORD = np.float32(5e-7)  # relative; above the rounding errors of z and the chord's middle


@emitted
def sphere_ray(view, spheres, sphere, x, y):
    """Return (f, its changes across and down; d, its changes) at the image point (x, y), float64.

    f: in radii. d: scaled so that the parameter is Z.
    """
    radius = spheres[4 * sphere + 3]
    centre = triple(spheres, 4 * sphere)
    ray, zero = view.ray, (0.0, 0.0, 0.0)
    across, down, shared = triple(ray, ACROSS), triple(ray, DOWN), triple(ray, SHARED)
    varying = plus(triple(ray, VARYING), plus(times(x, across), times(y, down)))
    per_f, per_d = 1.0 / radius, view.scale / radius
    return choose(
        view.parallel,
        lambda: (
            (times(per_f, minus(varying, centre)), times(per_f, across), times(per_f, down)),
            (times(per_d, shared), zero, zero),
        ),
        lambda: (
            (times(per_f, minus(shared, centre)), zero, zero),
            (times(per_d, varying), times(per_d, across), times(per_d, down)),
        ),
    )


@emitted
def moment(f, d):
    """Return f x d, affine as well: its value, and its changes across and down."""
    return (
        cross(f[0], d[0]),
        plus(cross(f[1], d[0]), cross(f[0], d[1])),
        plus(cross(f[2], d[0]), cross(f[0], d[2])),
    )


@emitted
def _square(p):
    """Return |p|^2, p affine: coefficients of 1, x, y, x x, x y, y y."""
    return (
        (dot(p[0], p[0]), 2.0 * dot(p[0], p[1]), 2.0 * dot(p[0], p[2])),
        (dot(p[1], p[1]), 2.0 * dot(p[1], p[2]), dot(p[2], p[2])),
    )


@emitted
def _rounded(p):
    """Return the coefficients of _square() as float32."""
    return tuple(f32(coefficient) for part in p for coefficient in part)


@emitted
def sphere_equation(f, d):
    """Return the polynomials (a, b, c, discriminant) of sphere_ray()'s (f, d)."""
    a, c, m = _square(d), _square(f), _square(moment(f, d))
    b = (
        f32(-dot(f[0], d[0])),
        f32(-dot(f[1], d[0]) - dot(f[0], d[1])),
        f32(-dot(f[2], d[0]) - dot(f[0], d[2])),
    )
    discriminant = minus(a[0], m[0]), minus(a[1], m[1])
    c = minus(c[0], (1.0, 0.0, 0.0)), c[1]
    return _rounded(a), b, _rounded(c), _rounded(discriminant)


@emitted
def quadratic(p, x, y):
    """Return a polynomial at 16 image points, relative to where it was set up."""
    in_x = fma(x, p[3], fma(y, p[4], splat(p[1])))
    return fma(x, in_x, fma(y, fma(y, p[5], splat(p[2])), splat(p[0])))


@emitted
def affine(p, x, y):
    return fma(x, p[1], fma(y, p[2], splat(p[0])))


@emitted
def sphere_depths(equation, x, y):
    """Return (near, far, mask): Z of the sphere's two points on each ray. mask: lanes that have
    them.

    Each root is computed in the form without cancellation. If q = b +- sqrt(discriminant) takes the
    sign of b, the roots are c / q and q / a (Haines et al., Ray Tracing Gems, 2019, ch. 7).
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
def intersect_sphere(view, spheres, sphere, tile, least, scratch):
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
        points = square_points(view, tile, square)
        own, column, row = _at_square(view, spheres, sphere, equation, points, dx, dy)
        near, far, hit = sphere_depths(own, column, row)
        z_near, z_far = depth_range(view, square, scratch)
        z = select((near > z_near) & (near < z_far), near, far)
        hit = hit & (z > z_near) & (z < z_far)
        key = key_at(view, z)
        hit = hit & (key > load(scratch.best, LANES * square))
        if bits(hit) != 0:
            set_hits(scratch, square, hit, key, FIRST_SPHERE - sphere, 0)
    return smallest(load(scratch.least, 0))


@emitted
def _at_square(view, spheres, sphere, equation, points, dx, dy):
    """Return a sphere's equation, and the square's pixels relative to its origin. The equation is
    the tile's; behind a lens, whose frames may span half of a small image, it is the square's own.
    """
    if view.lens is None:
        return equation, points.right + dx, points.down + dy
    f, d = sphere_ray(view, spheres, sphere, points.x, points.y)
    return sphere_equation(f, d), points.right, points.down


@emitted
def key_at(view, z):
    """Return the key of Z."""
    return choose(view.parallel, lambda: -z, lambda: splat(np.float32(1)) / z)


@emitted
def sphere_normal(view, spheres, sphere, points, z):
    """Return outward unit normals of a sphere at a square's pixels, F32. z: the visible depths.

    Start at the ray's point nearest to the centre, d x (f x d) / a, and go half a chord back or
    forth: no large numbers are subtracted, however far away the sphere is.
    """
    f, d = sphere_ray(view, spheres, sphere, points.x, points.y)
    m = moment(f, d)
    equation = sphere_equation(f, d)
    x, y = points.right, points.down
    a, b = quadratic(equation[0], x, y), affine(equation[1], x, y)
    discriminant = quadratic(equation[3], x, y)
    d, m = _vectors(d, x, y), _vectors(m, x, y)
    inverse = splat(np.float32(1)) / a
    # Half the chord, as a parameter.
    half = vsqrt(select(discriminant > np.float32(0), discriminant, np.float32(0))) * inverse
    half = select(is_near_hit(z, b * inverse), -half, half)
    return normalized_lanes(fma_lanes(inverse, cross(d, m), times(half, d)))


@emitted
def is_near_hit(z, middle):
    """Return which pixels see a sphere's nearer hit. z: the hit's; middle: the chord's.

    Rounding may make both hits and the middle equal far away; the nearer hit is then visible.
    """
    return z <= fma(vabs(middle), _CHORD, middle)


@emitted
def sphere_normal_at(view, spheres, sphere, point):
    """Return outward unit normals at 16 points of a sphere, relative to the view's near_point."""
    centre = minus(triple(spheres, 4 * sphere), triple(view.near_point, 0))
    return normalized_lanes(minus(point, splat_lanes(centre)))


@emitted
def _vectors(p, x, y):
    """Return an affine vector at 16 image points."""
    return fma_lanes(y, splat_lanes(p[2]), fma_lanes(x, splat_lanes(p[1]), splat_lanes(p[0])))
