"""A tile: a square of 16 x 16 pixels, whose rays are traced as one packet.

Owns a tile's scratch memory, its side planes in the space of an instance, and the test of a
node's children against them. Knows nothing of triangles.

A packet visits a node of the tree once for all of its 256 rays. Its rays fill a pyramid
(perspective) or a prism (parallel) with four sides; a box entirely outside of one side is missed by
all of them. One vector holds the same plane of a node's 16 boxes, so one test answers for all.

Sources: Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", 2005; Wald, Boulos and
Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", 2007.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.trace.compiled import inlined
from renderer.trace.packet_view import EXTENT, ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS
from renderer.trace.simd import LANES, fma, load, splat, store
from renderer.trace.wide import WIDTH

TILE = 16  # pixels: side of a packet's square
SQUARE = 4  # pixels: side of the square that a vector holds
SQUARES = (TILE // SQUARE) ** 2

# One thread's scratch, float32: 12 coefficients and 4 bounds of a leaf's 16 triangles; a node's
# children's depths; the least key of each square, and the best key of each pixel; six planes of four numbers;
# a square's surface, for shading; the depths of the nodes that wait (to the end).
COEFFICIENTS = 0
BOUNDS = COEFFICIENTS + 12 * LANES
DEPTHS = BOUNDS + 4 * LANES
LEAST = DEPTHS + LANES
BEST = LEAST + SQUARES
PLANES = BEST + SQUARES * LANES
SURFACE = PLANES + 32
WAITING_DEPTHS = SURFACE + 12 * LANES
# And int32: what each pixel sees, a slot or FIRST_SPHERE - sphere, or nothing; of which instance;
# where each plane finds the coordinates that it needs of a box; the squares that each of a leaf's
# triangles may cover; the nodes that wait (to the end).
SEEN = 0
OWNER = SEEN + SQUARES * LANES
FARTHEST = OWNER + SQUARES * LANES
COVERED = FARTHEST + 32
WAITING_NODES = COVERED + LANES
NOTHING, FIRST_SPHERE = np.int32(-1), np.int32(-2)

# The planes: four sides, -Z and Z. Not Python's int, for each of which a function is compiled anew.
LEFT, RIGHT, TOP, BOTTOM, BEHIND, AHEAD = np.arange(6)


class Tile(NamedTuple):
    """The image point of its first pixel, and the rectangle of all its pixels' centres with slack."""

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
def clear_tile(view, row, column, floats, ints):
    """Nothing seen yet. Squares outside of the image count as full, so that they want nothing."""
    for square in range(SQUARES):
        below = row + square // 4 * SQUARE >= view.height
        outside = below or column + square % 4 * SQUARE >= view.width
        key = np.float32(np.inf) if outside else view.key_far
        store(floats, BEST + LANES * square, splat(key))
        store(ints, SEEN + LANES * square, splat(NOTHING))
        floats[LEAST + square] = key


@inlined
def set_planes(view, space, tile, floats, ints):
    """The tile's planes in a space: functions of p that are >= 0 inside, of which w is loose."""
    at = space * ROWS
    rows = view.rows
    for plane in range(6):
        # The side X >= x_low H, and so on: a combination of the rows.
        if plane == BEHIND or plane == AHEAD:
            row, limit = ROW_Z, np.float32(0)
            sign = np.float32(1) if plane == AHEAD else np.float32(-1)
        else:
            row = ROW_X if plane < TOP else ROW_Y
            if plane == LEFT or plane == RIGHT:
                limit = tile.x_low if plane == LEFT else tile.x_high
            else:
                limit = tile.y_low if plane == TOP else tile.y_high
            sign = np.float32(1) if plane == LEFT or plane == TOP else np.float32(-1)
        w = np.float32(0)
        size = np.float32(0)
        for axis in range(4):
            n = rows[at + row + axis]
            if not view.parallel:
                n -= limit * rows[at + ROW_Z + axis]
            elif axis == 3:
                n -= limit
            n *= sign
            if axis == 3:
                w += n
                size += abs(n)
                break
            floats[PLANES + 4 * plane + axis] = n
            ints[FARTHEST + 3 * plane + axis] = (3 + axis if n >= 0 else axis) * WIDTH
            w -= n * rows[at + ORIGIN + axis]
            size += abs(n) * (rows[at + EXTENT] + np.float32(2) * abs(rows[at + ORIGIN + axis]))
        # Never too small: a box is rejected only if rounding has nothing to do with it.
        floats[PLANES + 4 * plane + 3] = w + np.float32(5e-7) * size


@inlined
def largest_of_plane(box, at, plane, floats, ints):
    """A plane's function at the corner where it is largest, of each of a node's 16 boxes."""
    n, corner = PLANES + 4 * plane, FARTHEST + 3 * plane
    value = fma(load(box, at + ints[corner + 2]), floats[n + 2], splat(floats[n + 3]))
    value = fma(load(box, at + ints[corner + 1]), floats[n + 1], value)
    return fma(load(box, at + ints[corner]), floats[n], value)


@inlined
def children_in_tile(view, box, node, z_far, floats, ints):
    """(mask, depths): children of a node that reach into the tile, nearer than z_far.

    A depth is the least Z in the child's box, or a little less.
    """
    at = node * (6 * WIDTH)
    depth = -largest_of_plane(box, at, BEHIND, floats, ints)
    inside = depth < z_far
    inside = inside & (largest_of_plane(box, at, LEFT, floats, ints) >= np.float32(0))
    inside = inside & (largest_of_plane(box, at, RIGHT, floats, ints) >= np.float32(0))
    inside = inside & (largest_of_plane(box, at, TOP, floats, ints) >= np.float32(0))
    inside = inside & (largest_of_plane(box, at, BOTTOM, floats, ints) >= np.float32(0))
    if view.parallel or view.z_near > np.float32(0):
        # In perspective, the sides leave nothing behind the eye.
        ahead = largest_of_plane(box, at, AHEAD, floats, ints)
        inside = inside & (ahead >= view.z_near)
    return inside, depth
