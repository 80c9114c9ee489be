"""A leaf's 16 triangles against the pixels in their own rectangles, with triangles in lanes.

Most triangles of a dense mesh cover the centres of at most two pixels. Each lane steps through the
centres in the rectangle around its own triangle, row by row, so that 16 triangles are tested at
once, each at a different pixel. The functions are evaluated by the same operations as in
by_squares.py, so a pixel's result is the same to the last bit with either method.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    lowest_bit,
    select,
    vabs,
    vfloor,
    vmax,
    vmin,
)
from lucida.renderer.trace.vector.memory import store

from .tile import TILE, keep_hits, nearest_key_of, pixel_points

SMALL_PIXELS = np.float32(16)  # a rectangle with more is not small
ROUND = 2  # pixels that each lane tests before hits are stored
# Margin in pixels around a rectangle, since the triangle's edges are rounded (footprint.py).
_MARGIN_PX = np.float32(1 / 64)
# The tip of a triangle that is relatively thinner might be rounded farther.
_THINNEST = np.float32(2.0**-10)
_NEAREST = np.float32(1e-6)  # H of corners that are divided by it


class PixelBoxes(NamedTuple):
    """The first and last column and row of the tile's pixels whose centres are in the rectangles
    around a leaf's triangles; F32, whole numbers.
    """

    left: Any
    right: Any
    top: Any
    bottom: Any


@emitted
def pixel_boxes(view, tile, pa, pb, pc):
    """Return (PixelBoxes, small, other): masks of triangles that may cover a few pixels, or more.

    pa, pb, pc: the corners (X, Y, H), from the tile's first pixel, as is the tile.
    """
    one, last = np.float32(1), np.float32(TILE - 1)
    is_used = pa[0] == pa[0]

    def divided():
        # Replace three divisions by one.
        (ax, ay, ha), (bx, by, hb), (cx, cy, hc) = pa, pb, pc
        is_ahead = vmin(vmin(ha, hb), hc) > _NEAREST
        ab = ha * hb
        inverse = one / (ab * hc)
        ic, inverse = ab * inverse, hc * inverse
        ia, ib = hb * inverse, ha * inverse
        return is_ahead, ax * ia, ay * ia, bx * ib, by * ib, cx * ic, cy * ic

    is_ahead, ax, ay, bx, by, cx, cy = choose(
        view.parallel, lambda: (is_used, pa[0], pa[1], pb[0], pb[1], pc[0], pc[1]), divided
    )
    left, right = vmin(vmin(ax, bx), cx), vmax(vmax(ax, bx), cx)
    top, bottom = vmin(vmin(ay, by), cy), vmax(vmax(ay, by), cy)
    across, down = right - left, bottom - top
    area = vabs(fma(bx - ax, cy - ay, -((by - ay) * (cx - ax))))
    is_sized = is_ahead & (area > _THINNEST * fma(across, across, down * down))
    # Pixels behind a lens may be this far from the grid.
    boxes = PixelBoxes(
        _first(left - (_MARGIN_PX + (tile.x_high - last))),
        _last(right + (_MARGIN_PX - tile.x_low)),
        _first(top - (_MARGIN_PX + (tile.y_high - last))),
        _last(bottom + (_MARGIN_PX - tile.y_low)),
    )
    columns, rows = boxes.right - boxes.left, boxes.bottom - boxes.top
    holds = vmin(columns, rows) >= np.float32(0)
    has_few = (columns + one) * (rows + one) <= SMALL_PIXELS
    return boxes, is_sized & holds & has_few, is_used & ~(is_sized & (~holds | has_few))


@emitted
def _first(x):
    return -vfloor(-vmax(x, np.float32(0)))


@emitted
def _last(x):
    return vfloor(vmin(x, np.float32(TILE - 1)))


@inlined
def sample_boxes(view, world, triangles, boxes, small, tile, scratch):
    """Sample small triangles at the pixels of their rectangles. tile: from_first_pixel()."""
    zero, one = np.float32(0), np.float32(1)
    (e0, e1, e2), key, leaf = triangles.edges, triangles.key, triangles.leaf
    column, row = boxes.left, boxes.top
    todo, changed = small, np.int64(0)
    while bits(todo) != 0:
        hits = np.int64(0)
        for k in range(ROUND):
            x, y, pixel = pixel_points(view, tile, column, row, todo)
            inside = todo & (fma(x, e0[0], fma(y, e0[1], e0[2])) >= zero)
            inside = inside & (fma(x, e1[0], fma(y, e1[1], e1[2])) >= zero)
            inside = inside & (fma(x, e2[0], fma(y, e2[1], e2[2])) >= zero)
            store(scratch.keys, LANES * k, fma(x, key[0], fma(y, key[1], key[2])))
            store(scratch.pixels, LANES * k, pixel)
            hits |= bits(inside) << (LANES * k)
            column = column + one
            is_after = column > boxes.right
            column = select(is_after, boxes.left, column)
            row = select(is_after, row + one, row)
            todo = todo & (row <= boxes.bottom)
        while hits != 0:
            i = lowest_bit(hits)
            hits &= hits - 1
            pixel, own = np.int64(scratch.pixels[i]), scratch.keys[i]
            slot, best = np.int32(leaf * WIDTH + (i & (LANES - 1))), scratch.best[pixel]
            # The first of equally near triangles wins, as in by_squares.py.
            is_nearer = own > best or (
                own == best and slot < scratch.hit_slot[pixel] <= slot | (LANES - 1)
            )
            if is_nearer and own < nearest_key_of(view, pixel, scratch):
                scratch.best[pixel] = own
                scratch.hit_slot[pixel] = slot
                scratch.hit_instance[pixel] = np.int32(triangles.space)
                changed |= 1 << (pixel >> 4)
    keep_hits(world, leaf, changed, scratch)
