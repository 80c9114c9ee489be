"""A tile: a square of 16 x 16 pixels, whose rays are traced as one packet.

Owns a tile's scratch memory, its side planes in the space of an instance, and their values in a
node's boxes. Knows nothing of triangles.

A packet visits a node of the tree once for all of its 256 rays. Its rays fill a pyramid
(perspective) or a prism (parallel) with four sides; a box entirely outside of one side is missed by
all of them. One vector holds the same plane of a node's 16 boxes, so one test answers for all.

Sources: Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", 2005; Wald, Boulos and
Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", 2007.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.trace.bvh.bvh16 import WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.packets.view import EXTENT, ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS
from renderer.trace.simd.lanes import LANES, fma, splat
from renderer.trace.simd.memory import load, store

TILE = 16  # pixels: side of a packet's square
SQUARE = 4  # pixels: side of the square that a vector holds
SQUARES = (TILE // SQUARE) ** 2

# One thread's scratch, float32: 12 coefficients and 4 bounds of a leaf's 16 triangles; a node's
# children's depths; the least key of each square, and the best key of each pixel; six planes of
# four numbers; a square's secondary rays; t, its rest and the points of a square whose hits were
# found in float64 (refine.py); the tile's picture (write.py); the depths of the nodes
# that wait (to the end).
COEFFICIENTS = 0
BOUNDS = COEFFICIENTS + 12 * LANES
DEPTHS = BOUNDS + 4 * LANES
LEAST = DEPTHS + LANES
BEST = LEAST + SQUARES
PLANES = BEST + SQUARES * LANES
SECONDARY = PLANES + 32
EXACT_T = SECONDARY + 7 * LANES
REST_OF_T = EXACT_T + LANES
EXACT_POINT = REST_OF_T + LANES
PICTURE = EXACT_POINT + 3 * LANES
WAITING_DEPTHS = PICTURE + 7 * TILE * TILE
# And int32: what each pixel sees, a slot, or FIRST_SPHERE - k for sphere k, or nothing; of which
# instance; where each plane finds the coordinates that it needs of a box; the squares that each of
# a leaf's triangles may cover; the footprints of a node's children; the few pixels that a leaf
# covers (sample.py); the triangle whose edges were used last, its slot and its space, and these,
# nine float64 (smooth.py); the picture's numbers; the nodes that wait, each with its footprint (to
# the end).
SEEN = 0
OWNER = SEEN + SQUARES * LANES
FARTHEST = OWNER + SQUARES * LANES
COVERED = FARTHEST + 32
FOOTPRINTS = COVERED + LANES
PIXELS = FOOTPRINTS + LANES
KEPT = PIXELS + LANES
KEPT_EDGES = KEPT + 2
NUMBERS = KEPT + 2 * LANES
WAITING_NODES = NUMBERS + 2 * TILE * TILE
NOTHING, FIRST_SPHERE = np.int32(-1), np.int32(-2)

# The planes: four sides, -Z and Z. Not Python's int, for each of which a function is compiled anew.
LEFT, RIGHT, TOP, BOTTOM, BEHIND, AHEAD = np.arange(6)


class Tile(NamedTuple):
    """The image point of its first pixel, and a rectangle around its pixels' centres."""

    x: np.float32
    y: np.float32
    x_low: np.float32
    x_high: np.float32
    y_low: np.float32
    y_high: np.float32


@inlined
def new_tile(view, row, column):
    """The tile whose first pixel is (row, column)."""
    x = np.float32(column + 0.5 - 0.5 * view.width)
    y = np.float32(row + 0.5 - 0.5 * view.height)
    last, slack = np.float32(TILE - 1), view.slack_px
    return Tile(x, y, x - slack, x + last + slack, y - slack, y + last + slack)


@inlined
def first_point(tile, square):
    """The image point of a square's first pixel."""
    dx, dy = np.float32((square & 3) * SQUARE), np.float32((square >> 2) * SQUARE)
    return tile.x + dx, tile.y + dy


@inlined
def clear_tile(view, row, column, floats, ints):
    """Nothing seen yet. Squares outside of the image count as full, so that they want nothing."""
    for square in range(SQUARES):
        below = row + square // 4 * SQUARE >= view.height
        outside = below or column + square % 4 * SQUARE >= view.width
        key = np.float32(np.inf) if outside else view.key_far
        store(floats, BEST + LANES * square, splat(key))
        store(ints, SEEN + LANES * square, splat(NOTHING))
        floats[LEAST + square] = key
    ints[KEPT] = NOTHING


@inlined
def set_planes(view, space, tile, floats, ints):
    """Sets up the tile's planes in a space: functions of p that are >= 0 inside.

    With X, Y, H and Z as in view.py, the left side is X >= x_low H, and so on.
    """
    at = space * ROWS
    x, y, z = _row(view, at + ROW_X), _row(view, at + ROW_Y), _row(view, at + ROW_Z)
    zero, one = np.float32(0), np.float32(1)
    h = (zero, zero, zero, one) if view.parallel else z
    _set_plane(view, at, LEFT, _side(x, tile.x_low, h, one), floats, ints)
    _set_plane(view, at, RIGHT, _side(x, tile.x_high, h, -one), floats, ints)
    _set_plane(view, at, TOP, _side(y, tile.y_low, h, one), floats, ints)
    _set_plane(view, at, BOTTOM, _side(y, tile.y_high, h, -one), floats, ints)
    _set_plane(view, at, AHEAD, z, floats, ints)
    _set_plane(view, at, BEHIND, _side(z, zero, h, -one), floats, ints)


@inlined
def _row(view, at):
    rows = view.rows
    return rows[at], rows[at + 1], rows[at + 2], rows[at + 3]


@inlined
def _side(row, limit, h, sign):
    """sign (row - limit h)."""
    return (
        sign * (row[0] - limit * h[0]),
        sign * (row[1] - limit * h[1]),
        sign * (row[2] - limit * h[2]),
        sign * (row[3] - limit * h[3]),
    )


@inlined
def _set_plane(view, at, plane, function, floats, ints):
    """Stores n . (p - o) + d as n . p + w, and which corner of a box is farthest along n."""
    extent = view.rows[at + EXTENT]
    w, size = function[3], abs(function[3])
    for axis in range(3):
        n, origin = function[axis], view.rows[at + ORIGIN + axis]
        floats[PLANES + 4 * plane + axis] = n
        ints[FARTHEST + 3 * plane + axis] = (3 + axis if n >= 0 else axis) * WIDTH
        w -= n * origin
        size += abs(n) * (extent + np.float32(2) * abs(origin))
    # Never too small: no box is rejected by rounding.
    floats[PLANES + 4 * plane + 3] = w + np.float32(5e-7) * size


@inlined
def largest_of_plane(box, at, plane, floats, ints):
    """A plane's function at the corner where it is largest, of each of a node's 16 boxes."""
    n, corner = PLANES + 4 * plane, FARTHEST + 3 * plane
    value = fma(load(box, at + ints[corner + 2]), floats[n + 2], splat(floats[n + 3]))
    value = fma(load(box, at + ints[corner + 1]), floats[n + 1], value)
    return fma(load(box, at + ints[corner]), floats[n], value)
