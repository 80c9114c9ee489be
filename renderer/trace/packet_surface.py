"""The surfaces that a square's 16 pixels see: normals, vertex colours, object and primitive.

Owns the step from slots and spheres to what shading needs. Knows nothing of lights. The formulas
are shade.py's, in float32 lanes.

Most squares see one or two triangles. So the pixels are taken by triangle: one triangle's numbers
are loaded once and repeated in all lanes. Where that would go on for too long, the rest of the
pixels gather theirs; fetch() does the one or the other, so the formulas are written once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.trace.compiled import inlined
from renderer.trace.instances import HAS_COLORS, HAS_NORMALS, IS_STRETCHED
from renderer.trace.packet_leaf import edge_function, homogeneous
from renderer.trace.packet_sphere import (
    affine,
    moment,
    quadratic,
    sphere_equation,
    sphere_ray,
)
from renderer.trace.packet_tile import FIRST_SPHERE, NOTHING, OWNER, SEEN, SURFACE
from renderer.trace.packet_view import ACROSS, DOWN, ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS, SHARED, VARYING
from renderer.trace.simd import (
    LANES,
    bits,
    fetch,
    fetch_index,
    fma,
    gather,
    lane_column,
    lane_row,
    load,
    lowest_bit,
    mask_of,
    pointer,
    select,
    splat,
    store,
    vabs,
    vsqrt,
)
from renderer.trace.simd_math import (
    dot_lanes,
    inverse_length,
    minus_lanes,
    normalized_lanes,
    scaled_lanes,
    select_lanes,
)
from renderer.trace.wide import CORNERS, WIDTH

GRAZING = np.float32(1e-3)  # the cosine that shading normals keep, at least, towards the viewer
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
    """The rays of a square: image points, origins and directions."""

    x: object
    y: object
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
        return Pixels(x, y, varying, shared)
    return Pixels(x, y, shared, varying)


@inlined
def _ray_lanes(ray, axis, x, y):
    return fma(
        x,
        np.float32(ray[ACROSS + axis]),
        fma(y, np.float32(ray[DOWN + axis]), splat(np.float32(ray[VARYING + axis]))),
    )


@inlined
def find_surfaces(
    view, world, scene, first, pixels, square, z, wants_tint, wants_primitives, floats, ints
):
    """Fills a square's normals and colours (SURFACE); gives (objects, primitives), I32, -1: none.

    scene: SceneArrays. first: the square's first image point. z: of what its pixels see.
    Primitives are left out where they are not wanted.
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
            sphere_surface(view, world.spheres, sphere, first, pixels, z, mask, floats)
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
                view, world, scene, space, seen, at, mask, pixels, wants_tint, floats, ints
            )
        left &= ~bits(mask)
    return objects, primitives


@inlined
def triangle_normals(world, slots, at, mask, ints):
    """The triangles' normals in their own space, in the lanes of the mask; slots: ints[at :]."""
    x = y = z = splat(np.float32(0))
    left = bits(mask)
    for turn in range(SINGLES):
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
def instance_surface(view, world, scene, space, slots, at, mask, pixels, wants_tint, floats, ints):
    """The surfaces of one instance, in the lanes of the mask, which see the slots ints[at :]."""
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
    side = select(
        dot_lanes(geometric, pixels.direction) < np.float32(0), splat(np.float32(1)), np.float32(-1)
    )
    facing = scaled_lanes(side, geometric)
    _store_masked(floats, SHADING, mask, facing)
    if wants_tint:
        one = splat(np.float32(1))
        _store_masked(floats, GEOMETRIC, mask, facing)
        _store_masked(floats, TINT, mask, (one, one, one))
    wanted = world.attributes[space] & (HAS_NORMALS | (HAS_COLORS if wants_tint else 0))
    if wanted != 0:
        left = bits(mask)
        while left != 0:
            slot = np.int64(ints[at + lowest_bit(left)])
            same = mask & (slots == np.int32(slot))
            interpolate(
                view, world, scene, space, slot, same, pixels, geometric, side, wanted, floats
            )
            left &= ~bits(same)
    bend_grazing(pixels.direction, mask, floats)


@inlined
def _store_masked(floats, at, mask, a):
    for k in range(3):
        store(floats, at + LANES * k, select(mask, a[k], load(floats, at + LANES * k)))


@inlined
def bend_grazing(direction, mask, floats):
    """Bends shading normals just enough to face the viewer, in the lanes of the mask."""
    normal = _load3(floats, SHADING)
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
def _load3(floats, at):
    return load(floats, at), load(floats, at + LANES), load(floats, at + 2 * LANES)


@inlined
def interpolate(view, world, scene, space, slot, mask, pixels, geometric, side, wanted, floats):
    """Smooth normals and vertex colours of one slot, or a slot a lane, in the lanes of the mask."""
    leaf, lane = slot >> np.int32(4), slot & np.int32(15)
    b0, b1, b2 = barycentrics(view, world.corner, leaf, lane, space, mask, pixels)
    first = (fetch_index(world.face, slot, mask) + world.first_primitive[space]) * np.int32(3)
    i = fetch_index(scene.faces, first, mask) * np.int32(3)
    j = fetch_index(scene.faces, first + np.int32(1), mask) * np.int32(3)
    k = fetch_index(scene.faces, first + np.int32(2), mask) * np.int32(3)
    if wanted & HAS_NORMALS:
        n0 = _three(scene.normals, i, mask)
        n1 = _three(scene.normals, j, mask)
        n2 = _three(scene.normals, k, mask)
        smooth = _blend(b0, n0, b1, n1, b2, n2)
        size = dot_lanes(smooth, smooth)
        usable = mask & _is_set(n0) & _is_set(n1) & _is_set(n2) & (size >= np.float32(1e-12))
        # Normals that disagree with the winding are turned, for the whole triangle alike.
        total = (n0[0] + n1[0] + n2[0], n0[1] + n1[1] + n2[1], n0[2] + n1[2] + n2[2])
        turn = select(dot_lanes(total, geometric) >= np.float32(0), side, -side)
        shading = scaled_lanes(turn * inverse_length(smooth), smooth)
        _store_masked(floats, SHADING, usable, shading)
    if wanted & HAS_COLORS:
        c0 = _three(scene.colors, i, mask)
        c1 = _three(scene.colors, j, mask)
        c2 = _three(scene.colors, k, mask)
        _store_masked(floats, TINT, mask, _blend(b0, c0, b1, c1, b2, c2))


