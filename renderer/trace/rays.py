"""Many rays at once: the closest hit of each, or whether there is any.

Owns the batches that a user gives, and their checks. The rays' way is rays_hit.py's.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.errors import LucidaError
from renderer.trace.atomic import take_next
from renderer.trace.compiled import inlined, kernel
from renderer.trace.control import new_control
from renderer.trace.instances import Instances, world_pointers
from renderer.trace.rays_hit import any_hit, closest_hit
from renderer.trace.simd import LANES, pointer
from renderer.trace.team import Team
from renderer.trace.wide import FIRST_LEAF

_CHUNK = 256  # rays that a thread takes at a time


def closest_hits(
    instances: Instances,
    team: Team,
    origins: ArrayLike,
    directions: ArrayLike,
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """(t, primitive) of the closest hit along each ray; inf and -1 where there is none.

    origins, directions: (n, 3), world space; directions of any length. t: float32 (n,), in
    units of the direction, t_min < t < t_max. primitive: int32 (n,), numbers of the flat scene.
    Arithmetic is float32. A ray that holds NaN or has no direction hits nothing. Raises LucidaError
    where the shapes are not those of rays.
    """
    o, d = _rays(origins, directions)
    t, primitive = np.empty(len(o), np.float32), np.empty(len(o), np.int32)
    limits = np.array([t_min, t_max], np.float32)
    team.run(
        _closest, instances.world, o, d, limits, t, primitive, instances.stack_size, new_control(),
        size=-(-len(o) // _CHUNK),
    )  # fmt: skip
    return t, primitive


def any_hits(
    instances: Instances,
    team: Team,
    origins: ArrayLike,
    directions: ArrayLike,
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> NDArray[np.bool_]:
    """bool (n,): whether each ray hits anything with t_min < t < t_max; see closest_hits."""
    o, d = _rays(origins, directions)
    hit = np.empty(len(o), np.bool_)
    limits = np.array([t_min, t_max], np.float32)
    team.run(
        _any, instances.world, o, d, limits, hit, instances.stack_size, new_control(),
        size=-(-len(o) // _CHUNK),
    )  # fmt: skip
    return hit


def _rays(
    origins: ArrayLike, directions: ArrayLike
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Both as contiguous float32 (n, 3)."""
    parts = []
    for name, value in (("origins", origins), ("directions", directions)):
        array = np.ascontiguousarray(value, np.float32)
        if array.ndim != 2 or array.shape[1] != 3:
            raise LucidaError(name, f"has shape {array.shape}", "give n x 3 numbers")
        parts.append(array)
    if len(parts[0]) != len(parts[1]):
        raise LucidaError("directions", f"are {len(parts[1])}", f"give {len(parts[0])}: one a ray")
    return parts[0], parts[1]


@inlined
def _ray(vectors, i):
    return np.float64(vectors[i, 0]), np.float64(vectors[i, 1]), np.float64(vectors[i, 2])


@kernel
def _closest(world, origins, directions, limits, t, primitive, stack_size, control):
    floats, ints = np.empty(stack_size + LANES, np.float32), np.empty(stack_size, np.int32)
    inner, t_min, t_max = world_pointers(world), limits[0], limits[1]
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        for i in range(first, min(first + _CHUNK, len(origins))):
            origin, direction = _ray(origins, i), _ray(directions, i)
            t[i], slot, space = closest_hit(
                inner, origin, direction, t_min, t_max, pointer(floats), pointer(ints)
            )
            if space >= 0:
                primitive[i] = world.face[slot] + world.first_primitive[space]
            else:
                primitive[i] = world.triangles + FIRST_LEAF - slot if slot <= FIRST_LEAF else -1


@kernel
def _any(world, origins, directions, limits, hit, stack_size, control):
    ints = np.empty(stack_size, np.int32)
    inner, t_min, t_max = world_pointers(world), limits[0], limits[1]
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(origins):
            return
        for i in range(first, min(first + _CHUNK, len(origins))):
            origin, direction = _ray(origins, i), _ray(directions, i)
            hit[i] = any_hit(inner, origin, direction, t_min, t_max, pointer(ints))
