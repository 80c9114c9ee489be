"""The functions that the stepped rasterization calls: clipping, projection, edge functions, depth,
shading.

Each handles one triangle at a time. Places in the image are (x, y) in pixels from its upper left
corner, y downwards: the centre of pixel (i, j), from 0, is (j + 0.5, i + 0.5).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import NEAREST, Camera
from lucida.renderer.camera.checks import Floats, three
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.model import Color
from lucida.renderer.scene.sampling import are_passed

from .loop_parts import Canvas, Model, Object, color_at, intersect, light_at, viewing_ray

FLAT = 1e-12  # times a triangle's extent: thinner ones are seen edge-on
ROUNDING_PX = 1e-6  # a centre that lies on the edge counts
WHOLE = np.eye(3)  # the shares of a triangle's own corners


class Corner(NamedTuple):
    """A triangle's corner in the image. z: the depth, which is linear there: 1/t in perspective, t
    in parallel projection."""

    x: float
    y: float
    z: float


@dataclass(frozen=True, eq=False)
class Triangle:
    """The part of a triangle that is in front of the camera: clipping may split one into two.

    primitive: its number in the flat scene. points (3, 3): its corners, world space. shares (3, 3):
    each corner's weights of the whole triangle's corners, with sum 1.
    """

    scene: Model
    camera: Camera
    object: Object
    primitive: int
    points: Floats
    shares: Floats

    @property
    def is_whole(self) -> bool:
        return bool((self.shares == WHOLE).all())

    def weights(self, ea: float, eb: float, ec: float) -> Floats:
        """Return the corners' shares at a point that is given by its edge functions. In perspective
        the near corners have a smaller share at the point than at its image."""
        shares = np.array([ea, eb, ec])
        if not self.camera.is_parallel:
            shares /= _in_camera(self.points, self.camera)[2]
            shares /= shares.sum()
        return shares

    def direction(self, point: Floats) -> Floats:
        """Return the direction of the viewing ray to a point."""
        return -np.array(self.camera.w) if self.camera.is_parallel else point - self.camera.eye


def prepared(scene: Model, camera: Camera, size: Size) -> tuple[Canvas, Canvas]:
    """Return a canvas in the colour of the background, and one of infinite depths. Spheres, which
    have no triangles, are already drawn into both, each pixel by its ray."""
    canvas, depth = Canvas(size, scene.background), Canvas(size, math.inf)
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
    """Yield the scene's triangles. One that reaches behind the eye or before near is clipped into
    one or two."""
    for object in scene.objects:
        first = int(scene.flat.object_faces[object.number, 0])
        t = _in_camera(object.vertices, camera)[2][object.faces]
        t_min = camera.t_range[0]
        if not camera.is_parallel:
            t_min = max(t_min, NEAREST * float(t.max(initial=0.0)))  # 1/t must be finite
        is_ahead = t > t_min
        is_whole = is_ahead.all(axis=1).tolist()
        for number in np.flatnonzero(is_ahead.any(axis=1)).tolist():
            points = object.vertices[object.faces[number]]
            if is_whole[number]:
                yield Triangle(scene, camera, object, first + number, points, WHOLE)
                continue
            rest = _clipped(np.column_stack([points, np.eye(3), t[number]]), t_min)
            for k in range(1, len(rest) - 1):  # a fan around the first corner
                fan = np.array([rest[0], rest[k], rest[k + 1]])
                yield Triangle(scene, camera, object, first + number, fan[:, :3], fan[:, 3:6])


def project(triangle: Triangle, camera: Camera, size: Size) -> tuple[Corner, Corner, Corner]:
    """Return the triangle's corners in the image."""
    x, y, t = _in_camera(triangle.points, camera)
    left, right, bottom, top = camera.viewport
    if not camera.is_parallel:
        x, y, t = x / t, y / t, 1 / t
    columns = (x - left) / (right - left) * size[0]
    rows = (top - y) / (top - bottom) * size[1]
    a, b, c = map(Corner, columns.tolist(), rows.tolist(), t.tolist())
    return a, b, c


def box_around(a: Corner, b: Corner, c: Corner, size: Size) -> tuple[range, range]:
    """Return the rows and columns of the pixels whose centres lie in the triangle's bounding box;
    none if the triangle is seen edge-on."""
    x, y = (a.x, b.x, c.x), (a.y, b.y, c.y)
    extent = max(max(x) - min(x), max(y) - min(y))
    columns = _centres_within(min(x), max(x), size[0])
    rows = _centres_within(min(y), max(y), size[1])
    if not (rows and columns and abs(edge(a, b, c)) > FLAT * extent * extent):
        return range(0), range(0)
    return rows, columns


def _centres_within(low: float, high: float, count: int) -> range:
    """Return the pixels, from 0 to count - 1, whose centres are between two places."""
    first = min(max(low - 0.5 - ROUNDING_PX, 0), count)
    end = min(max(high + 0.5 + ROUNDING_PX, 0), count)
    return range(math.ceil(first), math.floor(end))


def edge(a: Sequence[float], b: Sequence[float], q: Sequence[float]) -> float:
    """Return the edge function: twice the area of a, b, q. It is 0 on the line from a to b, and its
    sign differs on the two sides. Source: Pineda, "A Parallel Algorithm for Polygon
    Rasterization", 1988."""
    # The function from b to a is exactly the opposite, so neighbours have no gap between them.
    return (a[0] - q[0]) * (b[1] - q[1]) - (a[1] - q[1]) * (b[0] - q[0])


def t_of(z: float, triangle: Triangle, ea: float, eb: float, ec: float) -> float:
    """Return the ray parameter of a depth z in the image, at the point given by its edge functions;
    infinite beyond far, in a hole, and on an invisible back face."""
    weights, camera = triangle.weights(ea, eb, ec), triangle.camera
    t = z if camera.is_parallel else 1 / z
    passed = are_passed(
        triangle.scene.flat,
        np.array([triangle.primitive]),
        (weights @ triangle.shares)[None],
        triangle.direction(weights @ triangle.points),
    )
    return t if t < camera.t_range[1] and not passed[0] else math.inf


def shade(triangle: Triangle, ea: float, eb: float, ec: float) -> Color:
    """Return the light that comes from a point of the triangle, given by its edge functions in the
    image."""
    weights = triangle.weights(ea, eb, ec)
    point = weights @ triangle.points
    _, b1, b2 = (weights @ triangle.shares).tolist()
    direction = three(triangle.direction(point))
    return light_at(triangle.scene, direction, three(point), (triangle.primitive, b1, b2))


def _in_camera(points: Floats, camera: Camera) -> Floats:
    """Return x and y, in units of u and v, and the ray parameter of points (n, 3), as (3, n)."""
    # A sum of products rounds alike for any n; a product of matrices need not.
    found: Floats = (camera.camera_from_world[:3, None, :3] * (points - camera.eye)).sum(axis=2)
    found[2] /= -1.0 if camera.is_parallel else -camera.distance
    return found


def _clipped(corners: Floats, t_min: float) -> list[Floats]:
    """Return the part of a polygon beyond t_min. corners (n, m): the last number of each is t.

    Source: Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974.
    """
    kept = []
    for k, here in enumerate(corners):
        last = corners[k - 1]
        inside, was_inside = here[-1] > t_min, last[-1] > t_min
        if inside != was_inside:
            # Always from outside to inside, so two triangles with this edge get the same point.
            out, into = (last, here) if inside else (here, last)
            kept.append(out + (t_min - out[-1]) / (into[-1] - out[-1]) * (into - out))
        if inside:
            kept.append(here)
    return kept
