"""A leaf's 16 triangles against a tile's 256 pixels.

Owns what a triangle is in the image: three edge functions and a key. Knows nothing of trees.

In homogeneous coordinates (X, Y, H) of the image, the function
    e(x, y) = (P x Q) . (x, y, 1)
is 0 on the line through the corners P and Q and positive on one side: a pixel is covered where the
three edges' functions have one sign. No corner is divided by its H, so nothing special happens
where a triangle crosses the eye's plane. The key K of its plane is affine in (x, y) as well: the
four functions are set up once, with 16 triangles in lanes; whole tiles and squares are rejected by
the functions' largest values in them; and what is left costs eight multiply-adds for 16 pixels.

Watertight: at an edge that two triangles share, both compute exactly opposite numbers, so that no
pixel is on the outer side of both. Therefore the edge functions are built of sums and differences
of the two corners, and evaluated by the same operations everywhere.

Sources: Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997 (edge
functions and 1 / Z); Greene, "Hierarchical Polygon Tiling with Coverage Masks", 1996 (squares).
"""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import CORNERS, WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.packets.footprint import pixels_of
from renderer.trace.packets.sample import FEW_PIXELS, cover_pixels, sample_pixels
from renderer.trace.packets.tile import (
    BEST,
    BOUNDS,
    COEFFICIENTS,
    COVERED,
    LEAST,
    OWNER,
    SEEN,
    SQUARE,
    TILE,
    first_point,
)
from renderer.trace.packets.view import ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS
from renderer.trace.simd.lanes import (
    LANES,
    bits,
    fma,
    lane_column,
    lane_row,
    lowest_bit,
    select,
    smallest,
    splat,
    to_f32,
    to_f64,
    vabs,
    vmax,
    vmin,
)
from renderer.trace.simd.memory import load, store

# A triangle's volume is a sum of terms that can be far larger than it: where the triangle is seen
# edge-on, or is a vast plain seen from just above. Where they are larger by DOUBTFUL, float32 has
# too few digits left for t, and the leaf's keys are computed anew in float64: one leaf in three to
# seven. Seen exactly edge-on, the volume is rounding and nothing else, and would be hit at any
# depth: below EDGE_ON of its terms it counts as 0.
DOUBTFUL = np.float32(8)
EDGE_ON = np.float64(1e-13)
# An edge function of corners that are `x` pixels from the image's middle is that much of x wrong.
SPECK_PX, SPECK_ROUNDING = np.float64(1 / 64), np.float64(2.0**-21)

SOME_PIXELS = 200

_E0, _E1, _E2, _KEY = np.arange(4)  # a triangle's functions, in the order of their coefficients


@inlined
def _camera_corner(corner, at, rows, r):
    """(X, Y, Z) of one corner of each triangle."""
    x = load(corner, at) - rows[r + ORIGIN]
    y = load(corner, at + WIDTH) - rows[r + ORIGIN + 1]
    z = load(corner, at + 2 * WIDTH) - rows[r + ORIGIN + 2]
    return (
        affine_row(rows, r + ROW_X, x, y, z),
        affine_row(rows, r + ROW_Y, x, y, z),
        affine_row(rows, r + ROW_Z, x, y, z),
    )


@inlined
def affine_row(rows, r, x, y, z):
    """One camera coordinate of p = o + (x, y, z), by the row at r."""
    return fma(x, rows[r], fma(y, rows[r + 1], fma(z, rows[r + 2], splat(rows[r + 3]))))


@inlined
def _camera_corner_exact(corner, at, rows, r):
    """The same in float64."""
    x = to_f64(load(corner, at)) - rows[r + ORIGIN]
    y = to_f64(load(corner, at + WIDTH)) - rows[r + ORIGIN + 1]
    z = to_f64(load(corner, at + 2 * WIDTH)) - rows[r + ORIGIN + 2]
    return (
        affine_row(rows, r + ROW_X, x, y, z),
        affine_row(rows, r + ROW_Y, x, y, z),
        affine_row(rows, r + ROW_Z, x, y, z),
    )


@inlined
def _camera_corners_exact(view, corner, leaf, space):
    at, r = leaf * CORNERS, space * ROWS
    return (
        _camera_corner_exact(corner, at, view.rows_exact, r),
        _camera_corner_exact(corner, at + 3 * WIDTH, view.rows_exact, r),
        _camera_corner_exact(corner, at + 6 * WIDTH, view.rows_exact, r),
    )


@inlined
def _rounded(v):
    return to_f32(v[0]), to_f32(v[1]), to_f32(v[2])


