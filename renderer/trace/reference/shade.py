"""The colour at a hit: the surface's normal, its albedo, and Blinn and Phong's shading.

The model is the same as in shaders/. Colours are linear light; arithmetic is in float64.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.images.shared_numbers import (
    CELL_NUDGE,
    CHECKERED,
    GRAZING,
    NEAREST_LIGHT,
    OTHER_SIDE,
    SHORTEST_HALF,
    SHORTEST_MEAN,
)
from lucida.renderer.scene import flat
from lucida.renderer.trace.compile.compiled import inlined

from .texture import BASE, MORE, light_at_place, opacity_at_place, place_at
from .vectors import blend, cross, dot, each_times, length, minus, normalized, plus, row, times

# Rows of a material, of a type that row() is compiled for.
DIFFUSE_SHININESS, SPECULAR_CHECKERED, CHECKER_DIFFUSE = (
    np.int64(number)
    for number in (flat.DIFFUSE_SHININESS, flat.SPECULAR_CHECKERED, flat.CHECKER_DIFFUSE)
)
FIRST, SECOND, THIRD = np.int64(0), np.int64(1), np.int64(2)
TEXTURED = flat.TEXTURED
NOWHERE = (0.0, 0.0, 0.0)


@inlined
def rgb(color):
    """Return a colour (3,) as float64."""
    return np.float64(color[0]), np.float64(color[1]), np.float64(color[2])


@inlined
def object_of(face_object, sphere_object, primitive):
    """Return the object that a primitive belongs to."""
    triangles = len(face_object)
    if primitive < triangles:
        return face_object[primitive]
    return sphere_object[primitive - triangles]


@inlined
def corners_of(faces, triangle):
    """Return the numbers of a triangle's vertices."""
    return np.int64(faces[triangle, 0]), np.int64(faces[triangle, 1]), np.int64(faces[triangle, 2])


@inlined
def turned(matrix, a):
    """Return the world direction of a direction a in an object's space."""
    x, y, z = row(matrix, FIRST), row(matrix, SECOND), row(matrix, THIRD)
    return dot(x, a), dot(y, a), dot(z, a)


@inlined
def normals_at(scene, direction, point, primitive, b1, b2):
    """Return (geometric, shading) unit normals at a hit, both on the viewer's side."""
    triangles = len(scene.faces)
    if primitive >= triangles:
        out = minus(point, row(scene.spheres, primitive - triangles))
        # A tiny sphere far away may round to its centre.
        facing = _facing(normalized(out if _is_set(out) else direction), direction)
        return facing, _not_grazing(facing, direction)
    i, j, k = corners_of(scene.faces, primitive)
    a, b, c = row(scene.vertices, i), row(scene.vertices, j), row(scene.vertices, k)
    # A mesh's vertices, and therefore two edges, are in its own space; turned() converts them.
    matrix = scene.world_from_object[object_of(scene.face_object, scene.sphere_object, primitive)]
    geometric = normalized(cross(turned(matrix, minus(b, a)), turned(matrix, minus(c, a))))
    facing = _facing(geometric, direction)
    shading = facing
    n0, n1, n2 = row(scene.normals, i), row(scene.normals, j), row(scene.normals, k)
    if _is_set(n0) and _is_set(n1) and _is_set(n2):
        smooth = blend(1.0 - b1 - b2, n0, b1, n1, b2, n2)
        size = length(smooth)
        if size >= SHORTEST_MEAN:
            # Flip all of a triangle's normals if they disagree with its winding.
            turn = 1.0 if dot(plus(n0, plus(n1, n2)), geometric) >= OTHER_SIDE else -1.0
            if dot(geometric, direction) >= 0.0:
                turn = -turn
            shading = times(turn / size, smooth)
    return facing, _not_grazing(shading, direction)


@inlined
def _facing(normal, direction):
    return normal if dot(normal, direction) < 0.0 else times(-1.0, normal)


@inlined
def _is_set(normal):
    return normal[0] != 0.0 or normal[1] != 0.0 or normal[2] != 0.0


@inlined
def _not_grazing(normal, direction):
    """Return the normal, bent just enough to face the viewer."""
    along = normalized(direction)
    cosine = dot(normal, along)
    if cosine > -GRAZING:
        return normalized(minus(normal, times(cosine + GRAZING, along)))
    return normal


@inlined
def albedo_at(scene, number, point, geometric, primitive, b1, b2):
    """Return the diffuse reflectance of object `number`: the material's times its texture's colour,
    or its checker's, times the vertices' colours."""
    material = scene.materials[number]
    albedo = row(material, DIFFUSE_SHININESS)
    pattern = material[SPECULAR_CHECKERED, 3]
    if pattern == CHECKERED and _is_other_cell(scene.cells[number], point, geometric):
        albedo = row(material, CHECKER_DIFFUSE)
    if pattern == TEXTURED:
        x, y = _place(scene, number, point, primitive, b1, b2)
        first = np.int64(scene.textures[number, BASE, 0])
        albedo = each_times(albedo, light_at_place(scene, number, first, x, y))
    if primitive < len(scene.faces):
        i, j, k = corners_of(scene.faces, primitive)
        colors = scene.colors
        tint = blend(1.0 - b1 - b2, row(colors, i), b1, row(colors, j), b2, row(colors, k))
        albedo = each_times(albedo, tint)
    return albedo


