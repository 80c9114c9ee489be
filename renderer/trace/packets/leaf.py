"""A leaf's 16 triangles against a tile's 256 pixels.

Owns how they are divided among squares and pixels. Knows nothing of trees.

A triangle is three edge functions and a key (triangle.py), which are affine in the image. They are
set up once, with 16 triangles in lanes; keys only where a triangle may cover a pixel. Whole tiles
and squares are rejected by the functions' largest values in them; and what is left costs eight
multiply-adds for 16 pixels. On few squares, each is asked for its triangles, 16 in lanes; on many,
each triangle for its squares; and of few pixels, each is asked for its triangles (sample.py).

Source: Greene, "Hierarchical Polygon Tiling with Coverage Masks", 1996 (squares).
"""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import WIDTH
from renderer.trace.bvh.instances import HAS_HOLES
from renderer.trace.compile.compiled import inlined
from renderer.trace.compile.stage import call_apart
from renderer.trace.packets.footprint import pixels_of
from renderer.trace.packets.sample import FEW_PIXELS, cover_pixels, sample_pixels
from renderer.trace.packets.smooth import barycentrics, vertices_of
from renderer.trace.packets.texture import are_holes
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
from renderer.trace.packets.triangle import (
    camera_corners,
    edge_function,
    homogeneous,
    triangle_keys,
)
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
    vmax,
    vmin,
)
from renderer.trace.simd.memory import load, store

# A leaf on so few pixels (of a footprint) is on few squares.
SOME_PIXELS = 100

_E0, _E1, _E2, _KEY = np.arange(4)  # a triangle's functions, in the order of their coefficients


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
    """An edge's function, positive inside. Exactly: a sign changes no other bit."""
    return f[0] * sign, f[1] * sign, f[2] * sign


@inlined
def rasterize_leaf(
    view, world, leaf, space, tile, footprint, squares_open, depth, least, floats, ints
):
    """Rasterize a leaf's triangles into the tile. Return the tile's new least key.

    footprint: of the leaf's box; depth: the least Z in it. squares_open: those of the footprint's
    squares, bits, in which some pixel sees nothing nearer. least: the smallest of the pixels' best
    keys: nothing farther can be seen by any.
    """
    # Set up the edges' functions of 16 triangles; they still lack the sign of the volume.
    corner = world.corner
    a, b, c = camera_corners(view, corner, leaf, space)
    ha, hb, hc = homogeneous(view, a, b, c)
    pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    edges = edge_function(pa, pb), edge_function(pb, pc), edge_function(pc, pa)

    # Which may cover a pixel, if their volume is positive, and if it is negative?
    pixels = pixels_of(footprint)
    has_holes = world.attributes[space] & HAS_HOLES != 0
    has_few = pixels <= FEW_PIXELS and not has_holes
    x_low, x_high, y_low, y_high = tile.x_low, tile.x_high, tile.y_low, tile.y_high
    if has_few:
        front, back, count = cover_pixels(
            view, edges, tile, footprint, squares_open, depth, floats, ints
        )
    else:
        count = 0
        low0, high0 = _range(edges[0], x_low, x_high, y_low, y_high)
        low1, high1 = _range(edges[1], x_low, x_high, y_low, y_high)
        low2, high2 = _range(edges[2], x_low, x_high, y_low, y_high)
        zero = np.float32(0)
        front = (high0 >= zero) & (high1 >= zero) & (high2 >= zero)
        back = (low0 <= zero) & (low1 <= zero) & (low2 <= zero)
    may = front | back
    if bits(may) == 0:
        return least
    key, sign = triangle_keys(view, corner, leaf, space, a, b, c, ha, hb, hc, may)
    e0, e1, e2 = _signed(edges[0], sign), _signed(edges[1], sign), _signed(edges[2], sign)
    if has_few:
        return sample_pixels(view, e0, e1, e2, key, leaf, space, tile, count, least, floats, ints)

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

    # The same question for each square: of few, one after the other; of many, with squares in
    # lanes, one triangle after the other.
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
        if has_holes:
            call_apart(
                _rasterize_with_holes,
                (view, world, np.int64(found), leaf, space, x, y, square, floats, ints),
            )
        else:
            rasterize_triangles(view, found, leaf, space, x, y, square, floats, ints)
    return smallest(load(floats, LEAST))


@inlined
def _covered_squares(kept, floats, ints):
    """Write COVERED, the squares of each kept triangle. Return those of any."""
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
        # `best` last: it is the triangle's before that is waited for.
        hit = (inside >= np.float32(0)) & (k < view.key_near) & (k > best)
        best = select(hit, k, best)
        slot = select(hit, splat(np.int32(leaf * WIDTH + lane)), slot)
    store(floats, BEST + LANES * square, best)
    store(ints, SEEN + LANES * square, slot)
    owner = load(ints, OWNER + LANES * square)
    store(ints, OWNER + LANES * square, select(best > before, splat(np.int32(space)), owner))
    floats[LEAST + square] = smallest(best)


@inlined
def _rasterize_with_holes(view, world, found, leaf, space, x_first, y_first, square, floats, ints):
    """Do what rasterize_triangles() does, and see through holes."""
    x, y = lane_column() + x_first, lane_row() + y_first
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        i = COEFFICIENTS + lane
        inside = vmin(
            vmin(_at(floats, i, x, y), _at(floats, i + 3 * LANES, x, y)),
            _at(floats, i + 6 * LANES, x, y),
        )
        best = load(floats, BEST + LANES * square)
        k = _at(floats, i + 9 * LANES, x, y)
        hit = (inside >= np.float32(0)) & (k < view.key_near) & (k > best)
        if bits(hit) == 0:
            continue
        slot = leaf * WIDTH + lane
        weights = barycentrics(view, world.corner, slot, space, (x_first, y_first), ints)
        vertices = vertices_of(world.faces, world.face[slot] + world.first_primitive[space])
        hit = hit & ~are_holes(world, world.root_object[space], vertices, weights)
        slots, owner = load(ints, SEEN + LANES * square), load(ints, OWNER + LANES * square)
        store(floats, BEST + LANES * square, select(hit, k, best))
        store(ints, SEEN + LANES * square, select(hit, splat(np.int32(slot)), slots))
        store(ints, OWNER + LANES * square, select(hit, splat(np.int32(space)), owner))
    floats[LEAST + square] = smallest(load(floats, BEST + LANES * square))


@inlined
def _at(floats, i, x, y):
    """A triangle's function at 16 pixels."""
    return fma(x, floats[i], fma(y, floats[i + LANES], splat(floats[i + 2 * LANES])))
