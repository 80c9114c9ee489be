"""The packet kernel: the picture, tile by tile.

Owns the loop over blocks and tiles, and what is written of a square. Still image order: for each
packet of pixels, find the closest objects; then determine the colours. Knows nothing of threads:
each of a team calls trace_packets() with the same arguments, and they share the blocks.
"""

from __future__ import annotations

import numpy as np

from renderer.trace.atomic import count_done, is_cancelled, take_next
from renderer.trace.compiled import inlined, kernel
from renderer.trace.image import BLOCK, Image
from renderer.trace.instances import world_pointers
from renderer.trace.packet_shade import add_reflections, shade_square
from renderer.trace.packet_surface import SHADING, find_surfaces, scene_pointers, square_rays
from renderer.trace.packet_tile import (
    BEST,
    NOTHING,
    SEEN,
    SQUARE,
    SQUARES,
    TILE,
    WAITING_DEPTHS,
    WAITING_NODES,
    clear_tile,
    new_tile,
)
from renderer.trace.packet_view import view_pointers
from renderer.trace.packet_walk import walk_world
from renderer.trace.simd import (
    LANES,
    bits,
    load,
    pointer,
    select,
    shifted,
    splat,
    store,
    store_square,
    store_square3,
)

_ACROSS = BLOCK // TILE  # tiles of a block, in a row


@kernel
def trace_packets(view, world, scene, effects, image, stack_size, control):
    """Traces blocks of pixels until none are left, or the control array says to stop.

    view: PacketView. world: World. scene: FlatScene. effects: Effects, or None. image: Image,
    written. control: see control.py.
    """
    rows, columns = image.finished.shape
    floats = np.empty(WAITING_DEPTHS + stack_size + 2 * LANES, np.float32)
    ints = np.empty(WAITING_NODES + stack_size + 2 * LANES, np.int32)
    # Vectors within cache lines: what is stored there can be loaded again at once.
    first_float, first_int = -(floats.ctypes.data // 4) % LANES, -(ints.ctypes.data // 4) % LANES
    view, world = view_pointers(view), world_pointers(world)
    scene, pixels = scene_pointers(scene), image_pointers(image)
    while True:
        block = take_next(control)
        if block >= rows * columns:
            return
        # Here, not before: an array lives until its name is last used.
        floats_at = shifted(pointer(floats), first_float)
        ints_at = shifted(pointer(ints), first_int)
        top, left = block // columns * BLOCK, block % columns * BLOCK
        for part in range(_ACROSS * _ACROSS):
            row, column = top + part // _ACROSS * TILE, left + part % _ACROSS * TILE
            if row >= image.height or column >= image.width:
                continue
            if is_cancelled(control):
                return
            # Find the closest objects.
            tile = new_tile(view, row, column)
            clear_tile(view, row, column, floats_at, ints_at)
            if not world.is_empty:
                walk_world(view, world, tile, floats_at, ints_at)
            # Determine the colours.
            for square in range(SQUARES):
                write_square(
                    view,
                    world,
                    scene,
                    effects,
                    pixels,
                    row,
                    column,
                    tile,
                    square,
                    floats_at,
                    ints_at,
                )
        image.finished[block // columns, block % columns] = 1
        count_done(control)


@inlined
def image_pointers(image):
    return Image(
        image.width,
        image.height,
        pointer(image.finished),
        pointer(image.color),
        pointer(image.depth),
        pointer(image.normal),
        pointer(image.id),
        pointer(image.primitive),
        image.has_color,
        image.has_depth,
        image.has_normal,
        image.has_id,
        image.has_primitive,
    )


@inlined
def write_square(view, world, scene, effects, image, row, column, tile, square, floats, ints):
    """Writes the channels that the image has, of one square of the tile at (row, column)."""
    i, j = row + (square >> 2) * SQUARE, column + (square & 3) * SQUARE
    if i >= image.height or j >= image.width:
        return
    first = tile.x + np.float32(j - column), tile.y + np.float32(i - row)
    best, seen = load(floats, BEST + LANES * square), load(ints, SEEN + LANES * square)
    is_hit = seen != NOTHING
    z = -best if view.parallel else splat(np.float32(1)) / best
    t = select(is_hit, z * np.float32(view.scale), np.float32(np.inf))
    if image.has_depth:
        write_one(image, image.depth, i, j, t, floats)
    if not (image.has_color or image.has_normal or image.has_id or image.has_primitive):
        return
    zero = splat(np.float32(0))
    normal = (zero, zero, zero)
    background = scene.background
    color = (splat(background[0]), splat(background[1]), splat(background[2]))
    objects = primitives = splat(np.int32(-1))
    if bits(is_hit) != 0:
        pixels = square_rays(view, first)
        objects, primitives = find_surfaces(
            view,
            world,
            scene,
            first,
            pixels,
            square,
            z,
            image.has_color,
            image.has_primitive,
            floats,
            ints,
        )
        normal = (
            load(floats, SHADING),
            load(floats, SHADING + LANES),
            load(floats, SHADING + 2 * LANES),
        )
        if image.has_color:
            color = shade_square(
                view, world, scene, effects, pixels, first, t, objects, floats, ints
            )
            if effects is not None:
                color = add_reflections(
                    view, world, scene, effects, pixels, square, t, objects, color, floats, ints
                )
    if image.has_id:
        write_one(image, image.id, i, j, objects, ints)
    if image.has_primitive:
        write_one(image, image.primitive, i, j, primitives, ints)
    if image.has_normal:
        write_three(image, image.normal, i, j, normal, floats)
    if image.has_color:
        write_three(image, image.color, i, j, color, floats)


@inlined
def write_one(image, channel, i, j, values, scratch):
    """Stores a square of a channel of one number; at the image's border, what there is of it."""
    height, width = image.height, image.width
    if i + SQUARE <= height and j + SQUARE <= width:
        store_square(channel, i * width + j, width, values)
        return
    store(scratch, 0, values)
    for k in range(LANES):
        row, column = i + k // SQUARE, j + k % SQUARE
        if row < height and column < width:
            channel[row * width + column] = scratch[k]


@inlined
def write_three(image, channel, i, j, values, scratch):
    """The same for a channel of three numbers."""
    height, width = image.height, image.width
    if i + SQUARE <= height and j + SQUARE <= width:
        at = 3 * (i * width + j)
        store_square3(channel, at, 3 * width, values[0], values[1], values[2])
        return
    store(scratch, 0, values[0])
    store(scratch, LANES, values[1])
    store(scratch, 2 * LANES, values[2])
    for k in range(LANES):
        row, column = i + k // SQUARE, j + k % SQUARE
        if row < height and column < width:
            for axis in range(3):
                channel[3 * (row * width + column) + axis] = scratch[axis * LANES + k]
