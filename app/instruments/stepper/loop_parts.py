"""The functions that the teaching renderers call: rays, objects, hits, colours, the canvas.

Each handles one ray and one object at a time. Pixels are (i, j) = (row, column), 0-based; vectors
are tuples of three floats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.instruments.probe.crossings import Index
from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, three
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Color, Scene
from lucida.renderer.trace import pure_python as scalar


class ViewingRay(NamedTuple):
    """r(t) = origin + t direction, for t_min < t < t_max."""

    origin: Vector
    direction: Vector
    t_min: float
    t_max: float


@dataclass(frozen=True, eq=False)
class Object:
    """An object of the scene: a sphere, or triangles. low, high: the corners of a box around it."""

    number: int
    name: str
    sphere: int  # its number in the flat scene, or -1
    vertices: Floats
    faces: np.ndarray
    low: Vector
    high: Vector
    index: Index


class Hit(NamedTuple):
    """The point where a ray meets an object: t, the triangle or sphere, and the place on it."""

    t: float
    object: Object | None = None
    primitive: int = -1
    b1: float = 0.0
    b2: float = 0.0


MISS = Hit(math.inf)


class Model:
    """A scene, prepared for the loops."""

    def __init__(self, scene: Scene) -> None:
        scalar.load()
        self.scene, self.flat = scene, flatten(scene)
        self.index = Index(self.flat)
        self.background: Color = three(self.flat.background)
        self.objects = tuple(self._object(number) for number, _ in scene.visible)

    def _object(self, number: int) -> Object:
        flat, sphere = self.flat, int(self.flat.object_sphere[number])
        first, count = flat.object_faces[number]
        used, faces = np.unique(flat.faces[first : first + count], return_inverse=True)
        vertices, faces = self.index.vertices[used], faces.reshape(-1, 3).astype(np.int64)
        low, high = vertices.min(axis=0, initial=math.inf), vertices.max(axis=0, initial=-math.inf)
        slack = 1e-9 * np.abs(vertices).max(initial=0.0)
        name = self.scene.objects[number].name or f"object {number}"
        low, high = three(low - slack), three(high + slack)
        return Object(number, name, sphere, vertices, faces, low, high, self.index)


class Canvas:
    """An array of colours or of depths, canvas[i, j], height by width.

    empty: the array before anything is written. log: everything that was ever written, (i, j,
    value).
    """

    def __init__(self, size: Size, empty: ArrayLike = (math.nan, math.nan, math.nan)) -> None:
        self.empty = np.full((size[1], size[0], *np.shape(empty)), empty)
        self.array = self.empty.copy()
        self.log: list[tuple[int, int, Any]] = []

    def __getitem__(self, pixel: Pixel) -> Any:
        return self.array[pixel]

    def __setitem__(self, pixel: Pixel, value: Any) -> None:
        self.array[pixel] = value
        self.log.append((*pixel, value))


def viewing_ray(camera: Camera, x: float, y: float) -> ViewingRay:
    """Return the ray through a place on the image plane."""
    across = scalar.plus(scalar.times(x, camera.u), scalar.times(y, camera.v))
    if camera.is_parallel:
        origin = scalar.plus(camera.eye, across)
        direction = scalar.times(-1.0, camera.w)
    else:
        origin = camera.eye
        direction = scalar.minus(across, scalar.times(camera.distance, camera.w))
    return ViewingRay(origin, direction, *camera.t_range)


def intersect(object: Object, ray: ViewingRay) -> Hit:
    """Return the ray's nearest hit with one object, or MISS."""
    origin, direction, t_min, t_max = ray
    flat = object.index.flat
    if object.sphere >= 0:
        t = float(scalar.hit_sphere(flat.spheres, object.sphere, origin, direction, t_min, t_max))
        return MISS if math.isnan(t) else Hit(t, object, len(flat.faces) + object.sphere)
    if not meets_box(object.low, object.high, origin, direction):
        return MISS
    found = object.index.mesh_hit(object.number, origin, direction, t_min, t_max)
    return MISS if found is None else Hit(found[0], object, *found[1:])


def color_at(scene: Model, ray: ViewingRay, hit: Hit) -> Color:
    """Return the light that comes along the ray from the hit; the background's for MISS."""
    if hit is MISS:
        return scene.background
    point = scalar.point_on(ray.origin, ray.direction, hit.t)
    return light_at(scene, ray.direction, point, (hit.primitive, hit.b1, hit.b2))


def light_at(
    scene: Model, direction: Vector, point: Vector, where: tuple[int, float, float]
) -> Color:
    """Return the light that a point sends towards the ray's origin. where: the triangle or sphere,
    and the point's barycentrics b1, b2 on it."""
    flat = scene.flat
    geometric, normal = scalar.normals_at(flat, direction, point, *where)
    return three(scalar.color_at(flat, direction, point, geometric, normal, *where))


def meets_box(low: Vector, high: Vector, origin: Vector, direction: Vector) -> bool:
    """Return True if the ray's line meets a box. Source: Kay and Kajiya's slabs, 1986."""
    enter, leave = -math.inf, math.inf
    for a, b, at, way in zip(low, high, origin, direction, strict=True):
        way = way or 1e-300  # along the face
        first, second = (a - at) / way, (b - at) / way
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
    return enter <= leave
