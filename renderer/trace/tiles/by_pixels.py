"""A leaf's 16 triangles against single pixels, for leaves whose boxes hold few pixels' centres.

If triangles are smaller than pixels, nearly all of a leaf's triangles cover none. Finding the
triangle that covers each of a few pixels then takes far less than finding the pixels that each
triangle covers. At some thirty triangles per pixel, two of three leaves are finished here, before
their keys are set up. The functions are evaluated by the same operations as in by_squares.py, so a
pixel's result is the same to the last bit with either method.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import emitted
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    fma,
    lowest_bit,
    mask_of,
    select,
    smallest,
)
from lucida.renderer.trace.vector.memory import load

from .footprint import open_pixels
from .tile import keep_hits, nearest_key_of, pixel_point

FEW_PIXELS = 8


@emitted
def _value(f, x, y):
    """Return an affine function of 16 triangles at a pixel."""
    return fma(f[0], x, fma(f[1], y, f[2]))


@inlined
def cover_pixels(view, edges, tile, footprint, squares, depth, scratch):
    """Return (mask, mask, count): the triangles that cover a pixel of the footprint if their volume
    is positive, and if it is negative; and the number of covered pixels, stored in scratch.pixels.

    squares, depth: as for rasterize_leaf(). Pixels with a nearer hit are skipped.
    """
    zero = np.float32(0)
    front = back = mask_of(0)
    count = 0
    while squares != 0:
        square = lowest_bit(squares)
        squares &= squares - 1
        pixels = open_pixels(view, footprint, square, depth, scratch)
        while pixels != 0:
            lane = lowest_bit(pixels)
            pixels &= pixels - 1
            x, y = pixel_point(view, tile, square, lane)
            f0, f1, f2 = _value(edges[0], x, y), _value(edges[1], x, y), _value(edges[2], x, y)
            in_front = (f0 >= zero) & (f1 >= zero) & (f2 >= zero)
            in_back = (f0 <= zero) & (f1 <= zero) & (f2 <= zero)
            if bits(in_front | in_back) == 0:
                continue
            front, back = front | in_front, back | in_back
            scratch.pixels[count] = np.int32(LANES * square + lane)
            count += 1
    return front, back, count


@inlined
def sample_pixels(view, world, triangles, tile, count, least, scratch):
    """Sample a leaf's triangles at the stored pixels. Return the tile's new least key."""
    zero, (e0, e1, e2), leaf = np.float32(0), triangles.edges, triangles.leaf
    changed = np.int64(0)
    for k in range(count):
        pixel = np.int64(scratch.pixels[k])
        square, lane = pixel >> 4, pixel & 15
        x, y = pixel_point(view, tile, square, lane)
        inside = (_value(e0, x, y) >= zero) & (_value(e1, x, y) >= zero)
        inside = inside & (_value(e2, x, y) >= zero)
        own = _value(triangles.key, x, y)
        hit = inside & (own > scratch.best[pixel]) & (own < nearest_key_of(view, pixel, scratch))
        if bits(hit) == 0:
            continue
        own = select(hit, own, np.float32(-np.inf))
        largest = -smallest(-own)
        scratch.best[pixel] = largest
        scratch.hit_slot[pixel] = np.int32(leaf * WIDTH + lowest_bit(bits(own == largest)))
        scratch.hit_instance[pixel] = np.int32(triangles.space)
        changed |= 1 << square
    if changed == 0:
        return least
    keep_hits(world, leaf, changed, scratch)
    return smallest(load(scratch.least, 0))
