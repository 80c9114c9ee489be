"""A tile's frame behind a lens, in kernels: the tile's pinhole camera (lens_table.py).

A thread's memory holds the numbers of its tile's frame before the scratch: those of the rays, and
the rows of each space that the tile's rays have entered. They allow a tile behind a lens to be
traced like any other. Without a lens, all of this compiles to nothing.
"""

from __future__ import annotations

from lucida.renderer.trace.compile.emit import emitted, f32, i64, with_fields
from lucida.renderer.trace.vector.memory import as_float64, shifted

from .view import EXTENT, ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS

_RAY = 32  # float32 slots for twelve float64, in whole cache lines


@emitted
def room_before_scratch(lens, spaces):
    """Return the number of float32 that a thread needs for its tile's frame."""
    return 0 if lens is None else _RAY + 3 * ROWS * spaces


@emitted
def frames_of(lens, number):
    """Return the first frame of a tile, and the one after its last."""
    if lens is None:
        return 0, 1
    return i64(lens.first[number]), i64(lens.first[number + 1])


@emitted
def set_frame(camera, frame, first, room, scratch):
    """Select a tile's frame, and compute the numbers of its rays."""
    if camera.lens is None:
        return
    scratch.frame[0], scratch.frame[1], scratch.frame[2] = frame, room, frame - first
    ray, back, pinhole = _ray_of_tile(room, scratch), camera.lens.back, camera.ray
    for axis in range(3):
        # The pinhole's direction is z + x * across + y * down.
        z, x, y = pinhole[axis], pinhole[3 + axis], pinhole[6 + axis]
        for column in range(3):
            at = 9 * frame + column
            turned = x * back[at] + y * back[at + 3] + z * back[at + 6]
            ray[3 * (column + 1 if column < 2 else 0) + axis] = turned
        ray[9 + axis] = pinhole[9 + axis]


@emitted
def _ray_of_tile(room, scratch):
    """Return the pointer to the numbers of the tile's rays."""
    return as_float64(shifted(scratch.coefficients, -room))


@emitted
def tile_view(view, scratch):
    """Return the view of the tile whose frame was set last: the frame's pinhole camera."""
    lens = view.lens
    if lens is None:
        return view
    room = i64(scratch.frame[1])
    return with_fields(
        view,
        z_near=view.z_near * lens.least_ahead[scratch.frame[0]],
        rows=shifted(scratch.coefficients, -((room - _RAY) // 3)),
        rows_exact=as_float64(shifted(scratch.coefficients, _RAY - room)),
        ray=_ray_of_tile(room, scratch),
    )


@emitted
def turn_rows(view, space, scratch):
    """Compute the rows of a space in the tile's frame."""
    lens = view.lens
    if lens is None:
        return
    r, first = space * ROWS, 9 * i64(scratch.frame[0])
    turn, pinhole = lens.turn, view.pinhole_rows
    for column in range(4):
        x = pinhole[r + ROW_X + column]
        y = pinhole[r + ROW_Y + column]
        z = pinhole[r + ROW_Z + column]
        for row in range(3):
            m = first + 3 * row
            turned = turn[m] * x + turn[m + 1] * y + turn[m + 2] * z
            _set_row(view, r + ROW_X + 4 * row + column, turned)
    for at in range(ORIGIN, ROW_X):
        _set_row(view, r + at, pinhole[r + at])
    _set_row(view, r + EXTENT, pinhole[r + EXTENT])


@emitted
def _set_row(view, at, value):
    view.rows_exact[at] = value
    view.rows[at] = f32(value)


@emitted
def is_later_frame(lens, scratch):
    """Return True if an earlier frame of the tile has written its pixels."""
    return False if lens is None else scratch.frame[2] > 0


@emitted
def is_own_pixel(lens, tile, row, column):
    """Return True if the pixel in this row and column of the tile belongs to its frame."""
    if lens is None:
        return True
    square, lane = (row & ~3) + (column >> 2), ((row & 3) << 2) + (column & 3)
    return lens.ahead[tile.first + 16 * square + lane] > 0
