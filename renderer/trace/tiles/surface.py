"""The surfaces at a square's 16 pixels: normals, vertex colours, object and primitive.

The formulas are those of reference/shade.py, in float32 lanes.

Most squares show one or two triangles. The pixels are therefore processed triangle by triangle,
whose numbers are loaded once and repeated in all lanes. After a few triangles, each remaining lane
gathers its own numbers.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.images import shared_numbers
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.trace.bvh.bvh16 import WIDTH
from lucida.renderer.trace.bvh.instances import HAS_COLORS, HAS_NORMALS, HAS_TEXTURE, IS_STRETCHED
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted
from lucida.renderer.trace.reference.vectors import minus, times, triple
from lucida.renderer.trace.vector.gather import gather
from lucida.renderer.trace.vector.lanes import LANES, bits, lowest_bit, mask_of, select, splat
from lucida.renderer.trace.vector.math import (
    dot_lanes,
    fma_lanes,
    inverse_length,
    normalized_lanes,
    select_lanes,
    splat_lanes,
)
from lucida.renderer.trace.vector.memory import load

from .smooth import agrees, barycentrics, barycentrics_at, blended, have_normals, vertices_of
from .sphere import sphere_normal, sphere_normal_at
from .texture import PacketTextures, between_vertices, glossy, nowhere, on_sphere, textured
from .tile import FIRST_SPHERE, NOTHING, coordinates
from .view import ACROSS, DOWN, SHARED, VARYING

GRAZING = np.float32(shared_numbers.GRAZING)
SHORTEST_MEAN_SQUARE = np.float32(shared_numbers.SHORTEST_MEAN**2)
SINGLES = 3  # triangles processed one by one before the other lanes gather


class SceneArrays(NamedTuple):
    """The arrays of a FlatScene that shading reads. textures: PacketTextures."""

    faces: Any
    normals: Any
    colors: Any
    materials: Any
    cells: Any
    textures: Any
    lights: Any
    light_count: int
    ambient: Any
    background: Any


def scene_arrays(flat: FlatScene, textures: PacketTextures) -> SceneArrays:
    return SceneArrays(
        flat.faces,
        flat.normals,
        flat.colors,
        flat.materials,
        flat.cells,
        textures,
        flat.lights,
        len(flat.lights),
        flat.ambient,
        flat.background,
    )


class Pixels(NamedTuple):
    """The rays of a square's pixels: origins, relative to the view's near_point, and directions."""

    origin: Any
    direction: Any


class Surface(NamedTuple):
    """The surface at a square's pixels.

    The fields are the unit normals of the triangle and for shading, both on the viewer's side; the
    tint, vertex colour times texture, which multiplies the material's colour; and the gloss, which
    multiplies the specular colour. Each has three F32; they are 0, and gloss 1, without a hit.

    It is passed in registers, because a vector is slow to load if some of its lanes were just
    stored.
    """

    geometric: Any
    shading: Any
    tint: Any
    gloss: Any


@emitted
def square_rays(view, points):
    """Return the rays of a square's pixels, at these image points."""
    x, y = coordinates(points)
    shared, varying = triple(view.ray, SHARED), triple(view.ray, VARYING)
    point = triple(view.near_point, 0)
    rays = choose(
        view.parallel,
        lambda: (_ray_lanes(view.ray, minus(varying, point), x, y), splat_lanes(shared)),
        lambda: (splat_lanes(minus(shared, point)), _ray_lanes(view.ray, varying, x, y)),
    )
    return Pixels(*rays)


@emitted
def points_on(pixels, t):
    """Return the points of rays at t, relative to the same point as the origins."""
    return fma_lanes(t, pixels.direction, pixels.origin)


@emitted
def _ray_lanes(ray, start, x, y):
    below = fma_lanes(y, splat_lanes(triple(ray, DOWN)), splat_lanes(start))
    return fma_lanes(x, splat_lanes(triple(ray, ACROSS)), below)


@inlined
def find_surfaces(
    view, world, scene, points, pixels, square, depth, wants_tint, wants_primitives, scratch
):
    """Return (Surface, objects, primitives) of a square's pixels; the numbers are I32, -1 for none.

    scene: SceneArrays. points: the pixels' image points; None for rays that are not the view's.
    depth: Z of the hits, or t for other rays. wants_primitives: False to leave the primitives out.
    """
    seen = load(scratch.hit_slot, LANES * square)
    owner = load(scratch.hit_instance, LANES * square)
    objects, primitives = splat(np.int32(-1)), splat(np.int32(-1))
    geometric = shading = tint = splat_lanes((0, 0, 0))
    gloss = white()
    left = bits(seen != NOTHING)
    while left != 0:
        lane = lowest_bit(left)
        number = scratch.hit_slot[LANES * square + lane]
        if number <= FIRST_SPHERE:
            mask = seen == number
            sphere = np.int64(FIRST_SPHERE) - number
            if points is None:
                normal = sphere_normal_at(view, world.spheres, sphere, points_on(pixels, depth))
            else:
                normal = sphere_normal(view, world.spheres, sphere, points, depth)
            facing = times(viewers_side(normal, pixels.direction), normal)
            own = Surface(facing, bend_grazing(pixels.direction, mask, facing), white(), white())
            own_number = world.sphere_object[sphere]
            objects = select(mask, splat(own_number), objects)
            places = on_sphere(scene.textures, scene.materials, own_number, normal)
            primitives = select(mask, splat(np.int32(world.triangles + sphere)), primitives)
        else:
            space = np.int64(scratch.hit_instance[LANES * square + lane])
            mask = (owner == np.int32(space)) & (seen >= np.int32(0))
            own_number = world.root_object[space]
            objects = select(mask, splat(own_number), objects)
            if wants_primitives:
                found = gather(world.face, seen, mask) + world.first_primitive[space]
                primitives = select(mask, found, primitives)
            at = LANES * square
            own, places = instance_surface(
                view,
                world,
                scene,
                space,
                seen,
                at,
                points,
                pixels,
                depth,
                mask,
                wants_tint,
                scratch,
            )
        geometric = select_lanes(mask, own.geometric, geometric)
        shading = select_lanes(mask, own.shading, shading)
        own_tint = textured(scene.textures, own_number, places, own.tint, wants_tint)
        tint = select_lanes(mask, own_tint, tint)
        gloss = glossy(scene.textures, own_number, places, mask, gloss)
        left &= ~bits(mask)
    return Surface(geometric, shading, tint, gloss), objects, primitives


