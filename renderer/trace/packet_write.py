"""The pixels of a tile: their colours and other channels, written into the image.

Owns what is written of a square, and the stage that does it for a tile (stage.py). Knows nothing of
how the closest objects were found.
"""

from __future__ import annotations

import numpy as np

from renderer.scene.flat import FlatScene
from renderer.trace.compiled import inlined, kernel
from renderer.trace.image import Image
from renderer.trace.instances import World, world_pointers
from renderer.trace.packet_effects import Effects
from renderer.trace.packet_shade import add_reflections, shade_square
from renderer.trace.packet_surface import SHADING, find_surfaces, scene_pointers, square_rays
from renderer.trace.packet_tile import BEST, NOTHING, SEEN, SQUARE, SQUARES, new_tile
from renderer.trace.packet_view import PacketView, view_pointers
from renderer.trace.simd import (
    LANES,
    bits,
    load,
    pointer,
    select,
    splat,
    store,
    store_square,
    store_square3,
)
from renderer.trace.stage import Stage, new_room, prepared


def writing_stage(
    view: PacketView, world: World, scene: FlatScene, effects: Effects | None, image: Image
) -> Stage:
    """The stage that determines a tile's colours, and writes all channels that the image has.

    The arguments' arrays must be kept.
    """
    room = new_room()
    return Stage(prepare_writing(view, world, scene, effects, image, room), room)


@kernel
def prepare_writing(view, world, scene, effects, image, room):
    """Fills the room; gives the address of write_tile's code."""
    always = (
        view_pointers(view),
        world_pointers(world),
        scene_pointers(scene),
        effects,
        image_pointers(image),
    )
    return prepared(write_tile, always, pointer(room))


@inlined
def write_tile(always, row, column, floats, ints):
    """Writes the tile at (row, column), whose pixels' closest objects are in the scratch."""
    view, world, scene, effects, image = always
    tile = new_tile(view, row, column)
    for square in range(SQUARES):
        write_square(view, world, scene, effects, image, row, column, tile, square, floats, ints)


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
