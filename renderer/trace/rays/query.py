"""Batches of rays: the closest hit of each, or any hit.

Divides a batch between threads. traverse.py traverses each ray; jobs/ray_batch.py checks the user's
arguments.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.trace.bvh.bvh16 import FIRST_LEAF
from renderer.trace.bvh.instances import (
    HAS_HOLES,
    IS_SINGLE_SIDED,
    IS_UNMOVED,
    Instances,
)
from renderer.trace.compile.compiled import inlined, kernel
from renderer.trace.rays.bundle import COLUMNS
from renderer.trace.rays.together import Scratch, any_of_16, closest_of_16
from renderer.trace.rays.traverse import any_hit, closest_hit
from renderer.trace.simd.lanes import LANES, splat, to_f32, to_f64
from renderer.trace.simd.memory import load_interleaved, pointer, pointers, shifted
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
def _ray(vectors, i):
    return np.float64(vectors[i, 0]), np.float64(vectors[i, 1]), np.float64(vectors[i, 2])


@inlined
def _scratch(floats, ints, stack_size):
    """Return one thread's memory, as pointers to cache lines."""
    return Scratch(
        shifted(floats, (COLUMNS + 1 + LANES) * LANES),
        shifted(ints, 2 * LANES),
        shifted(ints, 2 * LANES + stack_size),
        shifted(floats, LANES),
        ints,
        floats,
        shifted(ints, LANES),
        shifted(ints, 2 * LANES + 2 * stack_size),
        shifted(floats, (COLUMNS + 1) * LANES),
    )


_LINES = COLUMNS + 4 + LANES  # of a thread's memory, in addition to the waiting nodes


@inlined
def _sixteen(vectors, first, pad):
    """Return 16 vectors as three F32 or F64 x, y, z; beyond the end of the array, any values."""
    if first + LANES <= len(vectors):
        return load_interleaved(pointer(vectors), 3 * first)
    for i in range(first, len(vectors)):
        for axis in range(3):
            pad[3 * (i - first) + axis] = vectors[i, axis]
    return load_interleaved(pointer(pad), 0)


@inlined
def _in_instance(world, origin, direction):
    """Return 16 rays in the space of instance 0, F32; t stays the same."""
    ox, oy, oz = to_f64(origin[0]), to_f64(origin[1]), to_f64(origin[2])
    if world.attributes[0] & IS_UNMOVED:
        return (to_f32(ox), to_f32(oy), to_f32(oz)), direction
    m = world.object_from_world
    dx, dy, dz = to_f64(direction[0]), to_f64(direction[1]), to_f64(direction[2])
    return (
        (
            to_f32(m[0] * ox + m[1] * oy + m[2] * oz + m[3]),
            to_f32(m[4] * ox + m[5] * oy + m[6] * oz + m[7]),
            to_f32(m[8] * ox + m[9] * oy + m[10] * oz + m[11]),
        ),
        (
            to_f32(m[0] * dx + m[1] * dy + m[2] * dz),
            to_f32(m[4] * dx + m[5] * dy + m[6] * dz),
            to_f32(m[8] * dx + m[9] * dy + m[10] * dz),
        ),
    )


@inlined
def _is_single(world):
    """Return True if the scene is one mesh that bundles of rays can traverse (bundle.py)."""
    if world.instances != 1 or world.top >= 0:
        return False
    return world.attributes[0] & (IS_SINGLE_SIDED | HAS_HOLES) == 0


@kernel
def _closest(world, origins, directions, limits, t, primitive, stack_size, control):
    floats = np.empty(_LINES * LANES + stack_size, np.float32)
    ints = np.empty(_LINES * LANES + 2 * stack_size, np.int32)
    pads = np.zeros(3 * LANES, origins.dtype), np.zeros(3 * LANES, np.float32)
    aligned, aligned_ints = -(floats.ctypes.data // 4) % LANES, -(ints.ctypes.data // 4) % LANES
    inner, t_min, t_max = pointers(world), limits[0], limits[1]
    is_single = _is_single(world)
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        end = min(first + _CHUNK, len(origins))
        scratch = _scratch(
            shifted(pointer(floats), aligned), shifted(pointer(ints), aligned_ints), stack_size
        )
        if not is_single:
            for i in range(first, end):
                origin, direction = _ray(origins, i), _ray(directions, i)
                t[i], slot, space = closest_hit(
                    inner, origin, direction, t_min, t_max, scratch.depths, scratch.nodes
                )
                if space >= 0:
                    primitive[i] = world.face[slot] + world.first_primitive[space]
                else:
                    primitive[i] = world.triangles + FIRST_LEAF - slot if slot <= FIRST_LEAF else -1
            continue
        for start in range(first, end, LANES):
            count = min(LANES, end - start)
            origin, direction = _in_instance(
                inner, _sixteen(origins, start, pads[0]), _sixteen(directions, start, pads[1])
            )
            closest_of_16(
                inner, origin, direction, inner.root[0], (np.int64(1) << count) - 1,
                t_min, splat(t_max), scratch,
            )  # fmt: skip
            for lane in range(count):
                slot = scratch.slots[lane]
                found = slot >= 0
                t[start + lane] = scratch.closest[lane] if found else np.float32(np.inf)
                primitive[start + lane] = (
                    world.face[slot] + world.first_primitive[0] if found else -1
                )


@kernel
def _any(world, origins, directions, limits, hit, stack_size, control):
    floats = np.empty(_LINES * LANES + stack_size, np.float32)
    ints = np.empty(_LINES * LANES + 2 * stack_size, np.int32)
    pads = np.zeros(3 * LANES, origins.dtype), np.zeros(3 * LANES, np.float32)
    aligned, aligned_ints = -(floats.ctypes.data // 4) % LANES, -(ints.ctypes.data // 4) % LANES
    inner, t_min, t_max = pointers(world), limits[0], limits[1]
    is_single = _is_single(world)
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        end = min(first + _CHUNK, len(origins))
        scratch = _scratch(
            shifted(pointer(floats), aligned), shifted(pointer(ints), aligned_ints), stack_size
        )
        if not is_single:
            for i in range(first, end):
                origin, direction = _ray(origins, i), _ray(directions, i)
                hit[i] = any_hit(inner, origin, direction, t_min, t_max, scratch.nodes)
            continue
        for start in range(first, end, LANES):
            count = min(LANES, end - start)
            origin, direction = _in_instance(
                inner, _sixteen(origins, start, pads[0]), _sixteen(directions, start, pads[1])
            )
            met = any_of_16(
                inner, origin, direction, inner.root[0], (np.int64(1) << count) - 1,
                t_min, splat(t_max), scratch,
            )  # fmt: skip
            for lane in range(count):
                hit[start + lane] = (met >> lane) & 1 != 0
