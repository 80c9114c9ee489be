"""Batches of rays: the closest hit of each, or any hit.

Divides a batch between threads. traverse.py traverses each ray; jobs/ray_batch.py checks the user's
arguments.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.trace.bvh.bvh16 import FIRST_LEAF
from renderer.trace.bvh.instances import Instances
from renderer.trace.compile.compiled import inlined, kernel
from renderer.trace.rays.traverse import any_hit, closest_hit
from renderer.trace.simd.lanes import LANES
from renderer.trace.simd.memory import pointer, pointers, shifted
from renderer.trace.threads.atomic import take_next
from renderer.trace.threads.thread_pool import Team, new_control

_CHUNK = 256  # rays that a thread takes at a time


def closest_hits(
    instances: Instances,
    team: Team,
    origins: NDArray[np.floating],
    directions: NDArray[np.float32],
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Return (t, primitive) of the closest hit along each ray; inf and -1 if there is none.

    origins: float32 or float64, directions: float32 (n, 3), C order, world space; of any length.
    t: float32 (n,), in units of the direction, t_min < t < t_max. primitive: int32 (n,), numbers of
    the flat scene. Arithmetic is float32, from the ray's origin in each object's space.
    A ray that contains NaN or has no direction hits nothing.
    """
    t, primitive = np.empty(len(origins), np.float32), np.empty(len(origins), np.int32)
    _run(_closest, instances, team, origins, directions, t_min, t_max, t, primitive)
    return t, primitive


def any_hits(
    instances: Instances,
    team: Team,
    origins: NDArray[np.floating],
    directions: NDArray[np.float32],
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> NDArray[np.bool_]:
    """Return for each ray if it hits anything with t_min < t < t_max, bool (n,); see
    closest_hits().
    """
    hit = np.empty(len(origins), np.bool_)
    _run(_any, instances, team, origins, directions, t_min, t_max, hit)
    return hit


def _run(kernel, instances, team, origins, directions, t_min, t_max, *results):
    # Read-only views: for writable arrays, a kernel would be compiled again.
    origins, directions = origins.view(), directions.view()
    origins.flags.writeable = directions.flags.writeable = False
    limits = np.array([t_min, t_max], np.float32)
    team.run(
        kernel, instances.world, origins, directions, limits, *results, instances.stack_size,
        new_control(),
        size=-(-len(origins) // _CHUNK),
    )  # fmt: skip


@inlined
def _vector(vectors, i):
    return np.float64(vectors[i, 0]), np.float64(vectors[i, 1]), np.float64(vectors[i, 2])


@kernel
def _closest(world, origins, directions, limits, t, primitive, stack_size, control):
    floats = np.empty(stack_size + 2 * LANES, np.float32)
    ints = np.empty(stack_size, np.int32)
    first_float = -(floats.ctypes.data // 4) % LANES
    world = pointers(world)
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        depths, nodes = shifted(pointer(floats), first_float), pointer(ints)
        for i in range(first, min(first + _CHUNK, len(origins))):
            t[i], slot, instance = closest_hit(
                world, _vector(origins, i), _vector(directions, i), limits[0], limits[1],
                depths, nodes,
            )  # fmt: skip
            if instance >= 0:
                primitive[i] = world.face[slot] + world.first_primitive[instance]
            else:
                primitive[i] = world.triangles + FIRST_LEAF - slot if slot <= FIRST_LEAF else -1


@kernel
def _any(world, origins, directions, limits, hit, stack_size, control):
    ints = np.empty(stack_size, np.int32)
    world = pointers(world)
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        nodes = pointer(ints)
        for i in range(first, min(first + _CHUNK, len(origins))):
            hit[i] = any_hit(
                world, _vector(origins, i), _vector(directions, i), limits[0], limits[1], nodes
            )
