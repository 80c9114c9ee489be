"""The light that arrives along arbitrary rays, shaded like the ray tracer's viewing rays.

Shades many hits at once: shade.py's formulas on arrays. A Tracer finds the hits (closest_hits,
any_hits). For pictures whose rays do not come from a Camera; for those of a Camera, Tracer.render
is many times faster.

Source: Marschner and Shirley, Fundamentals of Computer Graphics, ch. 4 (Blinn and Phong);
Whitted, "An Improved Illumination Model for Shaded Display", 1980.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.scene.flat import CHECKER_DIFFUSE, DIFFUSE_SHININESS, SPECULAR_CHECKERED, FlatScene
from renderer.scene.sampling import gloss, on_spheres, on_triangles, sampled
from renderer.shared_numbers import (
    AWAY,
    CELL_NUDGE,
    CHECKERED,
    GRAZING,
    NEAREST_LIGHT,
    OTHER_SIDE,
    SHORTEST_HALF,
    SHORTEST_MEAN,
)

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

# A secondary ray's offset from its surface, relative to the distance of the hit: t is float32 here.
AWAY_OF_ORIGIN = 2e-6
AT_ONCE = 1 << 14  # rays: their data fits the caches, and other jobs can run in between


@dataclass(frozen=True)
class RayShading:
    """Options for shading. t_range: limits of viewing rays' hits. shadows, mirror_depth: as in
    Tracer.
    """

    t_range: tuple[float, float] = (0.0, math.inf)
    shadows: bool = False
    mirror_depth: int = 0


class _Hits(NamedTuple):
    """The hits of n rays.

    directions: of the incoming rays. tint, gloss: factors of the diffuse and the specular colour.
    away: the distance from the surface at which secondary rays start, (n, 1).
    """

    objects: NDArray[np.int32]
    points: Floats
    directions: Floats
    geometric: Floats
    normals: Floats
    tint: Floats | None
    gloss: Floats
    away: Floats


def shaded(
    tracer: Any,
    flat: FlatScene,
    origins: ArrayLike,
    directions: ArrayLike,
    shading: RayShading,
    is_wanted: Callable[[], bool],
) -> NDArray[np.float32] | None:
    """Return linear light, float32 with the shape of the directions; None if it is no longer
    wanted.

    tracer: a Tracer whose scene is `flat`. origins, directions: (..., 3), world space, broadcast
    together; directions of any length. A ray that is not finite, or has no direction, sees the
    background. is_wanted: called from time to time.
    """
    start, way = np.broadcast_arrays(
        np.asarray(origins, np.float64), np.asarray(directions, np.float64)
    )
    start, way = start.reshape(-1, 3), way.reshape(-1, 3)
    light = np.empty(start.shape, np.float32)
    for first in range(0, len(start), AT_ONCE):
        if not is_wanted():
            return None
        part = slice(first, first + AT_ONCE)
        light[part] = _seen(tracer, flat, start[part], way[part], shading)
    return light.reshape(np.broadcast_shapes(np.shape(origins), np.shape(directions)))


def _seen(
    tracer: Any, flat: FlatScene, origins: Floats, directions: Floats, shading: RayShading
) -> Floats:
    """Return the light (n, 3) along rays, and along their reflections."""
    light = np.zeros(origins.shape)
    weight, number = np.ones(origins.shape), np.arange(len(origins))
    limits = shading.t_range
    for bounce in range(shading.mirror_depth + 1):
        with np.errstate(over="ignore"):
            single = directions.astype(np.float32)
        single[~(np.isfinite(single) & np.isfinite(origins)).all(axis=1)] = 0  # hits nothing
        t, primitives = tracer.closest_hits(origins, single, *limits)
        limits = 0.0, math.inf
        hit = primitives >= 0
        light[number[~hit]] += weight[~hit] * flat.background
        found = _hits(flat, origins[hit], directions[hit], t[hit], primitives[hit])
        number, weight = number[hit], weight[hit]
        light[number] += weight * _colors(tracer, flat, found, shading.shadows)
        if bounce == shading.mirror_depth:
            break
        weight = weight * flat.materials[found.objects, SPECULAR_CHECKERED, :3] * found.gloss
        more = weight.max(axis=1, initial=0.0) > 0
        if not more.any():
            break
        number, weight = number[more], weight[more]
        origins, directions = _reflected(found, more)
    return light


def _hits(
    flat: FlatScene,
    origins: Floats,
    directions: Floats,
    t: NDArray[np.float32],
    primitives: NDArray[np.int32],
) -> _Hits:
    points = origins + t[:, None] * directions
    triangles = len(flat.faces)
    geometric, normals = np.empty(points.shape), np.empty(points.shape)
    objects = np.empty(len(points), np.int32)
    round_ = primitives >= triangles
    if round_.any():
        spheres = primitives[round_] - triangles
        objects[round_] = flat.sphere_object[spheres]
        out = points[round_] - flat.spheres[spheres, :3]
        # A tiny sphere far away may round to its centre.
        out = np.where((_dot(out, out) > 0)[:, None], out, directions[round_])
        geometric[round_] = normals[round_] = _facing(_unit(out), directions[round_])
    tint, shine = None, np.ones(points.shape)
    if len(flat.texels):
        tint = np.ones(points.shape)
        if round_.any():
            places = on_spheres(flat, objects[round_], out)
            tint[round_] = _image_light(sampled, flat, objects[round_], places)
            shine[round_] = _image_light(gloss, flat, objects[round_], places)
    if not round_.all():
        plane, faces = ~round_, primitives[~round_]
        objects[plane] = flat.face_object[faces]
        geometric[plane], normals[plane], tints, shine[plane] = _on_triangles(
            flat, faces, objects[plane], points[plane], directions[plane]
        )
        if tints is not None:
            tint = np.ones(points.shape) if tint is None else tint
            tint[plane] = tints
    normals = _not_grazing(normals, directions)
    middle = flat.bounds.mean(axis=0)
    away = AWAY * np.abs(flat.bounds - middle).max()
    from_origin = np.abs(origins - middle).max(axis=1, keepdims=True, initial=0.0)
    away = away + AWAY_OF_ORIGIN * from_origin
    return _Hits(objects, points, directions, geometric, normals, tint, shine, away)


def _image_light(
    sample: Callable[..., Floats], flat: FlatScene, objects: NDArray[np.int32], places: Floats
) -> Floats:
    """Return the result of sampled() or gloss() at texel coordinates (n, 2); 1 without a
    texture.
    """
    light = np.ones((len(objects), 3))
    has = (flat.textures[objects, 0, 1] > 0) & np.isfinite(places).all(axis=1)
    light[has] = sample(flat, objects[has], places[has])
    return light


def _on_triangles(
    flat: FlatScene,
    faces: NDArray[np.int32],
    objects: NDArray[np.int32],
    points: Floats,
    directions: Floats,
) -> tuple[Floats, Floats, Floats | None, Floats]:
    """Return geometric and shading normals on the viewer's side; the product of the vertices'
    colours and the textures', None for white; and the gloss.
    """
    corners = flat.faces[faces]
    matrix = flat.world_from_object[objects, :3]
    a, b, c = (flat.vertices[corners[:, k]].astype(np.float64) for k in range(3))
    turn, shift = matrix[:, :, :3], matrix[:, :, 3]
    to_b, to_c = (np.einsum("nij,nj->ni", turn, edge) for edge in (b - a, c - a))
    across = _cross(to_b, to_c)
    size = _dot(across, across)
    geometric = _unit(across)
    facing = _facing(geometric, directions)
    normals = flat.normals[corners].astype(np.float64)  # (n, 3 corners, 3)
    is_smooth = np.einsum("nki,nki->nk", normals, normals).min(axis=1, initial=1.0) > 0
    colors = flat.colors[corners]
    is_tinted = bool((colors != 1).any()) or len(flat.texels) > 0
    if not is_smooth.any() and not is_tinted:
        return facing, facing, None, np.ones(facing.shape)
    inside = points - (np.einsum("nij,nj->ni", turn, a) + shift)
    b1 = _dot(_cross(inside, to_c), across) / size
    b2 = _dot(_cross(to_b, inside), across) / size
    parts = np.stack([1.0 - b1 - b2, b1, b2], axis=1)
    mean = np.einsum("nk,nki->ni", parts, normals)
    length = np.sqrt(_dot(mean, mean))
    # Negate normals that disagree with the winding, consistently for the whole triangle.
    turned = (_dot(normals.sum(axis=1), geometric) < OTHER_SIDE) ^ (
        _dot(geometric, directions) >= 0
    )
    smooth = is_smooth & (length >= SHORTEST_MEAN)
    tints = np.einsum("nk,nki->ni", parts, colors)
    shine = np.ones(facing.shape)
    if len(flat.texels):
        places = on_triangles(flat, faces, parts)
        tints *= _image_light(sampled, flat, objects, places)
        shine = _image_light(gloss, flat, objects, places)
    with np.errstate(all="ignore"):
        mean = mean * (np.where(turned, -1.0, 1.0) / length)[:, None]
    shading = np.where(smooth[:, None], mean, facing)
    return facing, shading, tints if is_tinted else None, shine


def _colors(tracer: Any, flat: FlatScene, hits: _Hits, shadows: bool) -> Floats:
    """Return the light (n, 3) that hits send back along their rays, without reflections."""
    materials = flat.materials[hits.objects].astype(np.float64)
    albedo = materials[:, DIFFUSE_SHININESS, :3]
    checkered = materials[:, SPECULAR_CHECKERED, 3] == CHECKERED
    if checkered.any():
        other = checkered.copy()
        other[checkered] = _is_other_cell(
            flat.cells[hits.objects[checkered]], hits.points[checkered], hits.geometric[checkered]
        )
        albedo = np.where(other[:, None], materials[:, CHECKER_DIFFUSE, :3], albedo)
    if hits.tint is not None:
        albedo = albedo * hits.tint
    specular = materials[:, SPECULAR_CHECKERED, :3] * hits.gloss
    shininess = materials[:, DIFFUSE_SHININESS, 3]
    is_shiny = bool(specular.any())
    along = _unit(hits.directions)
    color = flat.ambient * albedo
    for lamp in flat.lights.astype(np.float64):
        to_light = np.broadcast_to(lamp[0, :3], hits.points.shape)
        is_point = lamp[0, 3] != 0
        there = np.ones(len(hits.points), bool)
        if is_point:
            to_light = lamp[0, :3] - hits.points
            distance = np.sqrt(_dot(to_light, to_light))
            there = distance >= NEAREST_LIGHT
            to_light = to_light / np.where(there, distance, 1.0)[:, None]
        if shadows:
            there &= _lit(tracer, hits, lamp[0], to_light)
        n_dot_l = np.where(there, np.maximum(0.0, _dot(hits.normals, to_light)), 0.0)
        color += n_dot_l[:, None] * (lamp[1, :3] * albedo)
        if not is_shiny:
            continue
        half = to_light - along
        size = np.sqrt(_dot(half, half))
        n_dot_h = _dot(hits.normals, half) / np.where(size >= SHORTEST_HALF, size, np.inf)
        strength = np.where(there, np.maximum(0.0, n_dot_h) ** shininess, 0.0)
        color += strength[:, None] * (lamp[1, :3] * specular)
    return color


def _is_other_cell(cells: Floats, points: Floats, geometric: Floats) -> Bools:
    """Return for each point if it is in an odd cell, just below the surface."""
    across = _unit(np.einsum("nij,nj->ni", cells[:, :, :3], geometric))
    place = np.einsum("nij,nj->ni", cells[:, :, :3], points) + cells[:, :, 3] - CELL_NUDGE * across
    odd: Bools = (place % 2.0 >= 1.0).sum(axis=1) % 2 == 1
    return odd


def _lit(tracer: Any, hits: _Hits, lamp: Floats, to_light: Floats) -> Bools:
    """Return which hits see a light, tested by rays from slightly off the surface."""
    lit: Bools = _dot(hits.geometric, to_light) > 0
    start = (hits.points + hits.away * hits.geometric)[lit]
    way, reach = (lamp[:3] - start, 1.0) if lamp[3] != 0 else (to_light[lit], math.inf)
    lit[lit] = ~tracer.any_hits(start, way.astype(np.float32), 0.0, reach)
    return lit


def _reflected(hits: _Hits, chosen: Bools) -> tuple[Floats, Floats]:
    """Return the reflected rays of the chosen hits: the law of reflection."""
    directions, geometric, normals = (
        part[chosen] for part in (hits.directions, hits.geometric, hits.normals)
    )
    way = directions - 2 * _dot(directions, normals)[:, None] * normals
    # A smooth normal may send a ray into the surface.
    flat = directions - 2 * _dot(directions, geometric)[:, None] * geometric
    way = np.where((_dot(way, geometric) > 0)[:, None], way, flat)
    return hits.points[chosen] + hits.away[chosen] * geometric, way


def _facing(normals: Floats, directions: Floats) -> Floats:
    return np.where((_dot(normals, directions) < 0)[:, None], normals, -normals)


def _not_grazing(normals: Floats, directions: Floats) -> Floats:
    """Return the normals, bent just enough to face the viewer."""
    along = _unit(directions)
    cosine = _dot(normals, along)
    bent = cosine > -GRAZING
    if bent.any():
        normals = normals.copy()
        normals[bent] = _unit(normals[bent] - (cosine[bent] + GRAZING)[:, None] * along[bent])
    return normals


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("ij,ij->i", a, b)


def _cross(a: Floats, b: Floats) -> Floats:
    ax, ay, az = a.T
    bx, by, bz = b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)


def _unit(a: Floats) -> Floats:
    return a / np.sqrt(_dot(a, a))[:, None]
