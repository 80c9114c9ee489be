"""The colour of a hit, term by term: ambient, then each light's diffuse and specular.

The shading model with each light's terms is the tracer's own (renderer/trace/pure_python.py). This
module only separates its terms and adds shadows. A test checks that the terms add up to the
renderers' colours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from lucida.renderer.camera.checks import Vector, three
from lucida.renderer.images.shared_numbers import NEAREST_LIGHT
from lucida.renderer.scene.flat import DIFFUSE_SHININESS, FlatScene
from lucida.renderer.scene.model import Color
from lucida.renderer.trace import pure_python as scalar

_NONE = (0.0, 0.0, 0.0)

# Takes a hit, the unit vector to a light, and the light's reach.
LitTest = Callable[["SurfaceHit", Vector, float], bool]


@dataclass(frozen=True)
class SurfaceHit:
    """The point at which a ray hits its nearest object, in world space.

    t: in units of the ray's `direction`.
    primitive: its number in the flat scene.
    b1, b2: barycentrics of a triangle's second and third corner.
    geometric: the surface's unit normal.
    normal: the one used for lighting, interpolated if the mesh is smooth, and bent if it would
    hardly face the viewer. Both normals are on the viewer's side.
    corner_normals: the interpolated normals as in the mesh; () if there are none.
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
        """True if the normal used for lighting differs from the geometric one."""
        return max(abs(a - b) for a, b in zip(self.geometric, self.normal, strict=True)) > 1e-9


@dataclass(frozen=True)
class Lamp:
    """The contribution of one light to a hit; colours are linear light.

    place: the position of a point light, else the unit vector towards the light. to_light, half:
    unit vectors l and h; half is 0 if the light is exactly behind. diffuse, specular: the terms as
    they are added, 0 if the light is shadowed (is_lit False).
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

    albedo: the diffuse reflectance k_d there, with checker, texture and vertex colours; specular:
    k_s.
    """

    albedo: Color
    specular: Color
    shininess: float
    ambient_light: Color
    ambient: Color
    lamps: tuple[Lamp, ...]
    color: Color


def hit_at(flat: FlatScene, origin: Any, direction: Any, crossing: Any) -> SurfaceHit:
    """Return the hit at a crossing (t, primitive, b1, b2) of a ray with the scene."""
    t, primitive, b1, b2 = crossing
    way = three(direction)
    point = scalar.point_on(three(origin), way, t)
    geometric, normal = scalar.normals_at(flat, way, point, primitive, b1, b2)
    number = int(scalar.object_of(flat.face_object, flat.sphere_object, primitive))
    return SurfaceHit(
        number,
        int(primitive),
        float(t),
        float(b1),
        float(b2),
        way,
        three(point),
        three(geometric),
        three(normal),
        _corner_normals(flat, primitive),
    )


def _corner_normals(flat: FlatScene, primitive: int) -> tuple[Vector, ...]:
    """Return the normals of a smooth triangle's corners; otherwise ()."""
    corners = flat.faces[primitive] if primitive < len(flat.faces) else ()
    normals = tuple(three(flat.normals[k]) for k in corners)
    return normals if all(map(any, normals)) else ()


def shade(flat: FlatScene, hit: SurfaceHit, is_lit: LitTest | None = None) -> Shading:
    """Return the colour at a hit, term by term. is_lit: reports shadows; None if there are none."""
    where = hit.primitive, hit.b1, hit.b2
    albedo = three(scalar.albedo_at(flat, hit.object, hit.point, hit.geometric, *where))
    specular = three(scalar.specular_at(flat, hit.object, hit.point, *where))
    shininess = float(flat.materials[hit.object, DIFFUSE_SHININESS, 3])
    ambient_light = three(flat.ambient)
    ambient = scalar.each_times(ambient_light, albedo)
    lamps = []
    color = ambient
    for number in range(len(flat.lights)):
        lamp = _lamp(flat, number, hit, albedo, specular, shininess, is_lit)
        if lamp is not None:
            lamps.append(lamp)
            color = scalar.plus(color, scalar.plus(lamp.diffuse, lamp.specular))
    return Shading(albedo, specular, shininess, ambient_light, ambient, tuple(lamps), three(color))


def _lamp(
    flat: FlatScene,
    number: int,
    hit: SurfaceHit,
    albedo: Color,
    specular: Color,
    shininess: float,
    is_lit: LitTest | None,
) -> Lamp | None:
    """Return one light's terms; None for a point light exactly at the hit."""
    light = flat.lights[number]
    at = scalar.light_at(light, hit.point, scalar.normalized(hit.direction), hit.normal)
    if at.distance < NEAREST_LIGHT:
        return None
    to_light, lit = three(at.to_light), True
    if is_lit is not None:
        lit = is_lit(hit, to_light, float(at.distance))
    terms = scalar.reflected_at(light, at, albedo, specular, shininess)
    diffuse, highlight = terms if lit else (_NONE, _NONE)
    return Lamp(
        number,
        bool(light[0, 3]),
        three(light[0]),
        three(light[1]),
        to_light,
        three(at.half),
        float(at.n_dot_l),
        float(at.n_dot_h),
        three(diffuse),
        three(highlight),
        lit,
    )