@inlined
def camera_corners(view, corner, leaf, space):
    """(X, Y, Z) of the corners a, b, c of a leaf's triangles.

    By way of float64 for views so narrow that float32 has no digits left for them.
    """
    at, r = leaf * CORNERS, space * ROWS
    if view.exact[space]:
        a, b, c = _camera_corners_exact(view, corner, leaf, space)
        return _rounded(a), _rounded(b), _rounded(c)
    return (
        _camera_corner(corner, at, view.rows, r),
        _camera_corner(corner, at + 3 * WIDTH, view.rows, r),
        _camera_corner(corner, at + 6 * WIDTH, view.rows, r),
    )


@inlined
def edge_function(p, q):
    """Coefficients of x, y and 1 of the edge p to q; p, q: (X, Y, H).

    (p + q) x (q - p) is twice p x q. The sum does not know the order of p and q, and the difference
    changes its sign with it: exactly opposite results for the two triangles at the edge.
    """
    dx, dy, dh = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    sx, sy, sh = p[0] + q[0], p[1] + q[1], p[2] + q[2]
    return fma(sy, dh, -(sh * dy)), fma(sh, dx, -(sx * dh)), fma(sx, dy, -(sy * dx))


@inlined
def key_function(view, a, b, c, ha, hb, hc):
    """(coefficients of x, y and 1 of the triangle's key, its volume, what that may be wrong by).

    The volume is that of the parallelepiped that the corners span with the eye, positive for one
    side of the triangle; the third number is the sum of the sizes of its terms. Any type of vector.
    """
    x1, y1, h1 = b[0] - a[0], b[1] - a[1], hb - ha
    x2, y2, h2 = c[0] - a[0], c[1] - a[1], hc - ha
    left_x, right_x, left_y, right_y = y1 * h2, h1 * y2, h1 * x2, x1 * h2
    left_h, right_h = x1 * y2, y1 * x2
    nx, ny, nh = left_x - right_x, left_y - right_y, left_h - right_h
    volume = fma(a[0], nx, fma(a[1], ny, ha * nh))
    terms = vabs(a[0]) * (vabs(left_x) + vabs(right_x))
    terms = fma(vabs(a[1]), vabs(left_y) + vabs(right_y), terms)
    terms = fma(vabs(ha), vabs(left_h) + vabs(right_h), terms)
    inverse = np.float32(1) / volume
    if view.parallel:
        # Z is affine in (x, y), and takes the corners' values at them.
        z1, z2 = b[2] - a[2], c[2] - a[2]
        kx = (z2 * y1 - z1 * y2) * inverse
        ky = (z1 * x2 - z2 * x1) * inverse
        k1 = -a[2] - kx * a[0] - ky * a[1]
    else:
        # Points of the plane have n . (X, Y, H) = volume, so 1 / H = n . (x, y, 1) / volume.
        kx, ky, k1 = nx * inverse, ny * inverse, nh * inverse
    return (kx, ky, k1), volume, terms


@inlined
def key_function_exact(view, corner, leaf, space, pa, pb, pc):
    """(coefficients of the key, sign of the volume) in float64, then rounded.

    The key is -inf for a triangle seen edge-on, and for one that is so small, or so far away, that
    float32 makes one point of two of its corners, or one line of all three. pa, pb, pc: its corners
    as edge_function() takes them, which then is 0 everywhere, or nothing but rounding: the triangle
    would cover a line, or all of the image.
    """
    a, b, c = _camera_corners_exact(view, corner, leaf, space)
    ha, hb, hc = a[2], b[2], c[2]
    if view.parallel:
        ha = hb = hc = to_f64(splat(np.float32(1)))
    (kx, ky, k1), volume, terms = key_function(view, a, b, c, ha, hb, hc)
    is_seen = vabs(volume) > terms * EDGE_ON
    is_seen = is_seen & _differ(pa, pb) & _differ(pb, pc) & _differ(pc, pa)
    # Few leaves have any, and the divisions would take as long as all the rest.
    close = vabs(ha * hb) * (2 * SPECK_PX)
    if bits((vabs(b[0] * ha - a[0] * hb) < close) & (vabs(b[1] * ha - a[1] * hb) < close)) != 0:
        is_seen = is_seen & ~_is_speck(
            a[0] / ha, a[1] / ha, b[0] / hb, b[1] / hb, c[0] / hc, c[1] / hc
        )
    zero = splat(np.float32(0))
    kx, ky = select(is_seen, to_f32(kx), zero), select(is_seen, to_f32(ky), zero)
    k1 = select(is_seen, to_f32(k1), np.float32(-np.inf))
    return (kx, ky, k1), select(volume >= np.float64(0), splat(np.float32(1)), np.float32(-1))


