"""Holes that a single ray passes through, where a texture's opacity is below the cutout."""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import CORNERS, WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.reference.texture import opacity_at_place
from lucida.renderer.trace.vector.lanes import lowest_bit


@inlined
def without_holes(world, ray, leaf, found):
    """Return those of a leaf's triangles in `found` that the ray does not hit in a hole."""
    left = found
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        at = leaf * CORNERS + lane
        ax, ay = _corner_on_ray(world.corner, at, ray)
        bx, by = _corner_on_ray(world.corner, at + 3 * WIDTH, ray)
        cx, cy = _corner_on_ray(world.corner, at + 6 * WIDTH, ray)
        e0, e1, e2 = cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax
        per_area = 1.0 / (e0 + e1 + e2)
        weights = e0 * per_area, e1 * per_area, e2 * per_area
        if _is_hole(world, leaf * WIDTH + lane, ray.space, weights):
            found &= ~(np.int64(1) << lane)
    return found


@inlined
def _corner_on_ray(corner, at, ray):
    """Return a corner relative to the origin, sheared so that the ray is the z axis: x, y."""
    z = np.float64(corner[at + ray.axes[2]]) - ray.origin[2]
    x = np.float64(corner[at + ray.axes[0]]) - ray.origin[0] - ray.shear[0] * z
    return x, np.float64(corner[at + ray.axes[1]]) - ray.origin[1] - ray.shear[1] * z


@inlined
def _is_hole(world, slot, space, weights):
    """Return True if a point of a slot's triangle is in a hole. weights: its barycentrics."""
    face = 3 * (np.int64(world.face[slot]) + np.int64(world.first_primitive[space]))
    x, y = 0.0, 0.0
    for corner in range(3):
        at = 2 * np.int64(world.faces[face + corner])
        weight = weights[0] if corner == 0 else (weights[1] if corner == 1 else weights[2])
        x, y = x + weight * world.uv[at], y + weight * world.uv[at + 1]
    of = 8 * np.int64(world.root_object[space])
    width, height, wraps = world.textures[of + 1], world.textures[of + 2], world.textures[of + 3]
    first = np.int64(world.textures[of + 5])
    return opacity_at_place(world.texels, first, width, height, wraps, x, y) < 0.0
