"""How a hit's colour comes about, term by term: ambient, then each light's diffuse and specular.

Owns the terms and their names. The shading model is the tracer's own (renderer/pure_python.py):
here it is only taken apart; a test holds that the terms add up to what the renderers draw.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from renderer import pure_python as scalar
from renderer.camera import Vector
from renderer.scene.flat import DIFFUSE_SHININESS, SPECULAR_CHECKERED, FlatScene
from renderer.scene.model import Color

NEAREST_LIGHT = 1e-12  # a point light nearer than this gives no light
SHORTEST_HALF = 1e-6  # with a half vector shorter than this there is no highlight

LitTest = Callable[["Hit", Vector, float], bool]  # of a hit, the unit vector to a light, its reach


@dataclass(frozen=True)
class Hit:
    """Where a ray meets the object it sees. World space.

    t: in units of `direction`, the ray's. primitive: its number in the flat scene. b1, b2:
    barycentrics of a triangle's second and third corner. geometric: the surface's unit normal;
    normal: the one that light is computed with, interpolated where the mesh is smooth, and bent
    where it would hardly face the viewer. Both on the viewer's side. corner_normals: those that
    are interpolated, as the mesh has them; () where none are.
    """

    object: int
    primitive: int
    t: float
    b1: float
    b2: float
    direction: Vector
    point: Vector
    geometric: Vector
    normal: Vector
    corner_normals: tuple[Vector, ...] = ()

    @property
    def has_own_normal(self) -> bool:
        """Whether the two normals differ: the light has one of its own."""
        return max(abs(a - b) for a, b in zip(self.geometric, self.normal, strict=True)) > 1e-9


@dataclass(frozen=True)
class Lamp:
    """What one light gives to a hit; colours are linear light.

    place: the position of a point light, else the unit vector towards the light. to_light, half:
    unit vectors l and h; half is 0 where the light is exactly behind. diffuse, specular: the terms
    as they are added, 0 where the light is shadowed (is_lit False).
    """

    number: int
    is_point: bool
    place: Vector
    color: Color
    to_light: Vector
    half: Vector
    n_dot_l: float
    n_dot_h: float
    diffuse: Color
    specular: Color
    is_lit: bool


@dataclass(frozen=True)
class Shading:
    """The light that a hit sends to the viewer: color = ambient + the lamps' terms.

    albedo: the diffuse reflectance k_d there, with checker and vertex colours; specular: k_s.
    """

    albedo: Color
    specular: Color
    shininess: float
    ambient_light: Color
    ambient: Color
    lamps: tuple[Lamp, ...]
    color: Color


def hit_at(flat: FlatScene, origin: Any, direction: Any, crossing: Any) -> Hit:
    """The hit at a crossing (t, primitive, b1, b2) of a ray with the scene."""
    t, primitive, b1, b2 = crossing
    way = _three(direction)
    point = scalar.point_on(_three(origin), way, t)
    geometric, normal = scalar.normals_at(flat, way, point, primitive, b1, b2)
    number = int(scalar.object_of(flat.face_object, flat.sphere_object, primitive))
    return Hit(
        number,
        int(primitive),
        float(t),
        float(b1),
        float(b2),
        way,
        _three(point),
        _three(geometric),
        _three(normal),
        _corner_normals(flat, primitive),
    )


def _corner_normals(flat: FlatScene, primitive: int) -> tuple[Vector, ...]:
    """Of a triangle that is smooth; otherwise ()."""
    corners = flat.faces[primitive] if primitive < len(flat.faces) else ()
    normals = tuple(_three(flat.normals[k]) for k in corners)
    return normals if all(map(any, normals)) else ()


def shade(flat: FlatScene, hit: Hit, is_lit: LitTest | None = None) -> Shading:
    """The colour at a hit, taken apart. is_lit: tells shadows; None: there are none."""
    material = flat.materials[hit.object]
    albedo = _three(
        scalar.albedo_at(flat, hit.object, hit.point, hit.geometric, hit.primitive, hit.b1, hit.b2)
    )
    specular = _three(material[SPECULAR_CHECKERED])
    shininess = float(material[DIFFUSE_SHININESS, 3])
    ambient_light = _three(flat.ambient)
    ambient = scalar.each_times(ambient_light, albedo)
    lamps = []
    color = ambient
    for number in range(len(flat.lights)):
        lamp = _lamp(flat, number, hit, albedo, specular, shininess, is_lit)
        if lamp is not None:
            lamps.append(lamp)
            color = scalar.plus(color, scalar.plus(lamp.diffuse, lamp.specular))
    return Shading(albedo, specular, shininess, ambient_light, ambient, tuple(lamps), _three(color))


def _lamp(
    flat: FlatScene,
    number: int,
    hit: Hit,
    albedo: Color,
    specular: Color,
    shininess: float,
    is_lit: LitTest | None,
) -> Lamp | None:
    """One light's terms; None for a point light that lies in the hit itself."""
    place, color = _three(flat.lights[number, 0]), _three(flat.lights[number, 1])
    is_point, to_light, reach = bool(flat.lights[number, 0, 3]), place, np.inf
    if is_point:
        to_light = scalar.minus(place, hit.point)
        reach = scalar.length(to_light)
        if reach < NEAREST_LIGHT:
            return None
        to_light = scalar.times(1.0 / reach, to_light)
    half: Vector = scalar.minus(to_light, scalar.normalized(hit.direction))
    size = scalar.length(half)
    half = scalar.times(1.0 / size, half) if size >= SHORTEST_HALF else (0.0, 0.0, 0.0)
    n_dot_l, n_dot_h = scalar.dot(hit.normal, to_light), scalar.dot(hit.normal, half)
    lit = is_lit is None or is_lit(hit, _three(to_light), float(reach))
    diffuse = specularly = (0.0, 0.0, 0.0)
    if lit:
        diffuse = _three(scalar.times(max(0.0, n_dot_l), scalar.each_times(albedo, color)))
        highlight = max(0.0, n_dot_h) ** shininess
        specularly = _three(scalar.times(highlight, scalar.each_times(specular, color)))
    return Lamp(
        number,
        is_point,
        place,
        color,
        _three(to_light),
        _three(half),
        float(n_dot_l),
        float(n_dot_h),
        diffuse,
        specularly,
        lit,
    )


def _three(value: Any) -> Vector:
    x, y, z = float(value[0]), float(value[1]), float(value[2])
    return x, y, z
