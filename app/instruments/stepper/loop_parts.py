"""The functions that the teaching renderers call: rays, objects, hits, colours, the canvas.

Each handles one ray and one object at a time. Pixels are (i, j) = (row, column), 0-based; vectors
are tuples of three floats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lucida.app.instruments.probe.crossings import Index
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, three
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.flat import FlatScene, flatten
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
    """An object of the scene: a sphere, or triangles. low, high: the corners of its box."""

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

    def __init__(self, scene: Scene, index: Index | None = None) -> None:
        scalar.load()
        self.scene = scene
        self.index = Index(flatten(scene)) if index is None else index
        self.flat: FlatScene = self.index.flat
        self.background: Color = three(self.flat.background)
        self.objects = tuple(self._object(number) for number, _ in scene.visible)

    def _object(self, number: int) -> Object:
        flat, sphere = self.flat, int(self.flat.object_sphere[number])
        first, count = flat.object_faces[number]
        used, faces = np.unique(flat.faces[first : first + count], return_inverse=True)
        vertices, faces = self.index.vertices[used], faces.reshape(-1, 3).astype(np.int64)
        if sphere >= 0:
            center, radius = flat.spheres[sphere, :3], float(flat.spheres[sphere, 3])
            low, high = center - radius, center + radius
        else:
            low, high = vertices.min(axis=0), vertices.max(axis=0)
        name = self.scene.objects[number].name or f"object {number}"
        return Object(number, name, sphere, vertices, faces, three(low), three(high), self.index)


class Canvas:
    """An array of colours, canvas[i, j], height by width. What is not yet set is NaN.

    log: everything that was ever written, (i, j, colour).
    """

    def __init__(self, size: Size, background: Color = (math.nan, math.nan, math.nan)) -> None:
        width, height = size
        self.background = background
        self.array = np.full((height, width, 3), background)
        self.log: list[tuple[int, int, Color]] = []

    def __setitem__(self, pixel: tuple[int, int], color: Color) -> None:
        self.array[pixel] = color
        self.log.append((*pixel, color))


class DepthBuffer:
    """For each pixel the t of the nearest hit so far; infinity in the beginning. log: as above."""

    def __init__(self, size: Size) -> None:
        width, height = size
        self.array = np.full((height, width), math.inf)
        self.log: list[tuple[int, int, float]] = []

    def __getitem__(self, pixel: tuple[int, int]) -> float:
        return float(self.array[pixel])

    def __setitem__(self, pixel: tuple[int, int], t: float) -> None:
        self.array[pixel] = t
        self.log.append((*pixel, t))


def viewing_ray(camera: Camera, x: float, y: float) -> ViewingRay:
    """The ray through a place on the image plane."""
    across = scalar.plus(scalar.times(x, camera.u), scalar.times(y, camera.v))
    if camera.is_parallel:
        origin = scalar.plus(camera.eye, across)
        direction = scalar.times(-1.0, camera.w)
    else:
        origin = camera.eye
        direction = scalar.minus(across, scalar.times(camera.distance, camera.w))
    return ViewingRay(origin, direction, *camera.t_range)


def intersect(object: Object, ray: ViewingRay) -> Hit:
    """The ray's nearest hit with one object, or MISS."""
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
    """The light that comes along the ray from the hit; the background's for MISS."""
    if hit is MISS:
        return scene.background
    point = scalar.point_on(ray.origin, ray.direction, hit.t)
    return light_at(scene, ray.direction, point, (hit.primitive, hit.b1, hit.b2))


def light_at(
    scene: Model, direction: Vector, point: Vector, where: tuple[int, float, float]
) -> Color:
    """The light that a point sends to who looks along the ray. where: on which triangle or
    sphere, and its barycentrics b1, b2 there."""
    flat = scene.flat
    geometric, normal = scalar.normals_at(flat, direction, point, *where)
    return three(scalar.color_at(flat, direction, point, geometric, normal, *where))


def meets_box(low: Vector, high: Vector, origin: Vector, direction: Vector) -> bool:
    """Return True if the ray's line meets a slightly enlarged box. Source: Kay and Kajiya's slabs,
    1986.
    """
    enter, leave = -math.inf, math.inf
    for k in range(3):
        slack = 1e-9 * (abs(low[k]) + abs(high[k]) + abs(origin[k]))
        to_low, to_high = low[k] - slack - origin[k], high[k] + slack - origin[k]
        if direction[k] == 0.0:
            if to_low > 0.0 or to_high < 0.0:
                return False
            continue
        first, second = to_low / direction[k], to_high / direction[k]
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
    return enter <= leave
