"""The colour of a square's 16 pixels: checker, diffuse light and highlights, in float32 lanes.

The shading model is that of reference/shade.py, formula by formula.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.images.shared_numbers import (
    CELL_NUDGE,
    CHECKERED,
    NEAREST_LIGHT,
    SHORTEST_HALF,
)
from lucida.renderer.scene.flat import CHECKER_DIFFUSE, DIFFUSE_SHININESS, SPECULAR_CHECKERED
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted, f32
from lucida.renderer.trace.reference.vectors import each_times, minus, times, triple
from lucida.renderer.trace.vector.lanes import (
    bits,
    fma,
    inverse_root,
    lane_of,
    lane_row,
    lowest_bit,
    select,
    splat,
    to_f64,
    vfloor,
    vmax,
)
from lucida.renderer.trace.vector.math import (
    dot_lanes,
    each_fma,
    inverse_length,
    normalized_lanes,
    power_lanes,
    select_lanes,
    splat_lanes,
)
from lucida.renderer.trace.vector.memory import load

from .effects import brightest, lit_pixels, reflectance, reflected_rays, trace_square
from .surface import find_surfaces, points_on
from .texture import times_gloss
from .view import ACROSS, DOWN, SHARED, VARYING

_PER_NEAREST_LIGHT = np.float32(1) / np.float32(NEAREST_LIGHT)
_SHORTEST_HALF_SQUARE = np.float32(SHORTEST_HALF**2)


@inlined
def shade_square(view, world, scene, effects, pixels, points, t, point, surface, objects, scratch):
    """Return the colours of a square, three F32; pixels without an object have the background's.

    scene: SceneArrays. effects: Effects, or None. points: as for find_surfaces. t: ray parameters;
    None if `points` is. point: the hits. surface, objects: of the hits.
    """
    color = splat_lanes(triple(scene.background, 0))
    left = bits(objects >= np.int32(0))
    if left == 0:
        return color
    geometric, shading, tint = surface.geometric, surface.shading, surface.tint
    while left != 0:
        # The pixels of one object, which share its material.
        object_number = lane_of(objects, lowest_bit(left))
        mask = objects == object_number
        left &= ~bits(mask)
        m = np.int64(object_number) * 12
        albedo = _albedo(view, scene, m, points, t, point, geometric, tint, scratch)
        lit = shade_material(
            view, world, scene, effects, object_number, mask, pixels.direction, point, geometric,
            shading, albedo, surface.gloss, scratch,
        )  # fmt: skip
        color = select_lanes(mask, lit, color)
    return color


@inlined
def add_reflections(
    view, world, scene, effects, pixels, square, point, surface, objects, color, scratch
):
    """Return the colours of a square, plus the light that its surfaces reflect."""
    if effects.mirror_depth == 0:
        return color
    weight = times_gloss(scene.textures, surface.gloss, reflectance(scene, objects))
    for _ in range(effects.mirror_depth):
        mask = brightest(weight) > np.float32(0)
        if bits(mask) == 0:
            break
        pixels = reflected_rays(effects, pixels, point, surface)
        t = trace_square(view, world, pixels, mask, square, scratch)
        surface, objects, _primitives = find_surfaces(
            view, world, scene, None, pixels, square, t, True, False, scratch
        )
        point = points_on(pixels, t)
        seen = shade_square(
            view, world, scene, effects, pixels, None, None, point, surface, objects, scratch
        )
        color = each_fma(weight, seen, color)
        # Rays that escaped reflect nothing.
        more = times_gloss(scene.textures, surface.gloss, reflectance(scene, objects))
        weight = each_times(weight, more)
    return color


@emitted
def _albedo(view, scene, m, points, t, point, geometric, tint, scratch):
    """Return the diffuse reflectance of the material at m, or its checker's, times the tint."""
    materials = scene.materials
    albedo = splat_lanes(triple(materials, m + 4 * DIFFUSE_SHININESS))

    def checkered():
        other = splat_lanes(triple(materials, m + 4 * CHECKER_DIFFUSE))
        is_other = is_other_cell(view, scene.cells, m, points, t, point, geometric, scratch)
        return select_lanes(is_other, other, albedo)

    has_checker = materials[m + 4 * SPECULAR_CHECKERED + 3] == np.float32(CHECKERED)
    return each_times(choose(has_checker, checkered, lambda: albedo), tint)


@emitted
def is_other_cell(view, cells, m, points, t, point, geometric, scratch):
    """Return the mask of pixels in an odd cell, just below the surface.

    It is computed in float64, along the ray, because a pixel may be small compared with the cell's
    coordinates.
    """
    across = normalized_lanes(
        (
            _direction(cells, m, geometric),
            _direction(cells, m + 4, geometric),
            _direction(cells, m + 8, geometric),
        )
    )
    is_odd = lane_row() < np.float32(0)
    for axis in range(3):
        row = m + 4 * axis
        if points is None:
            half = _half_cell_at(view, cells, row, point)
        else:
            half = _half_cell(view, cells, row, points, t, scratch)
        half = fma(to_f64(across[axis]), -0.5 * CELL_NUDGE, half)
        is_odd = is_odd ^ (half - vfloor(half) >= 0.5)
    return is_odd


