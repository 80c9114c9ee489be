"""The pixels of a tile: their colours and other channels, written into the image.

Owns what is written of a tile, and the stage that does it (stage.py). Knows nothing of how the
closest objects were found.

A tile's picture is completed in the scratch, square by square. Then it goes to the image, which may
be far away, in whole lines of the cache and past it: a line that is written in parts is first read.
"""

from __future__ import annotations

import numpy as np

from renderer.scene.flat import FlatScene
from renderer.trace.arguments.image import Image
from renderer.trace.bvh.instances import World, world_pointers
from renderer.trace.compile.compiled import inlined, kernel
from renderer.trace.compile.stage import StagedCode, new_room, prepared
from renderer.trace.packets.effects import Effects
from renderer.trace.packets.refine import packet_depths, refine_square
from renderer.trace.packets.shade import add_reflections, shade_square
from renderer.trace.packets.surface import (
    find_surfaces,
    load3,
    points_on,
    scene_pointers,
    square_rays,
)
from renderer.trace.packets.texture import textures_of
from renderer.trace.packets.tile import (
    EXACT_POINT,
    EXACT_T,
    NOTHING,
    NUMBERS,
    PICTURE,
    SEEN,
    SQUARE,
    SQUARES,
    TILE,
    first_point,
    new_tile,
)
from renderer.trace.packets.view import PacketView, view_pointers
from renderer.trace.simd.lanes import LANES, bits, select, splat
from renderer.trace.simd.memory import is_line, load, pointer, store_square, store_square3, stream

# A tile's picture in the scratch, channel by channel and row by row.
_PIXELS = TILE * TILE
DEPTH, NORMAL, COLOR = PICTURE, PICTURE + _PIXELS, PICTURE + 4 * _PIXELS
ID, PRIMITIVE = NUMBERS, NUMBERS + _PIXELS


def writing_stage(
    view: PacketView, world: World, scene: FlatScene, effects: Effects | None, image: Image
) -> StagedCode:
    """The stage that determines a tile's colours, and writes all channels that the image has.

    The arguments' arrays must be kept.
    """
    room = new_room()
    return StagedCode(
        prepare_writing(view, world, scene, textures_of(scene), effects, image, room), room
    )


@kernel
def prepare_writing(view, world, scene, textures, effects, image, room):
    """Fill the room. Return the address of write_tile's code."""
    always = (
        view_pointers(view),
        world_pointers(world),
        scene_pointers(scene, textures),
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
        draw_square(view, world, scene, effects, image, row, column, tile, square, floats, ints)
    if image.has_depth:
        write_rows(image, image.depth, 1, row, column, floats, DEPTH)
    if image.has_normal:
        write_rows(image, image.normal, 3, row, column, floats, NORMAL)
    if image.has_color:
        write_rows(image, image.color, 3, row, column, floats, COLOR)
    if image.has_id:
        write_rows(image, image.id, 1, row, column, ints, ID)
    if image.has_primitive:
        write_rows(image, image.primitive, 1, row, column, ints, PRIMITIVE)


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
def draw_square(view, world, scene, effects, image, row, column, tile, square, floats, ints):
    """Draws one square of the tile at (row, column) into the tile's picture."""
    at = (square >> 2) * SQUARE * TILE + (square & 3) * SQUARE  # its first pixel there
    i, j = row + (square >> 2) * SQUARE, column + (square & 3) * SQUARE
    if i >= image.height or j >= image.width:
        return
    is_hit = load(ints, SEEN + LANES * square) != NOTHING
    sees = bits(is_hit) != 0
    z = t = splat(np.float32(np.inf))
    if sees:
        z = packet_depths(view, square, floats)
        t = select(is_hit, z * np.float32(view.scale), t)
        if view.coarse:
            refine_square(view, world, tile, square, floats, ints)
            t = load(floats, EXACT_T)
    if image.has_depth:
        store_square(floats, DEPTH + at, TILE, t)
    if not (image.has_color or image.has_normal or image.has_id or image.has_primitive):
        return
    zero = splat(np.float32(0))
    normal = (zero, zero, zero)
    background = scene.background
    color = (splat(background[0]), splat(background[1]), splat(background[2]))
    objects = primitives = splat(np.int32(-1))
    if sees:
        first = first_point(tile, square)
        pixels = square_rays(view, first)
        surface, objects, primitives = find_surfaces(
            view,
            world,
            scene,
            first,
            pixels,
            square,
            z,
            image.has_color,
            image.has_primitive,
            ints,
        )
        normal = surface.shading
        if image.has_color:
            point = points_on(pixels, t)
            if view.coarse:
                point = load3(floats, EXACT_POINT)
            color = shade_square(
                view, world, scene, effects, pixels, first, t, point, surface, objects, floats, ints
            )
            if effects is not None:
                color = add_reflections(
                    view, world, scene, effects, pixels, square, point, surface, objects, color,
                    floats, ints,
                )  # fmt: skip
    if image.has_id:
        store_square(ints, ID + at, TILE, objects)
    if image.has_primitive:
        store_square(ints, PRIMITIVE + at, TILE, primitives)
    if image.has_normal:
        store_square3(floats, NORMAL + 3 * at, 3 * TILE, normal[0], normal[1], normal[2])
    if image.has_color:
        store_square3(floats, COLOR + 3 * at, 3 * TILE, color[0], color[1], color[2])


@inlined
def write_rows(image, channel, numbers, row, column, picture, at):
    """Copies picture[at :], so many numbers a pixel, to a channel: what of it is in the image."""
    width = image.width
    rows, columns = min(TILE, image.height - row), min(TILE, width - column)
    to = numbers * (row * width + column)
    is_in_lines = columns == TILE and width % TILE == 0 and is_line(channel, to)
    for _ in range(rows):
        if is_in_lines:
            for k in range(0, numbers * TILE, LANES):
                stream(channel, to + k, load(picture, at + k))
        else:
            for k in range(numbers * columns):
                channel[to + k] = picture[at + k]
        to += numbers * width
        at += numbers * TILE
