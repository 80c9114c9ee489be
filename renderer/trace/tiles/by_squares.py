"""A leaf's 16 triangles against the tile's squares, each a vector of 16 pixels.

Triangles, and then their squares, are rejected by the largest values of their functions. A
remaining square costs eight multiply-adds for its 16 pixels.

Source: Greene, "Hierarchical Polygon Tiling with Coverage Masks", 1996.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.bvh.instances import HAS_HOLES
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import emitted
from lucida.renderer.trace.compile.stage import call_apart
from lucida.renderer.trace.vector.lanes import (
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
from lucida.renderer.trace.vector.math import store3
from lucida.renderer.trace.vector.memory import load, store

from .smooth import barycentrics, vertices_of
from .texture import are_holes
from .tile import (
    SQUARE,
    TILE,
    coordinates,
    from_first_pixel,
    nearest_key,
    scratch_of,
    set_hits,
    square_points,
)

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


@emitted
def cover_tile(edges, tile):
    """Return the masks of triangles that may cover a pixel of the tile if their volume is positive,
    and if it is negative. tile: from_first_pixel().
    """
    zero = splat(np.float32(0))
    rectangle = tile.x_low, tile.x_high, tile.y_low, tile.y_high
    (low0, high0), (low1, high1), (low2, high2) = (_range(edge, *rectangle) for edge in edges)
    front = (high0 >= zero) & (high1 >= zero) & (high2 >= zero)
    return front, (low0 <= zero) & (low1 <= zero) & (low2 <= zero)


@inlined
def rasterize_squares(view, world, triangles, wanted, tile, squares, least, scratch):
    """Rasterize the triangles in the mask `wanted`. Return the tile's new least key.

    squares, least: as for rasterize_leaf().
    """
    own = from_first_pixel(tile)
    x_low, x_high, y_low, y_high = own.x_low, own.x_high, own.y_low, own.y_high
    wanted = wanted & (_largest(triangles.key, x_low, x_high, y_low, y_high) > least)
    kept = bits(wanted)
    if kept == 0:
        return least
    x_high -= np.float32(TILE - SQUARE)  # of the tile's first square
    y_high -= np.float32(TILE - SQUARE)
    _store_function(triangles.edges[0], _E0, x_low, x_high, y_low, y_high, scratch)
    _store_function(triangles.edges[1], _E1, x_low, x_high, y_low, y_high, scratch)
    _store_function(triangles.edges[2], _E2, x_low, x_high, y_low, y_high, scratch)
    _store_function(triangles.key, _KEY, x_low, x_high, y_low, y_high, scratch)
    covered = _covered_squares(kept, scratch) & squares
    if covered == 0:
        return least
    leaf, space = triangles.leaf, triangles.space
    has_holes = world.attributes[space] & HAS_HOLES != 0
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
            _rasterize_triangles(view, found, leaf, space, own, square, scratch)
    return smallest(load(scratch.least, 0))


@emitted
def _store_function(f, number, x_low, x_high, y_low, y_high, scratch):
    """Store the coefficients of a function, and its largest values in the tile's first square."""
    store3(scratch.coefficients, 3 * LANES * number, f)
    store(scratch.bounds, LANES * number, _largest(f, x_low, x_high, y_low, y_high))


@inlined
def _covered_squares(kept, scratch):
    """Store the squares that each kept triangle may cover. Return the squares of all triangles.

    Squares are in lanes; triangles follow one after the other.
    """
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
def _rasterize_triangles(view, found, leaf, space, tile, square, scratch):
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
    """Same as _rasterize_triangles(), for triangles with holes."""
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
    """Return (mask, key) of the 16 pixels at which one lane's triangle is nearer than `best`."""
    inside = vmin(
        vmin(_at(coefficients, lane, x, y), _at(coefficients, lane + 3 * LANES, x, y)),
        _at(coefficients, lane + 6 * LANES, x, y),
    )
    key = _at(coefficients, lane + 9 * LANES, x, y)
    # Compare with `best` last, because the previous triangle's result takes longest.
    return (inside >= np.float32(0)) & (key < key_near) & (key > best), key


@emitted
def _at(coefficients, i, x, y):
    """Return a triangle's function at 16 pixels."""
    c = coefficients
    return fma(x, c[i], fma(y, c[i + LANES], splat(c[i + 2 * LANES])))
