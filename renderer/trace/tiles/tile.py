"""A tile: a square of 16 x 16 pixels, whose rays are traced as one packet.

A packet visits a node of the tree once for all of its 256 rays. Its rays fill a pyramid
(perspective) or a prism (parallel) with four sides; a box entirely outside one side is missed by
all of them. One vector holds the same plane of a node's 16 boxes, so they are all tested at once.

Sources: Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", 2005; Wald, Boulos and
Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", 2007.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted, f32, f64, i32, i64
from lucida.renderer.trace.vector.gather import gather, prefetch
from lucida.renderer.trace.vector.lanes import (
    LANES,
    fma,
    i32_of,
    lane_column,
    lane_row,
    lowest_bit,
    select,
    smallest,
    splat,
    vfloor,
)
from lucida.renderer.trace.vector.memory import divider, load, shifted, store

from .view import EXTENT, ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS

TILE = 16  # pixels: side of a packet's square
SQUARE = 4  # pixels: side of the square that a vector holds
SQUARES = (TILE // SQUARE) ** 2

_PIXELS = TILE * TILE

# The fields of one thread's scratch memory, and their sizes; the last one is as large as the stack.
_FLOATS = {
    # A leaf's 16 triangles: three edge functions and a key each, and the largest value of each in
    # the tile's first square.
    "coefficients": 12 * LANES,
    "bounds": 4 * LANES,
    "keys": 2 * LANES,  # of triangles at separate pixels (by_boxes.py)
    "depths": LANES,  # of a node's children
    "least": SQUARES,  # the least key of each square
    "best": _PIXELS,  # the best key of each pixel
    "key_near": _PIXELS,  # behind a lens: the bound for keys
    "planes": 32,  # six, of four numbers
    "rows": ROWS,  # of the current space, from the tile's first pixel (view.py)
    # A square's secondary rays.
    "origins": 3 * LANES,
    "directions": 3 * LANES,
    "reach": LANES,
    # t, its rest, and the points of a square whose hits were computed in float64 (refine.py).
    "exact_t": LANES,
    "rest_of_t": LANES,
    "exact_point": 3 * LANES,
    # The tile's picture (write.py).
    "depth": _PIXELS,
    "normal": 3 * _PIXELS,
    "color": 3 * _PIXELS,
    "waiting_depths": 0,  # of the waiting nodes
}
_INTS = {
    "hit_slot": _PIXELS,  # each pixel's hit: a slot, FIRST_SPHERE - k for sphere k, or NOTHING
    "hit_instance": _PIXELS,
    "farthest": 32,  # the columns of a box that each plane needs
    "covered": LANES,  # the squares that each of a leaf's triangles may cover
    "footprints": LANES,  # of a node's children
    "pixels": 2 * LANES,  # those; or the few that a leaf covers (by_pixels.py)
    # The triangle whose edges were used last, its slot and instance; and its edges, nine float64.
    "kept": 2,
    "kept_edges": 2 * LANES - 2,
    # Behind a lens: the frame's number, the padding before the scratch, and the frame's place among
    # the tile's (lens_frame.py).
    "frame": LANES,
    "id": _PIXELS,
    "primitive": _PIXELS,
    "waiting": 0,  # the waiting nodes, each with its footprint
}
FLOATS, INTS = sum(_FLOATS.values()), sum(_INTS.values())  # without the stack
Scratch = namedtuple("Scratch", [*_FLOATS, *_INTS])  # type: ignore[misc]
scratch_of = divider(Scratch, _FLOATS.values(), _INTS.values())

NOTHING, FIRST_SPHERE = np.int32(-1), np.int32(-2)

# The planes: four sides, -Z and Z.
LEFT, RIGHT, TOP, BOTTOM, BEHIND, AHEAD = range(6)


class Tile(NamedTuple):
    """A tile's place: the image point of the first pixel, and a rectangle around the pixels'
    centres; behind a lens also the number of the first pixel in the lens's arrays.

    Behind a lens, the tile's frame is the image (lens.py), and pixels are next to their grid.
    """

    x: np.float32
    y: np.float32
    x_low: np.float32
    x_high: np.float32
    y_low: np.float32
    y_high: np.float32
    first: Any


class Points(NamedTuple):
    """The image points of a square's pixels: (x, y), in float64, and what each lane adds, F32."""

    x: np.float64
    y: np.float64
    right: Any
    down: Any


