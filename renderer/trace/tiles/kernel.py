"""The packet kernel, which traces the image tile by tile.

It is still image order: for each packet of pixels, find the closest objects, then determine the
colours, by a stage that is compiled separately (write.py). Each thread of a team calls
trace_packets() with the same arguments; they share the blocks.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.arguments.image import BLOCK
from lucida.renderer.trace.compile.compiled import kernel
from lucida.renderer.trace.compile.stage import call_stage
from lucida.renderer.trace.threads.atomic import count_done, is_cancelled, take_next
from lucida.renderer.trace.vector.lanes import LANES
from lucida.renderer.trace.vector.memory import pointer, pointers, shifted

from .lens_frame import frames_of, room_before_scratch, set_frame, tile_view
from .tile import FLOATS, INTS, TILE, clear_tile, new_tile, scratch_of
from .view import ROWS
from .walk import walk_world

_ACROSS = BLOCK // TILE  # tiles of a block, in a row


@kernel
def trace_packets(camera, world, writing, finished, stack_size, control):
    """Trace blocks of pixels until none are left, or the control array requests a stop.

    camera: PacketView. world: World. writing: the stage that writes a tile. finished: as in Image.
    control: see thread_pool.py.
    """
    rows, columns = finished.shape
    room = room_before_scratch(camera.lens, camera.rows.size // ROWS)
    floats = np.empty(room + FLOATS + stack_size + 2 * LANES, np.float32)
    ints = np.empty(INTS + 2 * stack_size + 2 * LANES, np.int32)
    # Keep vectors within cache lines, where a stored vector can be loaded again at once.
    first_float, first_int = -(floats.ctypes.data // 4) % LANES, -(ints.ctypes.data // 4) % LANES
    camera, world = pointers(camera), pointers(world)
    while True:
        block = take_next(control)
        if block >= rows * columns:
            return
        # Take the pointers here, because numba frees an array after its name's last use.
        floats_at = shifted(pointer(floats), first_float + room)
        ints_at = shifted(pointer(ints), first_int)
        scratch = scratch_of(floats_at, ints_at)
        top, left = block // columns * BLOCK, block % columns * BLOCK
        for part in range(_ACROSS * _ACROSS):
            row, column = top + part // _ACROSS * TILE, left + part % _ACROSS * TILE
            if row >= camera.height or column >= camera.width:
                continue
            if is_cancelled(control):
                return
            number = row // TILE * (-(-camera.width // TILE)) + column // TILE
            first, end = frames_of(camera.lens, number)
            for frame in range(first, end):
                # Find the closest objects.
                set_frame(camera, frame, first, room, scratch)
                view = tile_view(camera, scratch)
                tile = new_tile(view, row, column, scratch)
                least = clear_tile(view, tile, row, column, scratch)
                if not world.is_empty and least < np.float32(np.inf):
                    walk_world(view, world, tile, least, scratch)
                # Determine the colours.
                call_stage(writing.code, pointer(writing.room), row, column, floats_at, ints_at)
        finished[block // columns, block % columns] = 1
        count_done(control)
