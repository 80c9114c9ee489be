"""A leaf's 16 triangles in the image: three edge functions and a key each, set up in lanes.

In homogeneous coordinates (X, Y, H) of the image, the function
    e(x, y) = (P x Q) . (x, y, 1)
is 0 on the line through the corners P and Q and positive on one side. A pixel is covered if the
three edges' functions have the sign of the triangle's volume. No corner is divided by its H, so
nothing special happens where a triangle crosses the eye's plane. The key K of its plane is affine
in (x, y) as well.

The test is watertight: two triangles compute exactly opposite numbers at a shared edge, so that no
pixel is on the outer side of both. Therefore the edge functions are built of sums and differences
of the two corners, and evaluated by the same operations everywhere.

Source: Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997 (edge
functions and 1 / Z).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import CORNERS, WIDTH
from lucida.renderer.trace.compile.emit import choose, emitted, f64
from lucida.renderer.trace.reference.vectors import minus, plus, triple
from lucida.renderer.trace.vector.lanes import bits, fma, select, splat, to_f32, to_f64, vabs, vmax
from lucida.renderer.trace.vector.math import load3, select_lanes

from .view import ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS

# A triangle's volume is a sum of terms that can be far larger than the sum, if the triangle is seen
# edge-on, or is a vast plain seen from just above. If they are larger by DOUBTFUL, float32 has too
# few digits left for t, and the key is computed again in float64; this happens in one leaf out of
# three to seven. If the triangle is seen exactly edge-on, its volume is only rounding, and it would
# be hit at any depth: a volume below EDGE_ON of its terms counts as 0.
DOUBTFUL = np.float32(8)
EDGE_ON = np.float64(1e-13)
# The nh of a thin triangle is a small difference of large terms, but its rounding hardly moves the
# key on the triangle, because nh and the volume, its divisor, have the same error.
SLIVER = np.float32(1 / 8)
# The error of an edge function, relative to its corners' distance from the image's middle.
SPECK_PX, SPECK_ROUNDING = np.float64(1 / 64), np.float64(2.0**-21)


class Triangles(NamedTuple):
    """A leaf's triangles in a tile: their edge functions, positive inside, and keys, in lanes.

    Lane k is slot leaf * WIDTH + k. space: the instance. Coordinates are relative to the tile's
    first pixel.
    """

    edges: tuple[Any, Any, Any]
    key: Any
    leaf: np.int64
    space: np.int64


@emitted
def _camera_corner(p, rows, r):
    """Return (X, Y, Z) of one corner of each triangle."""
    q = minus(p, triple(rows, r + ORIGIN))
    return (
        affine_row(rows, r + ROW_X, q),
        affine_row(rows, r + ROW_Y, q),
        affine_row(rows, r + ROW_Z, q),
    )


@emitted
def affine_row(rows, r, q):
    """Return one camera coordinate of p = o + q, by the row at r."""
    return fma(q[0], rows[r], fma(q[1], rows[r + 1], fma(q[2], rows[r + 2], splat(rows[r + 3]))))


@emitted
def _exact(v):
    return to_f64(v[0]), to_f64(v[1]), to_f64(v[2])


@emitted
def _rounded(v):
    return to_f32(v[0]), to_f32(v[1]), to_f32(v[2])


@emitted
def _camera_corners_exact(view, corner, leaf, space, tile):
    at, rows, r = leaf * CORNERS, view.rows_exact, space * ROWS
    return (
        _seen_from(view, tile, _camera_corner(_exact(load3(corner, at)), rows, r)),
        _seen_from(view, tile, _camera_corner(_exact(load3(corner, at + 3 * WIDTH)), rows, r)),
        _seen_from(view, tile, _camera_corner(_exact(load3(corner, at + 6 * WIDTH)), rows, r)),
    )


@emitted
def _seen_from(view, tile, p):
    """Return (X, Y, Z) from the tile's first pixel."""
    x, y = f64(tile.x), f64(tile.y)
    return choose(
        view.parallel,
        lambda: (p[0] - x, p[1] - y, p[2]),
        lambda: (fma(p[2], -x, p[0]), fma(p[2], -y, p[1]), p[2]),
    )


@emitted
def camera_corners(view, corner, leaf, space, tile, scratch):
    """Return (X, Y, Z) of the corners a, b, c of a leaf's triangles, from the tile's first pixel.

    They are computed in float64 for views so narrow that float32 has no digits left for them.
    """

    def exact():
        a, b, c = _camera_corners_exact(view, corner, leaf, space, tile)
        return _rounded(a), _rounded(b), _rounded(c)

    def usual():
        at, rows = leaf * CORNERS, scratch.rows
        return (
            _camera_corner(load3(corner, at), rows, 0),
            _camera_corner(load3(corner, at + 3 * WIDTH), rows, 0),
            _camera_corner(load3(corner, at + 6 * WIDTH), rows, 0),
        )

    return choose(view.exact[space] != 0, exact, usual)


@emitted
def edge_function(p, q):
    """Return the coefficients of x, y and 1 of the edge p to q; p, q: (X, Y, H).

    (p + q) x (q - p) is twice p x q. The sum does not depend on the order of p and q, and the
    difference changes its sign with it, so the two triangles at the edge get exactly opposite
    results.
    """
    dx, dy, dh = minus(q, p)
    sx, sy, sh = plus(p, q)
    return fma(sy, dh, -(sh * dy)), fma(sh, dx, -(sx * dh)), fma(sx, dy, -(sy * dx))