@emitted
def new_tile(view, row, column, scratch):
    """Return the tile whose first pixel is (row, column)."""
    last, slack, lens = np.float32(TILE - 1), view.slack_px, view.lens
    if lens is None:
        x = f32(column + 0.5 + view.left)
        y = f32(row + 0.5 + view.above)
        return Tile(x, y, x - slack, x + last + slack, y - slack, y + last + slack, 0)
    frame = i64(scratch.frame[0])
    x, y, b = np.float32(0), np.float32(0), 4 * frame
    left, right, above, below = (
        lens.bounds[b],
        lens.bounds[b + 1],
        lens.bounds[b + 2],
        lens.bounds[b + 3],
    )
    return Tile(x, y, left - slack, right + slack, above - slack, below + slack, frame * _PIXELS)


@emitted
def from_first_pixel(tile):
    """Return the tile with its first pixel as the origin of image points.

    These numbers are small, and the edges and keys of triangles keep more of float32's digits.
    """
    zero, x, y = np.float32(0), tile.x, tile.y
    return Tile(
        zero, zero, tile.x_low - x, tile.x_high - x, tile.y_low - y, tile.y_high - y, tile.first
    )


@emitted
def square_points(view, tile, square):
    """Return the image points of a square's pixels."""
    x, y = _first_point(tile, square)
    x, y, lens = f64(x), f64(y), view.lens
    if lens is None:
        return Points(x, y, lane_column(), lane_row())
    at = tile.first + LANES * square
    return Points(x, y, load(lens.right, at), load(lens.down, at))


@emitted
def coordinates(points):
    """Return x and y of image points, F32."""
    return points.right + f32(points.x), points.down + f32(points.y)


@emitted
def pixel_point(view, tile, square, lane):
    """Return the image point of one pixel, equal to that of coordinates()."""
    x, y = _first_point(tile, square)
    lens = view.lens
    if lens is None:
        return x + f32(lane & (SQUARE - 1)), y + f32(lane >> 2)
    at = tile.first + LANES * square + lane
    return x + lens.right[at], y + lens.down[at]


@emitted
def pixel_points(view, tile, column, row, mask):
    """Return (x, y, number in the tile) of a pixel in each lane; x and y as by coordinates().

    column, row: F32, whole numbers. mask: the wanted lanes.
    """
    j, i, two = i32_of(column), i32_of(row), np.int32(2)
    inner, outer = np.int32(SQUARE - 1), np.int32(TILE - SQUARE)
    pixel = ((i & outer) << two) + (j & outer) << two
    pixel = pixel + ((i & inner) << two) + (j & inner)
    lens = view.lens
    if lens is None:
        return column, row, pixel
    right = gather(shifted(lens.right, tile.first), pixel, mask)
    down = gather(shifted(lens.down, tile.first), pixel, mask)
    side, part = np.float32(SQUARE), np.float32(1 / SQUARE)
    return right + vfloor(column * part) * side, down + vfloor(row * part) * side, pixel


@emitted
def _first_point(tile, square):
    """Return the image point of a square's first pixel, on the grid."""
    return tile.x + f32((square & 3) * SQUARE), tile.y + f32((square >> 2) * SQUARE)


@emitted
def clear_tile(view, tile, row, column, scratch):
    """Reset the keys and hits. Mark pixels outside the image as done, so that nothing is nearer.
    Return the tile's least key."""
    scratch.kept[0] = NOTHING
    nothing, lens = np.float32(np.inf), view.lens
    for square in range(SQUARES):
        at = LANES * square
        store(scratch.hit_slot, at, splat(NOTHING))
        if lens is None:
            i, j = row + square // 4 * SQUARE, column + square % 4 * SQUARE
            key = choose(
                (i < view.height) & (j < view.width), lambda: view.key_far, lambda: nothing
            )
            store(scratch.best, at, splat(key))
            scratch.least[square] = key
        else:
            ahead = load(lens.ahead, tile.first + at)
            best = select(ahead > np.float32(0), view.key_far / ahead, nothing)
            store(scratch.best, at, best)
            store(scratch.key_near, at, view.key_near / ahead)
            scratch.least[square] = smallest(best)
    return view.key_far if lens is None else smallest(load(scratch.least, 0))


@emitted
def nearest_key(view, square, scratch):
    """Return the key that a hit must be below, for a square's pixels."""
    if view.lens is None:
        return splat(view.key_near)
    return load(scratch.key_near, LANES * square)


@emitted
def nearest_key_of(view, pixel, scratch):
    """Return nearest_key() for one of the tile's pixels."""
    return view.key_near if view.lens is None else scratch.key_near[pixel]


@emitted
def depth_range(view, square, scratch):
    """Return the bounds between which Z must be, for a square's pixels."""
    if view.lens is None:
        return splat(view.z_near), splat(view.z_far)
    z_near = splat(np.float32(1)) / load(scratch.key_near, LANES * square)
    return z_near, splat(np.float32(np.inf))


@emitted
def own_parameters(view, tile, square, t):
    """Return t in units of the pixels' own directions."""
    lens = view.lens
    if lens is None:
        return t
    ahead = load(lens.ahead, tile.first + LANES * square)
    return select(ahead > np.float32(0), t / ahead, np.float32(np.inf))


