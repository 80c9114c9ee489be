"""Many rays at once: the closest hit of each, or whether there is any.

Owns how threads share a batch. Each ray's way is traverse.py's; jobs/ray_batch.py checks
what a user gives.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.trace.bvh.bvh16 import FIRST_LEAF
from renderer.trace.bvh.instances import Instances, world_pointers
from renderer.trace.compile.compiled import inlined, kernel
from renderer.trace.rays.traverse import (
    any_hit,
    any_hit_of_one,
    closest_hit,
    closest_hit_of_one,
)
from renderer.trace.simd.lanes import LANES
from renderer.trace.simd.memory import pointer, shifted
from renderer.trace.threads.atomic import take_next
from renderer.trace.threads.control import new_control
from renderer.trace.threads.thread_pool import Team

_CHUNK = 256  # rays that a thread takes at a time


def closest_hits(
    instances: Instances,
    team: Team,
    origins: NDArray[np.floating],
    directions: NDArray[np.float32],
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """(t, primitive) of the closest hit along each ray; inf and -1 where there is none.

    origins: float32 or float64, directions: float32 (n, 3), C order, world space; of any length.
    t: float32 (n,), in units of the direction, t_min < t < t_max. primitive: int32 (n,), numbers of
    the flat scene. Arithmetic is float32, from the ray's origin in each object's space.
    A ray that holds NaN or has no direction hits nothing.
    """
    t, primitive = np.empty(len(origins), np.float32), np.empty(len(origins), np.int32)
    limits = np.array([t_min, t_max], np.float32)
    team.run(
        _closest, instances.world, origins, directions, limits, t, primitive,
        instances.stack_size, new_control(),
        size=-(-len(origins) // _CHUNK),
    )  # fmt: skip
    return t, primitive


def any_hits(
    instances: Instances,
    team: Team,
    origins: NDArray[np.floating],
    directions: NDArray[np.float32],
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> NDArray[np.bool_]:
    """bool (n,): whether each ray hits anything with t_min < t < t_max; see closest_hits."""
    hit = np.empty(len(origins), np.bool_)
    limits = np.array([t_min, t_max], np.float32)
    team.run(
        _any, instances.world, origins, directions, limits, hit,
        instances.stack_size, new_control(),
        size=-(-len(origins) // _CHUNK),
    )  # fmt: skip
    return hit


@inlined
def _ray(vectors, i):
    return np.float64(vectors[i, 0]), np.float64(vectors[i, 1]), np.float64(vectors[i, 2])


@kernel
def _closest(world, origins, directions, limits, t, primitive, stack_size, control):
    floats, ints = np.empty(stack_size + 2 * LANES, np.float32), np.empty(stack_size, np.int32)
    aligned = -(floats.ctypes.data // 4) % LANES
    inner, t_min, t_max = world_pointers(world), limits[0], limits[1]
    is_single = world.instances == 1 and world.top < 0
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        for i in range(first, min(first + _CHUNK, len(origins))):
            origin, direction = _ray(origins, i), _ray(directions, i)
            floats_at = shifted(pointer(floats), aligned)
            if is_single:
                t[i], slot, space = closest_hit_of_one(
                    inner, origin, direction, t_min, t_max, floats_at, pointer(ints)
                )
            else:
                t[i], slot, space = closest_hit(
                    inner, origin, direction, t_min, t_max, floats_at, pointer(ints)
                )
            if space >= 0:
                primitive[i] = world.face[slot] + world.first_primitive[space]
            else:
                primitive[i] = world.triangles + FIRST_LEAF - slot if slot <= FIRST_LEAF else -1


@kernel
def _any(world, origins, directions, limits, hit, stack_size, control):
    ints = np.empty(stack_size, np.int32)
    inner, t_min, t_max = world_pointers(world), limits[0], limits[1]
    is_single = world.instances == 1 and world.top < 0
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        for i in range(first, min(first + _CHUNK, len(origins))):
            origin, direction = _ray(origins, i), _ray(directions, i)
            if is_single:
                hit[i] = any_hit_of_one(inner, origin, direction, t_min, t_max, pointer(ints))
            else:
                hit[i] = any_hit(inner, origin, direction, t_min, t_max, pointer(ints))