@inlined
def _is_speck(ax, ay, bx, by, cx, cy):
    """Which triangles of the image are smaller than SPECK_PX and thinner than float32 can tell."""
    x1, y1, x2, y2 = bx - ax, by - ay, cx - ax, cy - ay
    x3, y3 = x2 - x1, y2 - y1
    square = vmax(vmax(fma(x1, x1, y1 * y1), fma(x2, x2, y2 * y2)), fma(x3, x3, y3 * y3))
    area = vabs(fma(x1, y2, -(y1 * x2)))
    # Twice the area is the longest side times the height.
    height = fma(vabs(ax) + vabs(ay), SPECK_ROUNDING, splat(SPECK_ROUNDING))
    return (square < SPECK_PX * SPECK_PX) & (area * area < square * (height * height))


@inlined
def _differ(p, q):
    return (p[0] != q[0]) | (p[1] != q[1]) | (p[2] != q[2])


@inlined
def triangle_keys(view, corner, leaf, space, a, b, c, ha, hb, hc, wanted):
    """(coefficients of x, y and 1 of the triangles' keys, signs of their volumes), where wanted."""
    key, volume, terms = key_function(view, a, b, c, ha, hb, hc)
    sign = select(volume >= np.float32(0), splat(np.float32(1)), np.float32(-1))
    doubtful = wanted & (vabs(volume) * DOUBTFUL <= terms)
    if bits(doubtful) == 0:
        return key, sign
    pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    exact, exact_sign = key_function_exact(view, corner, leaf, space, pa, pb, pc)
    return (
        select(doubtful, exact[0], key[0]),
        select(doubtful, exact[1], key[1]),
        select(doubtful, exact[2], key[2]),
    ), select(doubtful, exact_sign, sign)


@inlined
def homogeneous(view, a, b, c):
    """H of three corners."""
    if view.parallel:
        one = splat(np.float32(1))
        return one, one, one
    return a[2], b[2], c[2]


@inlined
def _largest(f, x_low, x_high, y_low, y_high):
    """The largest value of an affine function over a rectangle."""
    return vmax(f[0] * x_low, f[0] * x_high) + vmax(f[1] * y_low, f[1] * y_high) + f[2]


@inlined
def _range(f, x_low, x_high, y_low, y_high):
    """The least and the largest value of an affine function over a rectangle."""
    left, right, top, bottom = f[0] * x_low, f[0] * x_high, f[1] * y_low, f[1] * y_high
    return (
        vmin(left, right) + vmin(top, bottom) + f[2],
        vmax(left, right) + vmax(top, bottom) + f[2],
    )


@inlined
def _signed(f, sign):
    return f[0] * sign, f[1] * sign, f[2] * sign