@emitted
def set_hits(scratch, square, hit, key, slot, instance):
    """Store a hit, with its key, in a square's pixels of the mask."""
    at = LANES * square
    best = select(hit, key, load(scratch.best, at))
    store(scratch.best, at, best)
    slots, instances = load(scratch.hit_slot, at), load(scratch.hit_instance, at)
    store(scratch.hit_slot, at, select(hit, splat(i32(slot)), slots))
    store(scratch.hit_instance, at, select(hit, splat(i32(instance)), instances))
    scratch.least[square] = smallest(best)


@emitted
def set_space(view, space, tile, scratch):
    """Set up a space for the tile: its planes, and rows from the first pixel."""
    _set_planes(view, space, tile, scratch)
    exact, at = view.rows_exact, space * ROWS
    for i in range(ROWS):
        scratch.rows[i] = view.rows[at + i]
    z = exact[at + ROW_Z], exact[at + ROW_Z + 1], exact[at + ROW_Z + 2], exact[at + ROW_Z + 3]
    h = choose(view.parallel, lambda: (0.0, 0.0, 0.0, 1.0), lambda: z)
    for column in range(4):
        scratch.rows[ROW_X + column] = exact[at + ROW_X + column] - tile.x * h[column]
        scratch.rows[ROW_Y + column] = exact[at + ROW_Y + column] - tile.y * h[column]


@emitted
def _set_planes(view, space, tile, scratch):
    """Set up the tile's planes in a space: functions of p that are >= 0 inside.

    With X, Y, H and Z as in view.py, the left side is X >= x_low H, and so on.
    """
    at = space * ROWS
    x, y, z = _row(view, at + ROW_X), _row(view, at + ROW_Y), _row(view, at + ROW_Z)
    zero, one = np.float32(0), np.float32(1)
    h = choose(view.parallel, lambda: (zero, zero, zero, one), lambda: z)
    _set_plane(view, at, LEFT, _side(x, tile.x_low, h, one), scratch)
    _set_plane(view, at, RIGHT, _side(x, tile.x_high, h, -one), scratch)
    _set_plane(view, at, TOP, _side(y, tile.y_low, h, one), scratch)
    _set_plane(view, at, BOTTOM, _side(y, tile.y_high, h, -one), scratch)
    _set_plane(view, at, AHEAD, z, scratch)
    _set_plane(view, at, BEHIND, _side(z, zero, h, -one), scratch)


@emitted
def _row(view, at):
    rows = view.rows
    return rows[at], rows[at + 1], rows[at + 2], rows[at + 3]


@emitted
def _side(row, limit, h, sign):
    """Return sign (row - limit h)."""
    return (
        sign * (row[0] - limit * h[0]),
        sign * (row[1] - limit * h[1]),
        sign * (row[2] - limit * h[2]),
        sign * (row[3] - limit * h[3]),
    )


@emitted
def _set_plane(view, at, plane, function, scratch):
    """Store n . (p - o) + d as n . p + w, and which corner of a box is farthest along n."""
    extent = view.rows[at + EXTENT]
    w, size = function[3], abs(function[3])
    for axis in range(3):
        n, origin = function[axis], view.rows[at + ORIGIN + axis]
        scratch.planes[4 * plane + axis] = n
        scratch.farthest[3 * plane + axis] = (axis + 3 * i64(n >= 0)) * WIDTH
        w -= n * origin
        size += abs(n) * (extent + np.float32(2) * abs(origin))
    # Round up, so that no box is rejected by rounding.
    scratch.planes[4 * plane + 3] = w + np.float32(5e-7) * size


@emitted
def largest_of_plane(box, at, plane, scratch):
    """Return a plane's largest value in each of a node's 16 boxes."""
    n, corner, planes, farthest = 4 * plane, 3 * plane, scratch.planes, scratch.farthest
    value = fma(load(box, at + farthest[corner + 2]), planes[n + 2], splat(planes[n + 3]))
    value = fma(load(box, at + farthest[corner + 1]), planes[n + 1], value)
    return fma(load(box, at + farthest[corner]), planes[n], value)


@inlined
def keep_hits(world, leaf, changed, scratch):
    """Update the least keys of squares after hits on triangles of a leaf.

    changed: a bit for each square with a new hit.
    """
    if changed != 0:
        # Prefetch the data of a hit that shading will read.
        prefetch(world.face, leaf * WIDTH)
        for line in range(0, 3 * WIDTH, LANES):
            prefetch(world.normal, leaf * 3 * WIDTH + line)
    while changed != 0:
        square = lowest_bit(changed)
        changed &= changed - 1
        scratch.least[square] = smallest(load(scratch.best, LANES * square))
