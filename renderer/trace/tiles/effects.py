"""Shadows and mirrors, which image order allows because any ray can be traced.

The secondary rays of a square are traced one after another, on the trees that packets walk. The
effects are off by default, because a rasterizer has no such rays and its images would not agree.

Source: Whitted, "An Improved Illumination Model for Shaded Display", 1980.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.images.shared_numbers import AWAY
from lucida.renderer.scene.flat import SPECULAR_CHECKERED
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import emitted
from lucida.renderer.trace.rays.traverse import any_hit, closest_hit
from lucida.renderer.trace.reference.vectors import minus, plus, times, triple
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    lane_of,
    lowest_bit,
    mask_of,
    splat,
    vmax,
)
from lucida.renderer.trace.vector.math import (
    dot_lanes,
    fma_lanes,
    select_lanes,
    splat_lanes,
    store3,
)
from lucida.renderer.trace.vector.memory import load, shifted, store

from .smooth import triple_of_lane
from .surface import Pixels


class Effects(NamedTuple):
    """shadows: True if objects cast shadows. mirror_depth: the number of reflections of a viewing
    ray; the reflectance is the material's specular colour. away: the distance from a surface at
    which rays start, in world units.
    """

    shadows: bool
    mirror_depth: int
    away: np.float32


def effects_of(shadows: bool, mirror_depth: int, bounds: np.ndarray) -> Effects:
    """Return the effects for a scene within bounds (2, 3).

    The eye's distance does not matter, because hits are relative to the point of the scene nearest
    to it.
    """
    away = AWAY * np.abs(bounds - bounds.mean(axis=0)).max()
    return Effects(shadows, mirror_depth, np.float32(away))


@inlined
def lit_pixels(view, world, effects, point, geometric, to_light, light, mask, scratch):
    """Return the mask of the lit pixels.

    point: relative to the view's near_point. to_light: unit vectors. light: its position, also
    relative to near_point, if it is a point light (light[3] is not 0).
    """
    if not effects.shadows:
        return mask
    faces_light = mask & (dot_lanes(geometric, to_light) > np.float32(0))
    origin = fma_lanes(effects.away, geometric, point)
    reach = splat(np.float32(np.inf))
    if light[3] != np.float32(0):
        reach = (
            (light[0] - origin[0]) * to_light[0]
            + (light[1] - origin[1]) * to_light[1]
            + (light[2] - origin[2]) * to_light[2]
        )
    store3(scratch.origins, 0, origin)
    store3(scratch.directions, 0, to_light)
    store(scratch.reach, 0, reach)
    left = bits(faces_light)
    lit = left
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        start, way = _start(view, scratch, lane), triple_of_lane(scratch.directions, lane)
        limit = scratch.reach[lane]
        if any_hit(world, start, way, np.float32(0), limit, scratch.waiting):
            lit &= ~(np.int64(1) << lane)
    return mask_of(lit)


@emitted
def _start(view, scratch, lane):
    """Return the start of a lane's ray, in the world."""
    return plus(triple_of_lane(scratch.origins, lane), triple(view.near_point, 0))


@emitted
def reflected_rays(effects, pixels, point, surface):
    """Return the reflected rays of a square by the law of reflection.

    point: the hits.
    """
    d = pixels.direction
    geometric, shading = surface.geometric, surface.shading
    two = np.float32(2)
    way = minus(d, times(two * dot_lanes(d, shading), shading))
    # A smooth normal may send a ray into the surface.
    flat = minus(d, times(two * dot_lanes(d, geometric), geometric))
    way = select_lanes(dot_lanes(way, geometric) > np.float32(0), way, flat)
    return Pixels(fma_lanes(effects.away, geometric, point), way)


@inlined
def reflectance(scene, objects):
    """Return the specular colours of 16 objects; 0 for none."""
    color = splat_lanes((0, 0, 0))
    left = bits(objects >= np.int32(0))
    while left != 0:
        number = lane_of(objects, lowest_bit(left))
        mask = objects == number
        left &= ~bits(mask)
        at = np.int64(number) * 12 + 4 * SPECULAR_CHECKERED
        color = select_lanes(mask, splat_lanes(triple(scene.materials, at)), color)
    return color


@inlined
def trace_square(view, world, pixels, mask, square, scratch):
    """Trace 16 rays, one after another, in the lanes of the mask. Return their t.

    Hits are stored as a packet's are, so that find_surfaces() can read them.
    """
    store3(scratch.origins, 0, pixels.origin)
    store3(scratch.directions, 0, pixels.direction)
    store(scratch.reach, 0, splat(np.float32(np.inf)))
    store(scratch.hit_slot, LANES * square, splat(np.int32(-1)))
    left = bits(mask)
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        start, way = _start(view, scratch, lane), triple_of_lane(scratch.directions, lane)
        t, slot, space = closest_hit(
            world, start, way, np.float32(0), np.float32(np.inf),
            shifted(scratch.waiting_depths, 0), scratch.waiting,
        )  # fmt: skip
        scratch.reach[lane] = t
        scratch.hit_slot[LANES * square + lane] = slot
        scratch.hit_instance[LANES * square + lane] = space
    return load(scratch.reach, 0)


@emitted
def brightest(a):
    """Return the largest component of a colour, lane by lane."""
    return vmax(vmax(a[0], a[1]), a[2])
