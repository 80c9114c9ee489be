"""The stepper's part of the outside view: the current pixel, its ray, the current triangle."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from lucida.app.instruments.outside.diagram import Dot, Item, Segments, polyline
from lucida.app.instruments.outside.frustum import image_point
from lucida.app.instruments.outside.pixel_drawing import pixel_square
from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .loop_parts import ViewingRay
from .model import Moment
from .programs import Hits


def run_items(camera: Camera, size: Size, moments: tuple[Moment, ...], end: float) -> list[Item]:
    """Return the items that show runs at their moments.

    end: the ray parameter at which a ray that hits nothing ends.
    """
    items: list[Item] = []
    for moment in moments:
        if moment.triangle is not None:
            sides = polyline(np.array(moment.triangle.points), True)
            items.append(Segments("triangle", "ray", sides, 2.5, layer=3))
        if moment.box is not None and moment.box[0] and moment.box[1]:
            items.append(_plane_box(camera, size, moment.box))
        if moment.pixel is not None:
            items += pixel_square(camera, size, moment.pixel, 0.3, 2.0)
        if moment.ray is not None:
            hits = (moment.t,) if moment.t < math.inf else ()
            items += _ray(moment.ray, min(moment.t, end), hits, moment.t)
    return items


def traced_items(
    hits: Hits, camera: Camera, pixel: Pixel | None, part: float, end: float
) -> list[Item]:
    """Return a pixel, its ray and its hits.

    part: as in StepperOptions.parts. end: as in run_items().
    """
    if pixel is None:
        return []
    number = pixel[0] * hits.size[0] + pixel[1]
    t = hits.t[:, number]
    closest = float(t.min(initial=math.inf))
    reach = min(closest, end) if part >= 2 else end * min(part, 1.0)
    found = t[t <= (closest if part > 3 else end * (part - 1))]
    ray = _ray(hits.rays[number], reach, found[found < math.inf].tolist(), closest)
    return [*pixel_square(camera, hits.size, pixel, 0.3, 2.0), *ray]


def _ray(ray: ViewingRay, reach: float, hits: Iterable[float], closest: float) -> list[Item]:
    """Return a ray and its hits, the closest one larger."""
    origin, direction = np.array(ray.origin), np.array(ray.direction)
    segment = np.stack([origin, origin + reach * direction])[None]
    dots = (Dot("hit", "mark", origin + t * direction, 6.0 if t == closest else 4.0) for t in hits)
    return [Segments("ray", "ray", segment, 2.5, layer=3), *dots]


def _plane_box(camera: Camera, size: Size, box: tuple[range, range]) -> Segments:
    """Return a bounding box in pixels, on the image plane."""
    rows, columns = box
    i = np.array([rows.start, rows.start, rows.stop, rows.stop]) - 0.5
    j = np.array([columns.start, columns.stop, columns.stop, columns.start]) - 0.5
    points = image_point(camera, *camera.image_point(i, j, size))
    return Segments("bounding box", "extra", polyline(points, True), 2.0, on_plane=True, layer=2)
