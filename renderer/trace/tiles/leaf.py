"""A leaf's 16 triangles against a tile's 256 pixels.

A triangle is three edge functions and a key (triangle.py), which are affine in the image. They are
set up once, with 16 triangles in lanes; keys only where a triangle may cover a pixel. Whole tiles
and squares are rejected by the functions' largest values in them; and what is left costs eight
multiply-adds for 16 pixels. Small triangles are tested at the pixels in their own rectangles
(small.py); and of a leaf on few pixels, each pixel is asked for its triangles (sample.py).

Source: Greene, "Hierarchical Polygon Tiling with Coverage Masks", 1996 (squares).
"""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import WIDTH
from renderer.trace.bvh.instances import HAS_HOLES
from renderer.trace.compile.compiled import inlined
from renderer.trace.compile.emit import emitted
from renderer.trace.compile.stage import call_apart
from renderer.trace.reference.vectors import times
from renderer.trace.tiles.footprint import pixels_of
from renderer.trace.tiles.sample import FEW_PIXELS, cover_pixels, sample_pixels
from renderer.trace.tiles.small import PixelBoxes, pixel_boxes, sample_boxes
from renderer.trace.tiles.smooth import barycentrics, vertices_of
from renderer.trace.tiles.texture import are_holes
from renderer.trace.tiles.tile import (
    SQUARE,
    TILE,
    coordinates,
    from_first_pixel,
    nearest_key,
    scratch_of,
    set_hits,
    square_points,
)
from renderer.trace.tiles.triangle import camera_corners, edge_function, homogeneous, triangle_keys
from renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    lane_column,
    lane_row,
    lowest_bit,
    mask_of,
    select,
    smallest,
    splat,
    vmax,
    vmin,
)
from renderer.trace.vector.math import store3
from renderer.trace.vector.memory import load, store

# Of a footprint: on more, most of a leaf's triangles are not small.
SOME_PIXELS = 160

_E0, _E1, _E2, _KEY = range(4)  # a triangle's functions, in the order of their coefficients


@emitted
def _largest(f, x_low, x_high, y_low, y_high):
    """Return the largest value of an affine function over a rectangle."""
    return vmax(f[0] * x_low, f[0] * x_high) + vmax(f[1] * y_low, f[1] * y_high) + f[2]


@emitted
def _range(f, x_low, x_high, y_low, y_high):
    """Return the least and the largest value of an affine function over a rectangle."""
    left, right, top, bottom = f[0] * x_low, f[0] * x_high, f[1] * y_low, f[1] * y_high
    return (
        vmin(left, right) + vmin(top, bottom) + f[2],
        vmax(left, right) + vmax(top, bottom) + f[2],
    )


@inlined
def rasterize_leaf(view, world, leaf, space, tile, footprint, squares_open, depth, least, scratch):
    """Rasterize a leaf's triangles into the tile. Return the tile's new least key.

    footprint: of the leaf's box; depth: the least Z in it. squares_open: those of the footprint's
    squares, bits, in which some pixel sees nothing nearer. least: the smallest of the pixels' best
    keys: nothing farther can be seen by any.
    """
    # Set up the edges' functions of 16 triangles; they still lack the sign of the volume.
    corner, own = world.corner, from_first_pixel(tile)
    a, b, c = camera_corners(view, corner, leaf, space, tile, scratch)
    ha, hb, hc = homogeneous(view, a, b, c)
    pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    edges = edge_function(pa, pb), edge_function(pb, pc), edge_function(pc, pa)

    # Which may cover a pixel, if their volume is positive, and if it is negative?
    pixels = pixels_of(footprint)
    has_holes = world.attributes[space] & HAS_HOLES != 0
    has_few = pixels <= FEW_PIXELS and not has_holes
    x_low, x_high, y_low, y_high = own.x_low, own.x_high, own.y_low, own.y_high
    zero = splat(np.float32(0))
    front = back = small = mask_of(0)
    boxes, others, count = PixelBoxes(zero, zero, zero, zero), a[0] == a[0], 0
    if has_few:
        front, back, count = cover_pixels(view, edges, own, footprint, squares_open, depth, scratch)
    else:
        if pixels <= SOME_PIXELS and not has_holes:
            boxes, small, others = pixel_boxes(view, own, pa, pb, pc)
        if bits(others) != 0:
            low0, high0 = _range(edges[0], x_low, x_high, y_low, y_high)
            low1, high1 = _range(edges[1], x_low, x_high, y_low, y_high)
            low2, high2 = _range(edges[2], x_low, x_high, y_low, y_high)
            front = others & (high0 >= zero) & (high1 >= zero) & (high2 >= zero)
            back = others & (low0 <= zero) & (low1 <= zero) & (low2 <= zero)
    may = front | back | small
    if bits(may) == 0:
        return least
    key, sign = triangle_keys(view, corner, leaf, space, tile, a, b, c, ha, hb, hc, may)
    e0, e1, e2 = times(sign, edges[0]), times(sign, edges[1]), times(sign, edges[2])
    if has_few:
        return sample_pixels(view, world, e0, e1, e2, key, leaf, space, own, count, least, scratch)
    if bits(small) != 0:
        sample_boxes(view, world, boxes, small, e0, e1, e2, key, leaf, space, own, scratch)
        least = smallest(load(scratch.least, 0))

    # Keep those that may cover a pixel of the tile, nearer than what it sees.
    is_front = sign > np.float32(0)
    may = (front & is_front) | (back & ~is_front)
    if bits(may) == 0:
        return least
    may = may & (_largest(key, x_low, x_high, y_low, y_high) > least)
    kept = bits(may)
    if kept == 0:
        return least
    store3(scratch.coefficients, 0, e0)
    store3(scratch.coefficients, 3 * LANES, e1)
    store3(scratch.coefficients, 6 * LANES, e2)
    store3(scratch.coefficients, 9 * LANES, key)

    # The largest values in the tile's first square.
    x_high -= np.float32(TILE - SQUARE)
    y_high -= np.float32(TILE - SQUARE)
    bound0 = _largest(e0, x_low, x_high, y_low, y_high)
    bound1 = _largest(e1, x_low, x_high, y_low, y_high)
    bound2 = _largest(e2, x_low, x_high, y_low, y_high)
    bound3 = _largest(key, x_low, x_high, y_low, y_high)

    # The same question for each square, with squares in lanes, one triangle after the other.
    store(scratch.bounds, 0, bound0)
    store(scratch.bounds, LANES, bound1)
    store(scratch.bounds, 2 * LANES, bound2)
    store(scratch.bounds, 3 * LANES, bound3)
    covered = _covered_squares(kept, scratch) & squares_open
    if covered == 0:
        return least

    squares_of = load(scratch.covered, 0)
    while covered != 0:
        square = lowest_bit(covered)
        covered &= covered - 1
        found = bits((squares_of & np.int32(1 << square)) != np.int32(0))
        if has_holes:
            _call_with_holes(
                world.uv,
                (
                    view, world, np.int64(found), leaf, space, tile, square,
                    scratch.coefficients, scratch.hit_slot,
                ),
            )  # fmt: skip
        else:
            rasterize_triangles(view, found, leaf, space, own, square, scratch)
    return smallest(load(scratch.least, 0))