@emitted
def _direction(cells, row, a):
    x, y, z = f32(cells[row]), f32(cells[row + 1]), f32(cells[row + 2])
    return fma(a[0], x, fma(a[1], y, a[2] * z))


@emitted
def _half_cell(view, cells, row, points, t, scratch):
    """Return half of one coordinate of the pixels' cells, F64."""
    t = to_f64(t)
    t = choose(view.coarse, lambda: t + to_f64(load(scratch.rest_of_t, 0)), lambda: t)
    ray = view.ray
    right, down = _half_along(cells, row, ray, ACROSS), _half_along(cells, row, ray, DOWN)
    shared = _half_along(cells, row, ray, SHARED)
    varying = _half_along(cells, row, ray, VARYING)
    varying = varying + (points.x * right + points.y * down)
    constant = 0.5 * cells[row + 3]
    varying, shared = choose(
        view.parallel,
        lambda: (varying + constant, shared),
        lambda: (varying, shared + constant),
    )
    pixel = fma(to_f64(points.right), right, fma(to_f64(points.down), down, splat(varying)))
    return choose(
        view.parallel, lambda: fma(t, shared, pixel), lambda: fma(t, pixel, splat(shared))
    )


@emitted
def _half_cell_at(view, cells, row, point):
    """Return _half_cell() for points relative to the view's near_point."""
    a, b, c = 0.5 * cells[row], 0.5 * cells[row + 1], 0.5 * cells[row + 2]
    d = 0.5 * cells[row + 3] + _half_along(cells, row, view.near_point, 0)
    x, y, z = to_f64(point[0]), to_f64(point[1]), to_f64(point[2])
    return fma(x, a, fma(y, b, fma(z, c, splat(d))))


@emitted
def _half_along(cells, row, ray, at):
    return 0.5 * (
        cells[row] * ray[at] + cells[row + 1] * ray[at + 1] + cells[row + 2] * ray[at + 2]
    )


@inlined
def shade_material(
    view, world, scene, effects, object_number, mask, direction, point, geometric, shading, albedo,
    gloss, scratch,
):  # fmt: skip
    """Return the light that the pixels of one object, in the mask, send to the viewer.

    Source: Marschner and Shirley, Fundamentals of Computer Graphics, ch. 4 (Blinn and Phong).
    """
    materials, lights = scene.materials, scene.lights
    m, dark_cosine = np.int64(object_number) * 12, world.dark_cosine[object_number]
    specular = triple(materials, m + 4 * SPECULAR_CHECKERED)
    shininess = materials[m + 4 * DIFFUSE_SHININESS + 3]
    is_shiny = specular[0] + specular[1] + specular[2] > np.float32(0)
    along = normalized_lanes(direction) if is_shiny else direction
    color = each_times(albedo, triple(scene.ambient, 0))
    for lamp in range(0, 8 * scene.light_count, 8):
        to_light = splat_lanes(triple(lights, lamp))
        if lights[lamp + 3] != np.float32(0):
            to_light = minus(to_light, point)
            per_length = inverse_length(to_light)
            # A point at the light itself has no direction to it, and no light.
            is_apart = per_length < _PER_NEAREST_LIGHT
            to_light = times(select(is_apart, per_length, np.float32(0)), to_light)
        cosine = vmax(dot_lanes(shading, to_light), np.float32(0))
        in_light = mask
        if effects is not None:
            light = lights[lamp], lights[lamp + 1], lights[lamp + 2], lights[lamp + 3]
            in_light = lit_pixels(
                view, world, effects, point, geometric, to_light, light, mask, scratch
            )
            cosine = select(in_light, cosine, np.float32(0))
        rgb = triple(lights, lamp + 4)
        color = each_fma(times(cosine, rgb), albedo, color)
        if not is_shiny:
            continue
        half = minus(to_light, along)
        square = dot_lanes(half, half)
        cosine = dot_lanes(shading, half)
        # Highlights are small, so most squares have none of most lights.
        is_bright = cosine * cosine > square * (dark_cosine * dark_cosine)
        is_lit = in_light & is_bright & (cosine > np.float32(0)) & (square >= _SHORTEST_HALF_SQUARE)
        if lights[lamp + 3] != np.float32(0):
            is_lit = is_lit & (dot_lanes(to_light, to_light) > np.float32(0.5))
        if bits(is_lit) == 0:
            continue
        highlight = power_lanes(cosine * inverse_root(square), shininess)
        highlight = select(is_lit, highlight, np.float32(0))
        glossy = times_gloss(scene.textures, gloss, (highlight, highlight, highlight))
        color = each_fma(glossy, splat_lanes(each_times(rgb, specular)), color)
    return color