@emitted
def key_function(view, a, b, c, ha, hb, hc):
    """Return (coefficients of x, y and 1 of the triangle's key, its volume, the volume's terms).

    The volume is that of the parallelepiped that the corners span with the eye, positive for one
    side of the triangle; the third number is the sum of the sizes of its terms. Vectors of any type
    are accepted.
    """
    x1, y1, h1 = b[0] - a[0], b[1] - a[1], hb - ha
    x2, y2, h2 = c[0] - a[0], c[1] - a[1], hc - ha
    left_x, right_x, left_y, right_y = y1 * h2, h1 * y2, h1 * x2, x1 * h2
    left_h, right_h = x1 * y2, y1 * x2
    nx, ny, nh = left_x - right_x, left_y - right_y, left_h - right_h
    volume = fma(a[0], nx, fma(a[1], ny, ha * nh))
    terms = vabs(a[0]) * (vabs(left_x) + vabs(right_x))
    terms = fma(vabs(a[1]), vabs(left_y) + vabs(right_y), terms)
    terms = fma(vabs(ha) * SLIVER, vabs(left_h) + vabs(right_h), terms)
    inverse = np.float32(1) / volume

    def parallel():
        # Z is affine in (x, y), and interpolates the corners' values.
        z1, z2 = b[2] - a[2], c[2] - a[2]
        kx = (z2 * y1 - z1 * y2) * inverse
        ky = (z1 * x2 - z2 * x1) * inverse
        return kx, ky, -a[2] - kx * a[0] - ky * a[1]

    def perspective():
        # Points of the plane have n . (X, Y, H) = volume, so 1 / H = n . (x, y, 1) / volume.
        return nx * inverse, ny * inverse, nh * inverse

    return choose(view.parallel, parallel, perspective), volume, terms


@emitted
def key_function_exact(view, corner, leaf, space, tile, pa, pb, pc):
    """Return (coefficients of the key, sign of the volume), computed in float64, then rounded.

    The key is -inf for a triangle seen edge-on, and for one so small or so far away that float32
    merges two of its corners into one point, or all three into one line. pa, pb, pc: its corners as
    for edge_function(), whose result is then 0 everywhere or only rounding, so that the triangle
    would cover a line or the whole image.
    """
    a, b, c = _camera_corners_exact(view, corner, leaf, space, tile)
    one = to_f64(splat(np.float32(1)))
    ha, hb, hc = choose(view.parallel, lambda: (one, one, one), lambda: (a[2], b[2], c[2]))
    (kx, ky, k1), volume, terms = key_function(view, a, b, c, ha, hb, hc)
    is_seen = vabs(volume) > terms * EDGE_ON
    is_seen = is_seen & _differ(pa, pb) & _differ(pb, pc) & _differ(pc, pa)
    # Few leaves have any, and the divisions would take as long as all the rest.
    close = vabs(ha * hb) * (2 * SPECK_PX)
    is_close = (vabs(b[0] * ha - a[0] * hb) < close) & (vabs(b[1] * ha - a[1] * hb) < close)
    is_seen = choose(
        bits(is_close) != 0,
        lambda: (
            is_seen
            & ~_is_speck(tile, a[0] / ha, a[1] / ha, b[0] / hb, b[1] / hb, c[0] / hc, c[1] / hc)
        ),
        lambda: is_seen,
    )
    zero = splat(np.float32(0))
    kx, ky = select(is_seen, to_f32(kx), zero), select(is_seen, to_f32(ky), zero)
    k1 = select(is_seen, to_f32(k1), np.float32(-np.inf))
    return (kx, ky, k1), select(volume >= np.float64(0), splat(np.float32(1)), np.float32(-1))


@emitted
def _is_speck(tile, ax, ay, bx, by, cx, cy):
    """Return a mask of the triangles smaller than SPECK_PX and too thin for float32."""
    x1, y1, x2, y2 = bx - ax, by - ay, cx - ax, cy - ay
    x3, y3 = x2 - x1, y2 - y1
    square = vmax(vmax(fma(x1, x1, y1 * y1), fma(x2, x2, y2 * y2)), fma(x3, x3, y3 * y3))
    area = vabs(fma(x1, y2, -(y1 * x2)))
    # Twice the area is the longest side times the height.
    far = np.float64(1) + abs(f64(tile.x)) + abs(f64(tile.y))
    height = fma(vabs(ax) + vabs(ay), SPECK_ROUNDING, splat(far * SPECK_ROUNDING))
    return (square < SPECK_PX * SPECK_PX) & (area * area < square * (height * height))


@emitted
def _differ(p, q):
    return (p[0] != q[0]) | (p[1] != q[1]) | (p[2] != q[2])


@emitted
def triangle_keys(view, corner, leaf, space, tile, a, b, c, ha, hb, hc, wanted):
    """Return (coefficients of x, y and 1 of the keys, signs of the volumes) in the lanes of
    `wanted`.

    The key is -inf for an invisible back.
    """
    key, volume, terms = key_function(view, a, b, c, ha, hb, hc)
    sign = select(volume >= np.float32(0), splat(np.float32(1)), np.float32(-1))
    doubtful = wanted & (vabs(volume) * DOUBTFUL <= terms)

    def corrected():
        pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
        exact, exact_sign = key_function_exact(view, corner, leaf, space, tile, pa, pb, pc)
        return select_lanes(doubtful, exact, key), select(doubtful, exact_sign, sign)

    key, sign = choose(bits(doubtful) != 0, corrected, lambda: (key, sign))
    return _without_backs(view, space, key, sign), sign


@emitted
def _without_backs(view, space, key, sign):
    is_seen = sign * view.back[space] <= np.float32(0)
    return key[0], key[1], select(is_seen, key[2], np.float32(-np.inf))


@emitted
def homogeneous(view, a, b, c):
    """Return H of three corners."""
    one = splat(np.float32(1))
    return choose(view.parallel, lambda: (one, one, one), lambda: (a[2], b[2], c[2]))
