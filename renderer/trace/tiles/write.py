"""The pixels of a tile: their colours and other channels, written into the image.

A tile's picture is completed in the scratch, square by square. Then it is copied to the image in
whole cache lines with non-temporal stores. Through the caches, an image of 18 MB takes one thread
2.4 times as long (17.2 ms instead of 7.0).
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.arguments.image import Image
from lucida.renderer.trace.bvh.instances import World
from lucida.renderer.trace.compile.compiled import inlined, kernel
from lucida.renderer.trace.compile.emit import lesser
from lucida.renderer.trace.compile.stage import StagedCode, new_room, prepared
from lucida.renderer.trace.reference.vectors import triple
from lucida.renderer.trace.vector.lanes import LANES, bits, select, splat
from lucida.renderer.trace.vector.math import load3, splat_lanes
from lucida.renderer.trace.vector.memory import (
    as_int32,
    is_line,
    load,
    pointer,
    pointers,
    store_square,
    store_square3,
    stream,
)

from .effects import Effects
from .lens_frame import is_later_frame, is_own_pixel, tile_view
from .refine import packet_depths, refine_square
from .shade import add_reflections, shade_square
from .surface import SceneArrays, find_surfaces, points_on, square_rays
from .tile import (
    NOTHING,
    SQUARE,
    SQUARES,
    TILE,
    new_tile,
    own_parameters,
    scratch_of,
    square_points,
)
from .view import PacketView


def writing_stage(
    view: PacketView, world: World, scene: SceneArrays, effects: Effects | None, image: Image
) -> StagedCode:
    """Return the stage that determines a tile's colours, and writes the image's channels.

    The arguments' arrays must be kept.
    """
    room = new_room()
    return StagedCode(prepare_writing(view, world, scene, effects, image, room), room)


@kernel
def prepare_writing(view, world, scene, effects, image, room):
    """Fill the room with the arguments. Return the address of write_tile's code."""
    always = pointers((view, world, scene, effects, image))
    return prepared(write_tile, always, pointer(room))


@inlined
def write_tile(always, row, column, floats, ints):
    """Write the tile at (row, column), whose pixels' closest objects are in the scratch."""
    camera, world, scene, effects, image = always
    scratch = scratch_of(floats, ints)
    view = tile_view(camera, scratch)
    tile = new_tile(view, row, column, scratch)
    for square in range(SQUARES):
        draw_square(view, world, scene, effects, image, row, column, tile, square, scratch)
    # Use one type for all, because each type would be compiled separately.
    one, three = np.int64(1), np.int64(3)
    if image.has_depth:
        to, picture = as_int32(image.depth), as_int32(scratch.depth)
        write_rows(view, tile, image, to, one, row, column, picture, scratch)
    if image.has_normal:
        to, picture = as_int32(image.normal), as_int32(scratch.normal)
        write_rows(view, tile, image, to, three, row, column, picture, scratch)
    if image.has_color:
        to, picture = as_int32(image.color), as_int32(scratch.color)
        write_rows(view, tile, image, to, three, row, column, picture, scratch)
    if image.has_id:
        write_rows(view, tile, image, image.id, one, row, column, scratch.id, scratch)
    if image.has_primitive:
        write_rows(view, tile, image, image.primitive, one, row, column, scratch.primitive, scratch)


@inlined
def draw_square(view, world, scene, effects, image, row, column, tile, square, scratch):
    """Draw one square of the tile at (row, column) into the tile's picture."""
    at = (square >> 2) * SQUARE * TILE + (square & 3) * SQUARE  # its first pixel in the picture
    i, j = row + (square >> 2) * SQUARE, column + (square & 3) * SQUARE
    if i >= image.height or j >= image.width:
        return
    is_hit = load(scratch.hit_slot, LANES * square) != NOTHING
    sees = bits(is_hit) != 0
    z = t = splat(np.float32(np.inf))
    if sees:
        z = packet_depths(view, square, scratch)
        t = select(is_hit, z * np.float32(view.scale), t)
        if view.coarse:
            refine_square(view, world, tile, square, scratch)
            t = load(scratch.exact_t, 0)
    if image.has_depth:
        store_square(scratch.depth, at, TILE, own_parameters(view, tile, square, t))
    if not (image.has_color or image.has_normal or image.has_id or image.has_primitive):
        return
    normal, color = splat_lanes((0, 0, 0)), splat_lanes(triple(scene.background, 0))
    objects = primitives = splat(np.int32(-1))
    if sees:
        points = square_points(view, tile, square)
        pixels = square_rays(view, points)
        surface, objects, primitives = find_surfaces(
            view, world, scene, points, pixels, square, z, image.has_color, image.has_primitive,
            scratch,
        )  # fmt: skip
        normal = surface.shading
        if image.has_color:
            point = points_on(pixels, t)
            if view.coarse:
                point = load3(scratch.exact_point, 0)
            color = shade_square(
                view, world, scene, effects, pixels, points, t, point, surface, objects, scratch
            )
            if effects is not None:
                color = add_reflections(
                    view, world, scene, effects, pixels, square, point, surface, objects, color,
                    scratch,
                )  # fmt: skip
    if image.has_id:
        store_square(scratch.id, at, TILE, objects)
    if image.has_primitive:
        store_square(scratch.primitive, at, TILE, primitives)
    if image.has_normal:
        store_square3(scratch.normal, 3 * at, 3 * TILE, normal[0], normal[1], normal[2])
    if image.has_color:
        store_square3(scratch.color, 3 * at, 3 * TILE, color[0], color[1], color[2])


@inlined
def write_rows(view, tile, image, channel, numbers, row, column, picture, scratch):
    """Copy the picture, with `numbers` values per pixel, to a channel.

    Only pixels inside the image are copied, and only their own pixels for a tile's later frames.
    """
    width = image.width
    rows, columns = lesser(TILE, image.height - row), lesser(TILE, width - column)
    to = numbers * (row * width + column)
    at = 0
    is_in_lines = columns == TILE and width % TILE == 0 and is_line(channel, to)
    is_later = is_later_frame(view.lens, scratch)
    for i in range(rows):
        if is_later:
            for k in range(numbers * columns):
                if is_own_pixel(view.lens, tile, i, k // numbers):
                    channel[to + k] = picture[at + k]
        elif is_in_lines:
            for k in range(0, numbers * TILE, LANES):
                stream(channel, to + k, load(picture, at + k))
        else:
            for k in range(numbers * columns):
                channel[to + k] = picture[at + k]
        to += numbers * width
        at += numbers * TILE
