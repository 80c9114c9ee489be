"""The surfaces that a square's 16 pixels see: normals, vertex colours, object and primitive.

Owns the step from slots and spheres to what shading needs. Knows nothing of lights. The formulas
are shade.py's, in float32 lanes.

Most squares see one or two triangles. So the pixels are taken by triangle, whose numbers are loaded
once and repeated in all lanes; of what is left after a few triangles, each lane gathers its own.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.trace import shade
from renderer.trace.compiled import inlined
from renderer.trace.instances import HAS_COLORS, HAS_NORMALS, IS_STRETCHED
from renderer.trace.packet_smooth import (
    agrees,
    barycentrics,
    barycentrics_at,
    blended,
    have_normals,
    vertices_of,
)
from renderer.trace.packet_sphere import sphere_normal, sphere_normal_at
from renderer.trace.packet_tile import FIRST_SPHERE, NOTHING, OWNER, SEEN, SURFACE
from renderer.trace.packet_view import ACROSS, DOWN, SHARED, VARYING
from renderer.trace.simd import (
    LANES,
    bits,
    fma,
    gather,
    lane_column,
    lane_of,
    lane_row,
    load,
    lowest_bit,
    mask_of,
    pointer,
    select,
    splat,
    store,
)
from renderer.trace.simd_math import (
    dot_lanes,
    inverse_length,
    minus_lanes,
    normalized_lanes,
    scaled_lanes,
)
from renderer.trace.wide import WIDTH

GRAZING = np.float32(shade.GRAZING)
_X, _Y, _Z = np.arange(3)
SINGLES = 3  # triangles that are taken one by one before the rest gather
# Vectors of a square's surface in the scratch: geometric and shading normal, vertex colour.
GEOMETRIC, SHADING, TINT = SURFACE, SURFACE + 3 * LANES, SURFACE + 6 * LANES


class SceneArrays(NamedTuple):
    """What shading takes of a FlatScene: pointers, and numbers."""

    faces: object
    normals: object
    colors: object
    materials: object
    lights: object
    light_count: object
    ambient: object
    background: object


@inlined
def scene_pointers(scene):
    """The SceneArrays of a FlatScene."""
    ambient, background = scene.ambient, scene.background
    return SceneArrays(
        pointer(scene.faces),
        pointer(scene.normals),
        pointer(scene.colors),
        pointer(scene.materials),
        pointer(scene.lights),
        len(scene.lights),
        (ambient[0], ambient[1], ambient[2]),
        (background[0], background[1], background[2]),
    )


class Pixels(NamedTuple):
    """The rays of a square's pixels: origins and directions."""

    origin: object
    direction: object


@inlined
def square_rays(view, first):
    """The rays of the 4 x 4 pixels whose first is at the image point `first`."""
    x, y = lane_column() + first[0], lane_row() + first[1]
    ray = view.ray
    varying = _ray_lanes(ray, _X, x, y), _ray_lanes(ray, _Y, x, y), _ray_lanes(ray, _Z, x, y)
    shared = (
        splat(np.float32(ray[SHARED])),
        splat(np.float32(ray[SHARED + 1])),
        splat(np.float32(ray[SHARED + 2])),
    )
    if view.parallel:
        return Pixels(varying, shared)
    return Pixels(shared, varying)


@inlined
def points_on(pixels, t):
    """The points of rays at t."""
    o, d = pixels.origin, pixels.direction
    return fma(t, d[0], o[0]), fma(t, d[1], o[1]), fma(t, d[2], o[2])


@inlined
def _ray_lanes(ray, axis, x, y):
    return fma(
        x,
        np.float32(ray[ACROSS + axis]),
        fma(y, np.float32(ray[DOWN + axis]), splat(np.float32(ray[VARYING + axis]))),
    )


@inlined
def find_surfaces(
    view, world, scene, first, pixels, square, depth, wants_tint, wants_primitives, floats, ints
):
    """Fills a square's normals and colours (SURFACE); gives (objects, primitives), I32, -1: none.

    scene: SceneArrays. first: the square's first image point; None for rays that are not the
    view's. depth: of what the pixels see, Z; for other rays, t. Primitives are left out where they
    are not wanted.
    """
    seen = load(ints, SEEN + LANES * square)
    owner = load(ints, OWNER + LANES * square)
    objects, primitives = splat(np.int32(-1)), splat(np.int32(-1))
    left = bits(seen != NOTHING)
    if left != 0xFFFF:
        for k in range(9):
            store(floats, GEOMETRIC + LANES * k, splat(np.float32(0)))
    while left != 0:
        lane = lowest_bit(left)
        number = ints[SEEN + LANES * square + lane]
        if number <= FIRST_SPHERE:
            mask = seen == number
            sphere = np.int64(FIRST_SPHERE) - number
            if first is None:
                normal = sphere_normal_at(world.spheres, sphere, points_on(pixels, depth))
            else:
                normal = sphere_normal(view, world.spheres, sphere, first, depth)
            facing = scaled_lanes(viewers_side(normal, pixels.direction), normal)
            store_surface(floats, mask, facing)
            bend_grazing(pixels.direction, mask, floats)
            objects = select(mask, splat(world.sphere_object[sphere]), objects)
            primitives = select(mask, splat(np.int32(world.triangles + sphere)), primitives)
        else:
            space = np.int64(ints[OWNER + LANES * square + lane])
            mask = (owner == np.int32(space)) & (seen >= np.int32(0))
            objects = select(mask, splat(world.root_object[space]), objects)
            if wants_primitives:
                found = gather(world.face, seen, mask) + world.first_primitive[space]
                primitives = select(mask, found, primitives)
            at = SEEN + LANES * square
            instance_surface(
                view, world, scene, space, seen, at, first, pixels, depth, mask, wants_tint,
                floats, ints,
            )  # fmt: skip
        left &= ~bits(mask)
    return objects, primitives