@inlined
def _three(array, at, mask):
    return (
        fetch(array, at, mask),
        fetch(array, at + np.int32(1), mask),
        fetch(array, at + np.int32(2), mask),
    )


@inlined
def _is_set(a):
    return vabs(a[0]) + vabs(a[1]) + vabs(a[2]) > np.float32(0)


@inlined
def _blend(b0, p, b1, q, b2, r):
    return (
        fma(b0, p[0], fma(b1, q[0], b2 * r[0])),
        fma(b0, p[1], fma(b1, q[1], b2 * r[1])),
        fma(b0, p[2], fma(b1, q[2], b2 * r[2])),
    )


@inlined
def barycentrics(view, corner, leaf, lane, space, mask, pixels):
    """(b0, b1, b2) at the pixels: the three edge functions over their sum."""
    at, r = leaf * np.int32(CORNERS) + lane, space * ROWS
    a = _corner(view.rows, r, corner, at, mask)
    b = _corner(view.rows, r, corner, at + np.int32(3 * WIDTH), mask)
    c = _corner(view.rows, r, corner, at + np.int32(6 * WIDTH), mask)
    ha, hb, hc = homogeneous(view, a, b, c)
    a, b, c = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    one = np.float32(1)
    e0, e1, e2 = edge_function(b, c, one), edge_function(c, a, one), edge_function(a, b, one)
    x, y = pixels.x, pixels.y
    w0 = fma(x, e0[0], fma(y, e0[1], e0[2]))
    w1 = fma(x, e1[0], fma(y, e1[1], e1[2]))
    w2 = fma(x, e2[0], fma(y, e2[1], e2[2]))
    scale = splat(np.float32(1)) / (w0 + w1 + w2)
    return w0 * scale, w1 * scale, w2 * scale


@inlined
def _corner(rows, r, corner, at, mask):
    x = fetch(corner, at, mask) - rows[r + ORIGIN]
    y = fetch(corner, at + np.int32(WIDTH), mask) - rows[r + ORIGIN + 1]
    z = fetch(corner, at + np.int32(2 * WIDTH), mask) - rows[r + ORIGIN + 2]
    return (
        fma(x, rows[r + ROW_X], fma(y, rows[r + ROW_X + 1], fma(z, rows[r + ROW_X + 2], splat(rows[r + ROW_X + 3])))),
        fma(x, rows[r + ROW_Y], fma(y, rows[r + ROW_Y + 1], fma(z, rows[r + ROW_Y + 2], splat(rows[r + ROW_Y + 3])))),
        fma(x, rows[r + ROW_Z], fma(y, rows[r + ROW_Z + 1], fma(z, rows[r + ROW_Z + 2], splat(rows[r + ROW_Z + 3])))),
    )


@inlined
def _component(p, axis, x, y):
    """One coordinate of an affine vector at 16 image points."""
    value = fma(x, np.float32(p[1][axis]), splat(np.float32(p[0][axis])))
    return fma(y, np.float32(p[2][axis]), value)


@inlined
def sphere_surface(view, spheres, sphere, first, pixels, z, mask, floats):
    """The surface of a sphere in the lanes of the mask; z: the depths seen.

    From the ray's point nearest to the centre, d x (f x d) / a, half a chord back or forth: no
    difference of large numbers, however far away the sphere is.
    """
    f, d = sphere_ray(view, spheres, sphere, np.float64(first[0]), np.float64(first[1]))
    equation = sphere_equation(f, d)
    x, y = lane_column(), lane_row()
    a, b = quadratic(equation[0], x, y), affine(equation[1], x, y)
    discriminant = quadratic(equation[3], x, y)
    m = moment(f, d)
    dx, dy, dz = _component(d, _X, x, y), _component(d, _Y, x, y), _component(d, _Z, x, y)
    mx, my, mz = _component(m, _X, x, y), _component(m, _Y, x, y), _component(m, _Z, x, y)
    inverse = splat(np.float32(1)) / a
    # The length of half the chord, in parameters.
    half = vsqrt(select(discriminant > np.float32(0), discriminant, np.float32(0))) * inverse
    half = select(z <= b * inverse, -half, half)
    normal = normalized_lanes(
        (
            fma(dy * mz - dz * my, inverse, half * dx),
            fma(dz * mx - dx * mz, inverse, half * dy),
            fma(dx * my - dy * mx, inverse, half * dz),
        )
    )
    side = select(
        dot_lanes(normal, pixels.direction) < np.float32(0), splat(np.float32(1)), np.float32(-1)
    )
    facing = scaled_lanes(side, normal)
    one = splat(np.float32(1))
    _store_masked(floats, TINT, mask, (one, one, one))
    _store_masked(floats, GEOMETRIC, mask, facing)
    _store_masked(floats, SHADING, mask, facing)
    bend_grazing(pixels.direction, mask, floats)
