"""The functions that the stepped rasterization calls: clipping, projection, edge functions, depth,
shading.

Each handles one triangle at a time. Places in the image are (x, y) in pixels from its upper left
corner, y downwards: the centre of pixel (i, j), from 0, is (j + 0.5, i + 0.5).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.app.instruments.stepper.loop_parts import (
    Canvas,
    DepthBuffer,
    Model,
    Object,
    color_at,
    intersect,
    light_at,
    viewing_ray,
)
from lucida.renderer.camera.camera import NEAREST, Camera
from lucida.renderer.camera.checks import Floats, Vector
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.model import Color
from lucida.renderer.scene.sampling import on_triangles, opacity
from lucida.renderer.trace import pure_python as scalar

WHOLE: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
FLAT = 1e-12  # of a triangle's extent: thinner ones are seen edge-on


ROUNDING_PX = 1e-6  # a centre that lies on the edge counts


class Corner(NamedTuple):
    """A triangle's corner in the image. z: what is linear there: 1/t in perspective, t in parallel
    projection."""

    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True, eq=False)
class Triangle:
    """The part of a triangle that the camera can see: clipping makes up to three of one.

    primitive: its number in the flat scene. points: its corners, world space. shares: the weights
    of the whole triangle's corners at each of them, with sum 1.
    """

    scene: Model
    camera: Camera
    object: Object
    primitive: int
    points: tuple[Vector, ...]
    shares: tuple[Vector, ...] = WHOLE


def prepared(scene: Model, camera: Camera, size: Size) -> tuple[Canvas, DepthBuffer]:
    """The canvas in the colour of the background, and infinite depths; then what has no triangles:
    spheres, each pixel by its ray."""
    canvas, depth = Canvas(size, scene.background), DepthBuffer(size)
    spheres = [object for object in scene.objects if object.sphere >= 0]
    for i, j in np.ndindex(size[1], size[0] if spheres else 0):
        x, y = (float(place) for place in camera.image_point(i, j, size))
        ray = viewing_ray(camera, x, y)
        for object in spheres:
            hit = intersect(object, ray)
            if hit.t < depth[i, j]:
                depth[i, j] = hit.t
                canvas[i, j] = color_at(scene, ray, hit)
    return canvas, depth


def triangles(scene: Model, camera: Camera) -> Iterator[Triangle]:
    """The scene's triangles, one after another. What lies behind the eye, before near or beyond far
    is cut off: of a triangle that reaches there, the rest comes as one to three triangles."""
    for object in scene.objects:
        if object.sphere >= 0:
            continue
        first = int(scene.flat.object_faces[object.number, 0])
        t = _parameters(object.vertices, camera)
        t_min, t_max = camera.t_range
        t_low, t_high = t[object.faces].min(axis=1), t[object.faces].max(axis=1)
        if not camera.is_parallel and t_low.min() <= 0:
            t_min = max(t_min, NEAREST * float(t_high.max()))  # where 1/t is still a number
        whole = (t_low > t_min) & (t_high < t_max)
        wanted = (t_high > t_min) & (t_low < t_max)
        if scene.flat.single_sided[object.number]:
            wanted &= ~_backs(scene.flat, object, camera)
        for number in np.flatnonzero(wanted).tolist():
            face = object.faces[number]
            points = tuple(_vector(point) for point in object.vertices[face].tolist())
            if whole[number]:
                yield Triangle(scene, camera, object, first + number, points)
                continue
            corners = list(zip(points, WHOLE, t[face].tolist(), strict=True))
            rest = _cut(_cut(corners, t_min, 1.0), t_max, -1.0)
            for k in range(1, len(rest) - 1):  # a fan around the first corner
                fan = rest[0], rest[k], rest[k + 1]
                points, shares = tuple(one[0] for one in fan), tuple(one[1] for one in fan)
                yield Triangle(scene, camera, object, first + number, points, shares)


def _backs(flat: FlatScene, object: Object, camera: Camera) -> NDArray[np.bool_]:
    """Return which of an object's triangles show their back, in the object's own space."""
    a, b, c = (object.vertices[object.faces[:, k]] for k in range(3))
    way = -np.asarray(camera.w) if camera.is_parallel else a - camera.eye
    side = np.linalg.det(flat.world_from_object[object.number, :3, :3])
    backs: NDArray[np.bool_] = side * (np.cross(b - a, c - a) * way).sum(axis=1) > 0
    return backs


def project(triangle: Triangle, camera: Camera, size: Size) -> tuple[Corner, Corner, Corner]:
    """Return the triangle's corners in the image."""
    a, b, c = (_corner(point, camera, size) for point in triangle.points)
    return a, b, c


def box_around(a: Corner, b: Corner, c: Corner, size: Size) -> tuple[range, range]:
    """The rows and columns of the pixels whose centres lie in the triangle's bounding box; none of
    a triangle that is seen from its edge."""
    x, y = (a.x, b.x, c.x), (a.y, b.y, c.y)
    extent = max(max(x) - min(x), max(y) - min(y))
    columns = whole_within(min(x) - 0.5, max(x) - 0.5, size[0])
    rows = whole_within(min(y) - 0.5, max(y) - 0.5, size[1])
    if not (rows and columns and abs(edge(a, b, c)) > FLAT * extent * extent):
        return range(0), range(0)
    return rows, columns


