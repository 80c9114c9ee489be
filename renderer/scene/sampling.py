"""Texture lookups, holes and unseen backs at many hits at once, in float64.

These functions serve code outside the renderers that computes on arrays of rays.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import CLAMP, MIRROR, TEXEL_BITS, WRAP_BITS

from .flat import CHECKER_DIFFUSE, FlatScene

F64 = NDArray[np.float64]
Ints = NDArray[np.integer]
_MOST = (1 << TEXEL_BITS) - 1
_LATTICE = 8  # samples along a side of a rectangle on an image


def on_triangles(flat: FlatScene, triangles: Ints, weights: F64) -> F64:
    """Return the texel coordinates (n, 2) of points of triangles, by their barycentrics (n, 3)."""
    corners = flat.uv[flat.faces[triangles]].astype(np.float64)
    places: F64 = np.einsum("nk,nkx->nx", weights, corners)
    return places


def on_spheres(flat: FlatScene, objects: Ints, outward: F64) -> F64:
    """Return the texel coordinates (n, 2) in directions (n, 3) from the centres of spheres: u is
    the longitude, 1/2 towards z and growing towards x, v the latitude.
    """
    x, y, z = outward.T
    u = 0.5 + np.arctan2(x, z) / (2 * np.pi)
    v = 0.5 + np.arctan2(y, np.hypot(x, z)) / np.pi
    a, b, c, d = flat.materials[objects, CHECKER_DIFFUSE].astype(np.float64).T
    return np.stack([a * u + b, c * v + d], axis=1)


def sampled(flat: FlatScene, objects: Ints, places: F64) -> F64:
    """Return the linear light (n, 3) of the objects' textures at finite texel places (n, 2)."""
    return _interpolated(flat, objects, places, flat.textures[objects, 0, 0], _light)


def gloss(flat: FlatScene, objects: Ints, places: F64) -> F64:
    """Return the light (n, 3) that multiplies the objects' specular colours; 1 without a metal."""
    first = flat.textures[objects, 1, 0]
    light = _interpolated(flat, objects, places, np.maximum(first, 0), _light)
    return np.where(first[:, None] < 0, 1.0, light)


def opacity(flat: FlatScene, objects: Ints, places: F64) -> F64:
    """Return by how much (n, 1) the objects' opacities exceed their cutouts: less than 0 in a hole;
    1 without a cutout.
    """
    first = flat.textures[objects, 1, 1]
    column = _interpolated(flat, objects, places, np.maximum(first, 0), lambda t: t[:, None])
    return np.where(first[:, None] < 0, 1.0, column)


def are_passed(
    flat: FlatScene, triangles: Ints, weights: F64, direction: F64, is_light: bool = False
) -> NDArray[np.bool_]:
    """Return a mask of the triangles (n,) that a ray passes at its hit: at an invisible back, or
    through a hole.

    weights (n, 3): barycentrics.
    direction (3,): the ray's, in the world.
    is_light: the ray is light, which backs stop.
    """
    owner = flat.face_object[triangles]
    passed = (flat.single_sided[owner] > 0) & (not is_light)
    if passed.any():
        one_sided, matrix = triangles[passed], flat.world_from_object[owner[passed], :3, :3]
        a, b, c = np.moveaxis(flat.vertices[flat.faces[one_sided]].astype(np.float64), 1, 0)
        inside = np.linalg.solve(matrix, np.broadcast_to(direction[:, None], (len(a), 3, 1)))
        passed[passed] = np.einsum("ni,ni->n", np.cross(b - a, c - a), inside[..., 0]) > 0
    holed = flat.textures[owner, 1, 1] >= 0
    if holed.any():
        places = on_triangles(flat, triangles[holed], weights[holed])
        passed[holed] |= opacity(flat, owner[holed], places)[:, 0] < 0
    return passed


def _interpolated(
    flat: FlatScene, objects: Ints, places: F64, first: Ints, read: Callable[[Ints], NDArray[Any]]
) -> F64:
    """Interpolate bilinearly between the four texels around each place.

    first: the first texels of the objects' images.
    read: returns the values (n, k) of packed texels (n,).
    """
    _, width, height, wraps = flat.textures[objects, 0].astype(np.int64).T
    begin = np.floor(places - 0.5)
    right, down = (places - 0.5 - begin).T[..., None]
    column, row = begin.astype(np.int64).T
    wrap_u, wrap_v = wraps & ((1 << WRAP_BITS) - 1), wraps >> WRAP_BITS
    left, next_ = (_wrapped(column + k, width, wrap_u) for k in (0, 1))
    rows = []
    for k in (0, 1):
        start = first + (width + 1) * _wrapped(row + k, height, wrap_v)
        values = (read(flat.texels[start + at]) for at in (left, next_))
        rows.append((1 - right) * next(values) + right * next(values))
    found: F64 = (1 - down) * rows[0] + down * rows[1]
    return found


def between(
    sample: Callable[[FlatScene, Ints, F64], F64], flat: FlatScene, objects: Ints, places: F64
) -> tuple[F64, F64]:
    """Return the least and the largest value of sampled(), gloss() or opacity() at texel
    coordinates (k, n, 2), and between those more than 1/8 texel apart.
    """
    found = np.stack([sample(flat, objects, place) for place in places])
    least, most = found.min(axis=0), found.max(axis=0)
    low, high = places.min(axis=0), places.max(axis=0)
    size = high - low
    wide = (size > 1 / _LATTICE).any(axis=1)
    middles = [np.floor(low + step * size) + 0.5 for step in np.linspace(0, 1, _LATTICE + 1)]
    # Extremes are only at the middles of texels, and at the edges.
    tried = np.stack([low, high, *middles]).clip(low, high)[:, wide]
    for u in tried[..., 0] if wide.any() else ():
        at = np.stack(np.broadcast_arrays(u, tried[..., 1]), -1)
        more = sample(flat, np.tile(objects[wide], len(at)), at.reshape(-1, 2))
        more = more.reshape(*at.shape[:2], -1)
        least[wide] = np.minimum(least[wide], more.min(axis=0))
        most[wide] = np.maximum(most[wide], more.max(axis=0))
    vast = (size > _LATTICE / 2).any(axis=1)  # any of the image's texels may be there
    for number in np.unique(objects[vast]):
        _, width, height, _ = flat.textures[number, 0].tolist()
        mine = vast & (objects == number)
        for row in range(height):
            texels = np.column_stack([np.arange(width) + 0.5, np.full(width, row + 0.5)])
            every = sample(flat, np.full(width, number), texels)
            least[mine] = np.minimum(least[mine], every.min(axis=0))
            most[mine] = np.maximum(most[mine], every.max(axis=0))
    return least, most


def _wrapped(index: Ints, size: Ints, wrap: Ints) -> Ints:
    """Return the indices of texels that may be beyond images of `size` texels in this direction."""
    period = np.where(wrap == MIRROR, 2 * size, size)
    inside = index % period
    inside = np.where(inside >= size, period - 1 - inside, inside)
    return np.where(wrap == CLAMP, np.clip(index, 0, size - 1), inside)


def _light(packed: Ints) -> F64:
    parts = [packed >> shift & _MOST for shift in (0, TEXEL_BITS, 2 * TEXEL_BITS)]
    light: F64 = np.square(np.stack(parts, axis=1) / _MOST)
    return light