@inlined
def triangle_normals(world, slots, at, mask, scratch):
    """Return the triangles' normals in their own space, in the lanes of the mask.

    slots: the pixels' hits, also in memory as scratch.hit_slot[at :].
    """
    x, y, z = splat_lanes((0, 0, 0))
    left = bits(mask)
    for _ in range(SINGLES):
        # One triangle, for all the pixels that see it.
        slot = np.int64(scratch.hit_slot[at + lowest_bit(left)])
        n = (slot >> 4) * (3 * WIDTH) + (slot & 15)
        same = mask & (slots == np.int32(slot))
        x = select(same, splat(world.normal[n]), x)
        y = select(same, splat(world.normal[n + WIDTH]), y)
        z = select(same, splat(world.normal[n + 2 * WIDTH]), z)
        left &= ~bits(same)
        if left == 0:
            return x, y, z
    # Gather the rest at once.
    rest = mask_of(left)
    n = (slots >> np.int32(4)) * np.int32(3 * WIDTH) + (slots & np.int32(15))
    return (
        select(rest, gather(world.normal, n, rest), x),
        select(rest, gather(world.normal, n + np.int32(WIDTH), rest), y),
        select(rest, gather(world.normal, n + np.int32(2 * WIDTH), rest), z),
    )


@inlined
def instance_surface(
    view, world, scene, space, slots, at, points, pixels, depth, mask, wants_tint, scratch
):
    """Return the Surface of one instance without its texture and gloss, and the pixels' texture
    coordinates; only the lanes of the mask are valid.

    slots: the pixels' hits, also in memory as scratch.hit_slot[at :].
    """
    # The geometric normal, in world space, on the viewer's side.
    x, y, z = triangle_normals(world, slots, at, mask, scratch)
    m, r = world.normal_matrix, space * 9
    normal = x, y, z
    geometric = (
        dot_lanes(normal, triple(m, r)),
        dot_lanes(normal, triple(m, r + 3)),
        dot_lanes(normal, triple(m, r + 6)),
    )
    if world.attributes[space] & IS_STRETCHED:
        geometric = normalized_lanes(geometric)
    side = viewers_side(geometric, pixels.direction)
    facing = times(side, geometric)
    shading, tint = facing, white()
    places = nowhere()
    wanted = HAS_NORMALS | (HAS_COLORS | HAS_TEXTURE if wants_tint else 0)
    wanted &= world.attributes[space]
    if wanted != 0:
        left = bits(mask)
        while left != 0:
            # One triangle, for all the pixels that see it.
            lane = lowest_bit(left)
            slot = np.int64(scratch.hit_slot[at + lane])
            same = mask & (slots == np.int32(slot))
            left &= ~bits(same)
            vertices = vertices_of(scene.faces, world.face[slot] + world.first_primitive[space])
            if points is None:
                weights = barycentrics_at(view, world, slot, space, points_on(pixels, depth))
            else:
                weights = barycentrics(view, world.corner, slot, space, points, scratch)
            if wanted & HAS_COLORS:
                tint = select_lanes(same, blended(scene.colors, vertices, weights), tint)
            places = between_vertices(scene.textures, same, vertices, weights, places)
            if wanted & HAS_NORMALS and have_normals(scene.normals, vertices):
                # Flip all of a triangle's normals if they disagree with its winding.
                turn = side if agrees(scene.normals, vertices, geometric, lane) else -side
                smooth = blended(scene.normals, vertices, weights)
                usable = same & (dot_lanes(smooth, smooth) >= SHORTEST_MEAN_SQUARE)
                smooth = times(turn * inverse_length(smooth), smooth)
                shading = select_lanes(usable, smooth, shading)
    return Surface(facing, bend_grazing(pixels.direction, mask, shading), tint, white()), places


@emitted
def viewers_side(normal, direction):
    """Return 1 where a normal faces the viewer, else -1."""
    return select(
        dot_lanes(normal, direction) < np.float32(0), splat(np.float32(1)), np.float32(-1)
    )


@emitted
def white():
    """Return the colour that changes nothing when multiplied."""
    return splat_lanes((1, 1, 1))


@emitted
def bend_grazing(direction, mask, normal):
    """Return shading normals bent just enough to face the viewer, in the lanes of the mask."""
    cosine = dot_lanes(normal, direction)
    # Few squares have any. Test cosine > -GRAZING |direction| without the root.
    close = cosine * cosine < dot_lanes(direction, direction) * (GRAZING * GRAZING)

    def bend():
        along = normalized_lanes(direction)
        bent = dot_lanes(normal, along) + GRAZING
        turned = normalized_lanes(minus(normal, times(bent, along)))
        return select_lanes(mask & (bent > np.float32(0)), turned, normal)

    is_any = bits(mask & (close | (cosine > np.float32(0)))) != 0
    return choose(is_any, bend, lambda: normal)