@inlined
def _covered_squares(kept, scratch):
    """Write COVERED, the squares of each kept triangle. Return those of any."""
    nearest = load(scratch.least, 0)
    store(scratch.covered, 0, splat(np.int32(0)))
    covered = 0
    left = kept
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        may = _bound(scratch, lane, _E0) >= np.float32(0)
        may = may & (_bound(scratch, lane, _E1) >= np.float32(0))
        may = may & (_bound(scratch, lane, _E2) >= np.float32(0))
        may = may & (_bound(scratch, lane, _KEY) > nearest)
        squares = bits(may)
        scratch.covered[lane] = squares
        covered |= squares
    return covered


@emitted
def _bound(scratch, lane, function):
    """Return the largest value of a triangle's function in each square, shifted from the first."""
    coefficients, i = scratch.coefficients, 3 * LANES * function + lane
    bound = splat(scratch.bounds[LANES * function + lane])
    side = np.float32(SQUARE)
    below = fma(lane_row() * side, coefficients[i + LANES], bound)
    return fma(lane_column() * side, coefficients[i], below)


@inlined
def rasterize_triangles(view, found, leaf, space, tile, square, scratch):
    """Rasterize the triangles in `found`, bits of the leaf's lanes, into a square's 16 pixels.

    tile: from_first_pixel().
    """
    x, y = coordinates(square_points(view, tile, square))
    key_near = nearest_key(view, square, scratch)
    best = load(scratch.best, LANES * square)
    slot = load(scratch.hit_slot, LANES * square)
    before = best
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        hit, key = _nearer(key_near, scratch.coefficients, lane, x, y, best)
        best = select(hit, key, best)
        slot = select(hit, splat(np.int32(leaf * WIDTH + lane)), slot)
    store(scratch.best, LANES * square, best)
    store(scratch.hit_slot, LANES * square, slot)
    owner = load(scratch.hit_instance, LANES * square)
    owner = select(best > before, splat(np.int32(space)), owner)
    store(scratch.hit_instance, LANES * square, owner)
    scratch.least[square] = smallest(best)


@inlined
def _call_with_holes(uv, arguments):
    if uv is None:  # in kernels without textures
        return
    call_apart(_rasterize_with_holes, arguments)


@inlined
def _rasterize_with_holes(view, world, found, leaf, space, tile, square, floats, ints):
    """Do the same for triangles that have holes."""
    scratch = scratch_of(floats, ints)
    points = square_points(view, tile, square)
    x, y = coordinates(square_points(view, from_first_pixel(tile), square))
    key_near = nearest_key(view, square, scratch)
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        best = load(scratch.best, LANES * square)
        hit, key = _nearer(key_near, scratch.coefficients, lane, x, y, best)
        if bits(hit) == 0:
            continue
        slot = leaf * WIDTH + lane
        weights = barycentrics(view, world.corner, slot, space, points, scratch)
        vertices = vertices_of(world.faces, world.face[slot] + world.first_primitive[space])
        hit = hit & ~are_holes(world, world.root_object[space], vertices, weights)
        set_hits(scratch, square, hit, key, slot, space)


@emitted
def _nearer(key_near, coefficients, lane, x, y, best):
    """Return (mask, key) of the 16 pixels: where one lane's triangle is nearer than `best`."""
    inside = vmin(
        vmin(_at(coefficients, lane, x, y), _at(coefficients, lane + 3 * LANES, x, y)),
        _at(coefficients, lane + 6 * LANES, x, y),
    )
    key = _at(coefficients, lane + 9 * LANES, x, y)
    # `best` last: it is the previous triangle's result, which takes longest.
    return (inside >= np.float32(0)) & (key < key_near) & (key > best), key


@emitted
def _at(coefficients, i, x, y):
    """Return a triangle's function at 16 pixels."""
    c = coefficients
    return fma(x, c[i], fma(y, c[i + LANES], splat(c[i + 2 * LANES])))