@inlined
def triangle_normals(world, slots, at, mask, ints):
    """The triangles' normals in their own space, in the lanes of the mask; slots: ints[at :]."""
    x = y = z = splat(np.float32(0))
    left = bits(mask)
    for _ in range(SINGLES):
        # One triangle, for all the pixels that see it.
        slot = np.int64(ints[at + lowest_bit(left)])
        n = (slot >> 4) * (3 * WIDTH) + (slot & 15)
        same = mask & (slots == np.int32(slot))
        x = select(same, splat(world.normal[n]), x)
        y = select(same, splat(world.normal[n + WIDTH]), y)
        z = select(same, splat(world.normal[n + 2 * WIDTH]), z)
        left &= ~bits(same)
        if left == 0:
            return x, y, z
    # The rest at once.
    rest = mask_of(left)
    n = (slots >> np.int32(4)) * np.int32(3 * WIDTH) + (slots & np.int32(15))
    return (
        select(rest, gather(world.normal, n, rest), x),
        select(rest, gather(world.normal, n + np.int32(WIDTH), rest), y),
        select(rest, gather(world.normal, n + np.int32(2 * WIDTH), rest), z),
    )


@inlined
def instance_surface(
    view, world, scene, space, slots, at, first, pixels, depth, mask, wants_tint, floats, ints
):
    """The surfaces of one instance, in the lanes of the mask.

    slots: what the pixels see, also in memory as ints[at :].
    """
    # The geometric normal, in world space, on the viewer's side.
    x, y, z = triangle_normals(world, slots, at, mask, ints)
    m, r = world.normal_matrix, space * 9
    geometric = (
        fma(x, m[r], fma(y, m[r + 1], z * m[r + 2])),
        fma(x, m[r + 3], fma(y, m[r + 4], z * m[r + 5])),
        fma(x, m[r + 6], fma(y, m[r + 7], z * m[r + 8])),
    )
    if world.attributes[space] & IS_STRETCHED:
        geometric = normalized_lanes(geometric)
    side = viewers_side(geometric, pixels.direction)
    store_surface(floats, mask, scaled_lanes(side, geometric))
    wanted = world.attributes[space] & (HAS_NORMALS | (HAS_COLORS if wants_tint else 0))
    if wanted != 0:
        left = bits(mask)
        while left != 0:
            # One triangle, for all the pixels that see it.
            lane = lowest_bit(left)
            slot = np.int64(ints[at + lane])
            same = mask & (slots == np.int32(slot))
            left &= ~bits(same)
            vertices = vertices_of(scene.faces, world.face[slot] + world.first_primitive[space])
            if first is None:
                weights = barycentrics_at(world, slot, space, points_on(pixels, depth))
            else:
                weights = barycentrics(view, world.corner, slot, space, first)
            if wanted & HAS_COLORS:
                _store_masked(floats, TINT, same, blended(scene.colors, vertices, weights))
            if wanted & HAS_NORMALS and have_normals(scene.normals, vertices):
                # Normals that disagree with the winding are turned, for the triangle as a whole.
                x, y, z = (
                    lane_of(geometric[0], lane),
                    lane_of(geometric[1], lane),
                    lane_of(geometric[2], lane),
                )
                turn = side if agrees(scene.normals, vertices, x, y, z) else -side
                smooth = blended(scene.normals, vertices, weights)
                usable = same & (dot_lanes(smooth, smooth) >= np.float32(1e-12))
                shading = scaled_lanes(turn * inverse_length(smooth), smooth)
                _store_masked(floats, SHADING, usable, shading)
    bend_grazing(pixels.direction, mask, floats)


@inlined
def viewers_side(normal, direction):
    """1 where a normal faces the viewer, else -1."""
    return select(
        dot_lanes(normal, direction) < np.float32(0), splat(np.float32(1)), np.float32(-1)
    )


@inlined
def store_surface(floats, mask, facing):
    """A flat, white surface in the lanes of the mask."""
    one = splat(np.float32(1))
    _store_masked(floats, GEOMETRIC, mask, facing)
    _store_masked(floats, SHADING, mask, facing)
    _store_masked(floats, TINT, mask, (one, one, one))


@inlined
def _store_masked(floats, at, mask, a):
    for k in range(3):
        store(floats, at + LANES * k, select(mask, a[k], load(floats, at + LANES * k)))


@inlined
def bend_grazing(direction, mask, floats):
    """Bends shading normals just enough to face the viewer, in the lanes of the mask."""
    normal = load3(floats, SHADING)
    cosine = dot_lanes(normal, direction)
    # Few squares have any: cosine > -GRAZING |direction|, without the root.
    close = cosine * cosine < dot_lanes(direction, direction) * (GRAZING * GRAZING)
    if bits(mask & (close | (cosine > np.float32(0)))) == 0:
        return
    along = normalized_lanes(direction)
    bent = dot_lanes(normal, along) + GRAZING
    turned = normalized_lanes(minus_lanes(normal, scaled_lanes(bent, along)))
    _store_masked(floats, SHADING, mask & (bent > np.float32(0)), turned)


@inlined
def store3(floats, at, a):
    """Stores three vectors, one behind the other."""
    store(floats, at, a[0])
    store(floats, at + LANES, a[1])
    store(floats, at + 2 * LANES, a[2])


@inlined
def load3(floats, at):
    """Three vectors, as store3 stores them."""
    return load(floats, at), load(floats, at + LANES), load(floats, at + 2 * LANES)
