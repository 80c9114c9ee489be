"""The closest hits of rays that a user passes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.trace.bvh.bvh16 import FIRST_LEAF
from lucida.renderer.trace.bvh.instances import Instances
from lucida.renderer.trace.compile.compiled import kernel
from lucida.renderer.trace.reference.vectors import triple
from lucida.renderer.trace.threads.atomic import take_next
from lucida.renderer.trace.threads.thread_pool import Team, new_control
from lucida.renderer.trace.vector.lanes import LANES
from lucida.renderer.trace.vector.memory import pointer, pointers

from .traverse import closest_hit

_CHUNK = 256  # rays that a thread takes at a time

Vectors = NDArray[np.floating]


def closest_hits(
    instances: Instances,
    team: Team,
    origins: Vectors,
    directions: Vectors,
    t_min: float = 0.0,
    t_max: float = np.inf,
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Return (t, primitive) of the closest hit along each ray; inf and -1 if there is none.

    origins, directions: (n, 3), world space; directions of any length. t: float32 (n,), in
    units of the direction, t_min < t < t_max. primitive: int32 (n,), numbers of the flat scene.
    Arithmetic is float32, from the ray's origin in each object's space. A ray that contains NaN or
    has no direction hits nothing.
    """
    # Make all arrays read-only, or the kernel would be compiled for both kinds.
    rays = [
        np.ascontiguousarray(vectors, np.float64).reshape(-1) for vectors in (origins, directions)
    ]
    for flat in rays:
        flat.flags.writeable = False
    count = len(origins)
    t, primitive = np.empty(count, np.float32), np.empty(count, np.int32)
    team.run(
        trace_rays, instances.world, *rays, np.float32(t_min), np.float32(t_max),
        t, primitive, instances.stack_size, new_control(), size=-(-count // _CHUNK),
    )  # fmt: skip
    return t, primitive


@kernel
def trace_rays(world, origins, directions, t_min, t_max, t, primitive, stack_size, control):
    """Trace chunks of rays until none are left."""
    floats, ints = np.empty(stack_size + LANES, np.float32), np.empty(stack_size, np.int32)
    inner = pointers(world)
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(t):
            return
        for i in range(first, min(first + _CHUNK, len(t))):
            origin, direction = triple(origins, 3 * i), triple(directions, 3 * i)
            depths, nodes = pointer(floats), pointer(ints)
            t[i], slot, space = closest_hit(inner, origin, direction, t_min, t_max, depths, nodes)
            if space >= 0:
                primitive[i] = world.face[slot] + world.first_primitive[space]
            else:
                primitive[i] = world.triangles + FIRST_LEAF - slot if slot <= FIRST_LEAF else -1
