"""The footprints of a node's children in a tile: the pixel centres, and the squares, in their
boxes.

A node's children are tested against a tile. Each has a footprint, an int32. The child is dropped as
soon as all pixels of the footprint's squares see something nearer.

A tile's side planes are functions that grow, from one pixel to the next, by a point's homogeneous
coordinate H. Their largest values in a box show whether the box reaches into the tile. Divided by
the box's least H, they are upper bounds, in pixels, of its distance from the tile's sides. Pixels
are points, so surfaces between the centres are invisible.

A single depth for a large packet of rays is useless as a bound once one of its rays escapes. A box
is therefore compared with the depths at its own pixels, as in Greene's hierarchical depth buffer.

Sources: Greene, Kass and Miller, "Hierarchical Z-buffer visibility", 1993; Fuetterling, Lojewski,
Pfreundt and Ebert, "Efficient Ray Tracing Kernels for Modern CPU Architectures", JCGT 4(4), 2015
(large packets, only a part of which is tested against lower nodes).
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.compile.emit import choose, emitted, greater, i64, lesser
from lucida.renderer.trace.vector.lanes import LANES, bits, fma, i32_of, splat, vmax, vmin
from lucida.renderer.trace.vector.memory import load

from .tile import AHEAD, BEHIND, BOTTOM, LEFT, RIGHT, TILE, TOP, largest_of_plane

# A footprint: bits 0 to 15 are the tile's squares. The first and last column and the first and last
# row of its pixels in the tile follow, with four bits each.
WHOLE_TILE = np.int32(0xF0F0FFFF - (1 << 32))
ANY_DEPTH = np.float32(-3e38)  # nearer than everything; finite, for products with it
# Margin in pixels around a box, since triangle edges are rounded (by at most 1/300, view.py).
_MARGIN_PX = np.float32(1 / 64)
# Relative slack of a depth. Keys are wrong by a few units in float32's last place (triangle.py,
# DOUBTFUL), so a surface that seems this much farther may be nearer.
_ROUNDING = np.float32(1 + 2.0**-17)
_LAST = np.float32(TILE - 1)
# Larger children, in pixels, cover most of the tile, so their footprints exclude little.
_SMALL_PX = np.float32(20)


@emitted
def footprints(view, depth, left, right, top, bottom):
    """Return (footprints I32, mask of those that hold a pixel's centre) of a node's children.

    depth: the least Z in each box, or less. left ...: the largest values of the tile's planes.
    """
    one = splat(np.float32(1))
    # A box behind or around the eye may be visible anywhere.
    per_h = choose(view.parallel, lambda: one, lambda: one / vmax(depth, np.float32(1e-30)))
    first_column = np.int32(TILE - 1) - _pixels(right, per_h)
    last_column = _pixels(left, per_h)
    first_row = np.int32(TILE - 1) - _pixels(bottom, per_h)
    last_row = _pixels(top, per_h)
    holds = (first_column <= last_column) & (first_row <= last_row)
    # Bits first to last are 2^(last + 1) - 2^first. Multiply a bit for each row by a row's bits.
    four, two = np.int32(4), np.int32(2)
    columns = (splat(two) << (last_column >> two)) - (splat(np.int32(1)) << (first_column >> two))
    low, high = first_row & np.int32(12), last_row & np.int32(12)
    rows = ((splat(np.int32(16)) << high) - (splat(np.int32(1)) << low)) & np.int32(0x1111)
    pixels = first_column | (last_column << four)
    pixels = pixels | (first_row << (two * four)) | (last_row << np.int32(12))
    return (rows * columns) | (pixels << np.int32(16)), holds


@emitted
def _pixels(reach, per_h):
    """Return the number of pixel centres after a side's first one; at most a tile's."""
    return i32_of(vmax(vmin(fma(reach, per_h, _MARGIN_PX), _LAST), np.float32(0)))


@emitted
def open_squares(view, footprint, depth, scratch):
    """Return the bits of a footprint's squares in which a pixel sees nothing nearer than depth."""
    return i64(footprint) & bits(_is_open(view, load(scratch.least, 0), depth))


@emitted
def open_pixels(view, footprint, square, depth, scratch):
    """Return the bits of a footprint's pixels in a square that see nothing nearer than depth."""
    pixels = i64(footprint) >> 16
    x, y = (square & 3) * 4, (square >> 2) * 4
    first_column, last_column = greater((pixels & 15) - x, 0), lesser((pixels >> 4 & 15) - x, 3)
    first_row, last_row = greater((pixels >> 8 & 15) - y, 0), lesser((pixels >> 12 & 15) - y, 3)
    columns = (2 << last_column) - (1 << first_column)
    rows = ((16 << 4 * last_row) - (1 << 4 * first_row)) & 0x1111
    best = load(scratch.best, LANES * square)
    return rows * columns & bits(_is_open(view, best, depth))


@emitted
def pixels_of(footprint):
    """Return the number of pixels in a footprint."""
    pixels = i64(footprint) >> 16
    across = (pixels >> 4 & 15) - (pixels & 15) + 1
    return across * ((pixels >> 12 & 15) - (pixels >> 8 & 15) + 1)


@emitted
def _is_open(view, key, depth):
    """Return True if something at `depth` may be nearer than a hit with the key."""
    return choose(view.parallel, lambda: key <= -depth, lambda: key * depth < _ROUNDING)


@emitted
def children_in_tile(view, box, node, z_far, scratch):
    """Return (mask, depths, footprints, flag) of children that may be visible, nearer than z_far.

    A depth is the least Z in the child's box, or a little less. The flag is True if there are
    footprints. If all children are large, footprints exclude nothing, and are the whole tile.
    """
    at = node * (6 * WIDTH)
    depth = -largest_of_plane(box, at, BEHIND, scratch)
    left = largest_of_plane(box, at, LEFT, scratch)
    right = largest_of_plane(box, at, RIGHT, scratch)
    top = largest_of_plane(box, at, TOP, scratch)
    bottom = largest_of_plane(box, at, BOTTOM, scratch)
    inside = (depth < z_far) & (vmin(vmin(left, right), vmin(top, bottom)) >= np.float32(0))
    # In perspective, the sides exclude everything behind the eye.
    inside = choose(
        view.parallel | (view.z_near > np.float32(0)),
        lambda: inside & (largest_of_plane(box, at, AHEAD, scratch) >= view.z_near),
        lambda: inside,
    )
    h = choose(view.parallel, lambda: splat(np.float32(1)), lambda: depth)
    wide = h * (_LAST + _SMALL_PX)
    is_small = inside & (left + right <= wide) & (top + bottom <= wide)
    has_small = bits(is_small) != 0

    def smaller():
        footprint, holds = footprints(view, depth, left, right, top, bottom)
        return inside & holds, footprint

    inside, footprint = choose(has_small, smaller, lambda: (inside, splat(WHOLE_TILE)))
    return inside, depth, footprint, has_small