@inlined
def rasterize_leaf(
    view, corner, leaf, space, tile, footprint, squares_open, depth, least, floats, ints
):
    """Lets the tile's pixels see a leaf's triangles; gives the tile's new least key.

    least: the smallest of the pixels' best keys: what is not nearer cannot be seen by any.
    """
    # Set up the edges' functions of 16 triangles.
    a, b, c = camera_corners(view, corner, leaf, space)
    ha, hb, hc = homogeneous(view, a, b, c)
    pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    edges = edge_function(pa, pb), edge_function(pb, pc), edge_function(pc, pa)

    # Which may cover a pixel, if their volume is positive, or if it is negative?
    pixels = pixels_of(footprint)
    is_small = pixels <= FEW_PIXELS
    x_low, x_high, y_low, y_high = tile.x_low, tile.x_high, tile.y_low, tile.y_high
    if is_small:
        front, back, count = cover_pixels(
            view, edges, tile, footprint, squares_open, depth, floats, ints
        )
    else:
        count = 0
        low0, high0 = _range(edges[0], x_low, x_high, y_low, y_high)
        low1, high1 = _range(edges[1], x_low, x_high, y_low, y_high)
        low2, high2 = _range(edges[2], x_low, x_high, y_low, y_high)
        front = vmin(vmin(high0, high1), high2) >= np.float32(0)
        back = vmax(vmax(low0, low1), low2) <= np.float32(0)
    may = front | back
    if bits(may) == 0:
        return least
    key, sign = triangle_keys(view, corner, leaf, space, a, b, c, ha, hb, hc, may)
    e0, e1, e2 = _signed(edges[0], sign), _signed(edges[1], sign), _signed(edges[2], sign)
    if is_small:
        return sample_pixels(
            view, e0, e1, e2, key, leaf, space, tile, count, least, floats, ints
        )

    # Keep those that may cover a pixel of the tile, nearer than what it sees.
    is_front = sign > np.float32(0)
    may = (front & is_front) | (back & ~is_front)
    may = may & (_largest(key, x_low, x_high, y_low, y_high) > least)
    kept = bits(may)
    if kept == 0:
        return least
    for k in range(3):
        store(floats, COEFFICIENTS + LANES * k, e0[k])
        store(floats, COEFFICIENTS + LANES * (3 + k), e1[k])
        store(floats, COEFFICIENTS + LANES * (6 + k), e2[k])
        store(floats, COEFFICIENTS + LANES * (9 + k), key[k])

    # The largest values in the tile's first square.
    x_high -= np.float32(TILE - SQUARE)
    y_high -= np.float32(TILE - SQUARE)
    bound0 = _largest(e0, x_low, x_high, y_low, y_high)
    bound1 = _largest(e1, x_low, x_high, y_low, y_high)
    bound2 = _largest(e2, x_low, x_high, y_low, y_high)
    bound3 = _largest(key, x_low, x_high, y_low, y_high)

    # The same question for each square. Of many: squares in lanes, one triangle after the other.
    by_square = pixels <= SOME_PIXELS
    covered = squares_open
    if not by_square:
        store(floats, BOUNDS, bound0)
        store(floats, BOUNDS + LANES, bound1)
        store(floats, BOUNDS + 2 * LANES, bound2)
        store(floats, BOUNDS + 3 * LANES, bound3)
        covered = _covered_squares(kept, floats, ints) & squares_open
        if covered == 0:
            return least

    # Triangles in lanes again: those of each square.
    squares_of = load(ints, COVERED)
    while covered != 0:
        square = lowest_bit(covered)
        covered &= covered - 1
        if by_square:
            dx, dy = np.float32((square & 3) * SQUARE), np.float32((square >> 2) * SQUARE)
            inside = may & (fma(e0[0], dx, fma(e0[1], dy, bound0)) >= np.float32(0))
            inside = inside & (fma(e1[0], dx, fma(e1[1], dy, bound1)) >= np.float32(0))
            inside = inside & (fma(e2[0], dx, fma(e2[1], dy, bound2)) >= np.float32(0))
            inside = inside & (fma(key[0], dx, fma(key[1], dy, bound3)) > floats[LEAST + square])
            found = bits(inside)
            if found == 0:
                continue
        else:
            found = bits((squares_of & np.int32(1 << square)) != np.int32(0))
        x, y = first_point(tile, square)
        rasterize_triangles(view, found, leaf, space, x, y, square, floats, ints)
    return smallest(load(floats, LEAST))


@inlined
def _covered_squares(kept, floats, ints):
    """Writes COVERED, the squares of each kept triangle; gives those of any."""
    nearest = load(floats, LEAST)
    store(ints, COVERED, splat(np.int32(0)))
    covered = 0
    left = kept
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        may = _bound(floats, lane, _E0) >= np.float32(0)
        may = may & (_bound(floats, lane, _E1) >= np.float32(0))
        may = may & (_bound(floats, lane, _E2) >= np.float32(0))
        may = may & (_bound(floats, lane, _KEY) > nearest)
        squares = bits(may)
        ints[COVERED + lane] = squares
        covered |= squares
    return covered


@inlined
def _bound(floats, lane, function):
    """The largest value of a triangle's function in each square: the first one's, shifted."""
    i = COEFFICIENTS + 3 * LANES * function + lane
    bound = splat(floats[BOUNDS + LANES * function + lane])
    side = np.float32(SQUARE)
    below = fma(lane_row() * side, floats[i + LANES], bound)
    return fma(lane_column() * side, floats[i], below)


@inlined
def rasterize_triangles(view, found, leaf, space, x_first, y_first, square, floats, ints):
    """A square's 16 pixels against the triangles in `found`, bits of the leaf's lanes."""
    x, y = lane_column() + x_first, lane_row() + y_first
    best = load(floats, BEST + LANES * square)
    slot = load(ints, SEEN + LANES * square)
    before = best
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        i = COEFFICIENTS + lane
        inside = vmin(
            vmin(_at(floats, i, x, y), _at(floats, i + 3 * LANES, x, y)),
            _at(floats, i + 6 * LANES, x, y),
        )
        k = _at(floats, i + 9 * LANES, x, y)
        hit = (inside >= np.float32(0)) & (k < view.key_near) & (k > best)  # best: last, it waits
        best = select(hit, k, best)
        slot = select(hit, splat(np.int32(leaf * WIDTH + lane)), slot)
    store(floats, BEST + LANES * square, best)
    store(ints, SEEN + LANES * square, slot)
    owner = load(ints, OWNER + LANES * square)
    store(ints, OWNER + LANES * square, select(best > before, splat(np.int32(space)), owner))
    floats[LEAST + square] = smallest(best)


@inlined
def _at(floats, i, x, y):
    """A triangle's function at 16 pixels."""
    return fma(x, floats[i], fma(y, floats[i + LANES], splat(floats[i + 2 * LANES])))