@inlined
def specular_at(scene, number, point, primitive, b1, b2):
    """Return the specular reflectance of object `number`: the material's times its metal's."""
    specular = row(scene.materials[number], SPECULAR_CHECKERED)
    first = np.int64(scene.textures[number, MORE, 0])
    if first >= 0:
        x, y = _place(scene, number, point, primitive, b1, b2)
        specular = each_times(specular, light_at_place(scene, number, first, x, y))
    return specular


@inlined
def _place(scene, number, point, primitive, b1, b2):
    """Return the texel coordinates of a hit."""
    outward = (0.0, 0.0, 0.0)
    if primitive >= len(scene.faces):
        outward = minus(point, row(scene.spheres, primitive - len(scene.faces)))
    return place_at(scene, number, outward, primitive, b1, b2)


@inlined
def passes(scene, direction, triangle, b1, b2):
    """Return True if a ray passes a triangle that it hits: at an invisible back, or through a
    hole.
    """
    number = scene.face_object[triangle]
    if scene.single_sided[number]:
        i, j, k = corners_of(scene.faces, triangle)
        a, b, c = row(scene.vertices, i), row(scene.vertices, j), row(scene.vertices, k)
        # The object's own space decides which side is the back, even if its transform mirrors it.
        matrix = scene.world_from_object[number]
        volume = dot(cross(row(matrix, FIRST), row(matrix, SECOND)), row(matrix, THIRD))
        normal = cross(turned(matrix, minus(b, a)), turned(matrix, minus(c, a)))
        if volume * dot(normal, direction) > 0.0:
            return True
    image, more = scene.textures[number, BASE], scene.textures[number, MORE]
    if more[1] < 0:
        return False
    x, y = place_at(scene, number, NOWHERE, triangle, b1, b2)
    first = np.int64(more[1])
    return opacity_at_place(scene.texels, first, image[1], image[2], image[3], x, y) < 0.0


@inlined
def _is_other_cell(cells, point, geometric):
    """Return True if a point just below the surface is in an odd-numbered cell."""
    x, y, z = row(cells, FIRST), row(cells, SECOND), row(cells, THIRD)
    across = normalized((dot(x, geometric), dot(y, geometric), dot(z, geometric)))
    u = dot(x, point) + cells[FIRST, 3] - CELL_NUDGE * across[0]
    v = dot(y, point) + cells[SECOND, 3] - CELL_NUDGE * across[1]
    w = dot(z, point) + cells[THIRD, 3] - CELL_NUDGE * across[2]
    return (u % 2.0 >= 1.0) ^ (v % 2.0 >= 1.0) ^ (w % 2.0 >= 1.0)


@inlined
def color_at(scene, direction, point, geometric, shading, primitive, b1, b2):
    """Return the light that a hit sends to the viewer.

    Highlights are not cut off where the surface turns away from the light.
    Source: Marschner and Shirley, Fundamentals of Computer Graphics, ch. 4 (Blinn and Phong).
    """
    number = object_of(scene.face_object, scene.sphere_object, primitive)
    material = scene.materials[number]
    albedo = albedo_at(scene, number, point, geometric, primitive, b1, b2)
    specular = specular_at(scene, number, point, primitive, b1, b2)
    shininess = np.float64(material[DIFFUSE_SHININESS, 3])
    along = normalized(direction)
    color = each_times(rgb(scene.ambient), albedo)
    for light in range(len(scene.lights)):
        lamp = scene.lights[light]
        at = light_at(lamp, point, along, shading)
        diffuse, highlight = reflected_at(lamp, at, albedo, specular, shininess)
        color = plus(color, plus(diffuse, highlight))
    return color


class LightAt(NamedTuple):
    """A light as seen from a point. to_light, half: the unit vectors l and h, 0 if undefined;
    distance: infinite for a directional light; n_dot_l, n_dot_h: cosines with the normal."""

    to_light: tuple[float, float, float]
    distance: float
    half: tuple[float, float, float]
    n_dot_l: float
    n_dot_h: float


@inlined
def light_at(lamp, point, along, normal):
    """Return the scene's light `lamp` as seen from a point with a unit normal.

    along: the unit vector from the viewer. The probe has the same terms
    (app/ui/explaining/shading.py).
    """
    to_light, distance = row(lamp, FIRST), np.inf
    if lamp[0, 3] != 0.0:
        to_light = minus(to_light, point)
        distance = length(to_light)
        to_light = times(1.0 / distance, to_light) if distance >= NEAREST_LIGHT else NOWHERE
    half = minus(to_light, along)
    size = length(half)
    half = times(1.0 / size, half) if size >= SHORTEST_HALF else NOWHERE
    return LightAt(to_light, distance, half, dot(normal, to_light), dot(normal, half))


@inlined
def reflected_at(lamp, at, albedo, specular, shininess):
    """Return (diffuse, highlight): the colours that a light adds."""
    if at.distance < NEAREST_LIGHT:
        return NOWHERE, NOWHERE
    color = row(lamp, SECOND)
    diffuse = times(max(0.0, at.n_dot_l), each_times(color, albedo))
    highlight = times(max(0.0, at.n_dot_h) ** shininess, each_times(color, specular))
    return diffuse, highlight


@inlined
def point_on(origin, direction, t):
    return (
        origin[0] + t * direction[0],
        origin[1] + t * direction[1],
        origin[2] + t * direction[2],
    )