def whole_within(low: float, high: float, count: int) -> range:
    """Return the whole numbers from low to high that are within 0 to count - 1."""
    first = math.ceil(min(max(low - ROUNDING_PX, 0.0), count))
    last = math.floor(max(min(high + ROUNDING_PX, count - 1.0), -1.0))
    return range(first, max(first, last + 1))


def edge(a: Sequence[float], b: Sequence[float], q: Sequence[float]) -> float:
    """The edge function: 0 on the line from a to b, of one sign on either side of it. Twice the
    area of a, b, q. Source: Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988."""
    # Of b to a it is the same with the other sign, to the last bit: no gap between neighbours.
    return (a[0] - q[0]) * (b[1] - q[1]) - (a[1] - q[1]) * (b[0] - q[0])


def t_of(z: float, triangle: Triangle, ea: float, eb: float, ec: float) -> float:
    """Return the ray parameter of a depth z in the image, of the point given by its edge functions;
    infinite where the triangle has a hole."""
    flat, number = triangle.scene.flat, triangle.object.number
    if flat.textures[number, 1, 1] >= 0:  # its texture cuts holes
        weights = _weights(triangle, ea, eb, ec) @ np.array(triangle.shares)
        place = on_triangles(flat, np.array([triangle.primitive]), weights[None])
        if opacity(flat, np.array([number]), place)[0, 0] < 0:
            return math.inf
    return z if triangle.camera.is_parallel else 1 / z


def shade(triangle: Triangle, ea: float, eb: float, ec: float) -> Color:
    """The light that comes from a point of the triangle, given by its edge functions in the
    image."""
    camera, shares = triangle.camera, _weights(triangle, ea, eb, ec)
    point = _vector((shares @ triangle.points).tolist())
    _, b1, b2 = _vector((shares @ triangle.shares).tolist())
    back = scalar.times(-1.0, camera.w)
    direction = back if camera.is_parallel else scalar.minus(point, camera.eye)
    return light_at(triangle.scene, direction, point, (triangle.primitive, b1, b2))


def _weights(triangle: Triangle, ea: float, eb: float, ec: float) -> Floats:
    """Return the corners' shares in a point. In perspective the near corners have a smaller share
    in the point than in its image."""
    shares = np.array([ea, eb, ec])
    if not triangle.camera.is_parallel:
        shares /= _parameters(np.array(triangle.points), triangle.camera)
        shares /= shares.sum()
    return shares


@lru_cache(maxsize=4)
def _inverse(camera: Camera) -> tuple[Vector, Vector, Vector]:
    """The rows of the basis's inverse."""
    across, up, back = (_vector(row) for row in camera.camera_from_world[:3, :3].tolist())
    return across, up, back


def _parameters(points: Floats, camera: Camera) -> Floats:
    """The ray parameters of points (n, 3), each by the same arithmetic as _corner's."""
    x, y, z = (points - camera.eye).T
    back = _inverse(camera)[2]
    unit = 1.0 if camera.is_parallel else camera.distance
    t: Floats = -(back[0] * x + back[1] * y + back[2] * z) / unit
    return t


def _corner(point: Vector, camera: Camera, size: Size) -> Corner:
    offset = scalar.minus(point, camera.eye)
    x, y, z = (scalar.dot(row, offset) for row in _inverse(camera))
    t = -z / (1.0 if camera.is_parallel else camera.distance)
    left, right, bottom, top = camera.viewport
    if not camera.is_parallel:
        x, y = x / t, y / t
    return Corner(
        (x - left) / (right - left) * size[0],
        (top - y) / (top - bottom) * size[1],
        t if camera.is_parallel else 1 / t,
    )


def _cut(
    corners: list[tuple[Vector, Vector, float]], bound: float, side: float
) -> list[tuple[Vector, Vector, float]]:
    """Return the part of a polygon of (point, shares, t) beyond t = bound (side 1) or before it
    (-1).

    Source: Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974.
    """
    kept = []
    for k, here in enumerate(corners):
        last = corners[k - 1]
        inside, was_inside = side * (here[2] - bound) > 0, side * (last[2] - bound) > 0
        if inside != was_inside:
            # Always from without to within: two triangles with this edge get the same point.
            out, into = (last, here) if inside else (here, last)
            part = (bound - out[2]) / (into[2] - out[2])
            kept.append((_between(out[0], into[0], part), _between(out[1], into[1], part), bound))
        if inside:
            kept.append(here)
    return kept


def _between(a: Vector, b: Vector, part: float) -> Vector:
    return scalar.plus(a, scalar.times(part, scalar.minus(b, a)))


def _vector(values: Sequence[float]) -> Vector:
    x, y, z = values
    return x, y, z
