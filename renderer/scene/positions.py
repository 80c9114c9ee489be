"""World positions of a flat scene's vertices in float64, and the near point for float32 numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .flat import FlatScene

F32 = NDArray[np.float32]
F64 = NDArray[np.float64]


def world_vertices(flat: FlatScene, origin: ArrayLike = (0.0, 0.0, 0.0)) -> F64:
    """Return all vertices in the world, relative to `origin`: float64 (n, 3)."""
    world = np.empty((len(flat.vertices), 3))
    for number, (first, count) in enumerate(flat.object_vertices):
        world[first : first + count] = object_vertices(flat, number, origin)
    return world


def object_vertices(flat: FlatScene, number: int, origin: ArrayLike = (0.0, 0.0, 0.0)) -> F64:
    """Return one object's vertices in the world, relative to `origin`."""
    matrix, (first, count) = flat.world_from_object[number], flat.object_vertices[number]
    # Work by columns, because a matrix product may round equal vertices differently, which would
    # tear a mesh open where it has several at one place.
    x, y, z = np.hsplit(flat.vertices[first : first + count], 3)
    turned = x * matrix[:3, 0] + y * matrix[:3, 1] + z * matrix[:3, 2]
    world: F64 = turned + (matrix[:3, 3] - origin)
    return world


def world_corners(flat: FlatScene, triangles: NDArray[np.integer]) -> F64:
    """Return the corners of some triangles in the world: float64 (n, 3, 3), corner by corner."""
    matrix = flat.world_from_object[flat.face_object[triangles]]
    corners = flat.vertices[flat.faces[triangles]].astype(np.float64)
    world: F64 = corners @ np.swapaxes(matrix[:, :3, :3], 1, 2) + matrix[:, None, :3, 3]
    return world


def near_point(flat: FlatScene, eye: ArrayLike) -> F64:
    """Return the point (3,) of the scene's bounds that is nearest to the eye. float32 numbers that
    belong to no object, such as lights and hits, are relative to it.
    """
    point: F64 = np.clip(np.asarray(eye, np.float64), *flat.bounds)
    return point


def lights_from(flat: FlatScene, point: F64) -> F32:
    """Return the scene's lights as float32, points relative to `point`; read-only."""
    lights = flat.lights.astype(np.float64)
    lights[:, 0, :3] -= lights[:, 0, 3:] * point
    rows = lights.astype(np.float32)
    rows.setflags(write=False)
    return rows
