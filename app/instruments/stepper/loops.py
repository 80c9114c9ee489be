"""The two algorithms as the lecture writes them: object order and image order, by their loops.

The stepper shows these functions' sources while they run, with the lecture's letters for their
words, which is why they have no types. The functions that they call are in loop_parts.py and
raster_parts.py. Object order is rasterization, as graphics cards do it. Both take a Model, a Camera
and a size (width, height), and return the same Canvas.
"""

from __future__ import annotations

from .loop_parts import MISS, Canvas, color_at, intersect, viewing_ray
from .raster_parts import box_around, edge, prepared, project, shade, t_of, triangles


def rasterization(scene, camera, size):
    """Loop over triangles, and over the pixels of each bounding box."""
    canvas, depth = prepared(scene, camera, size)
    for triangle in triangles(scene, camera):
        a, b, c = project(triangle, camera, size)
        rows, columns = box_around(a, b, c, size)
        for i in rows:
            for j in columns:
                q = (j + 0.5, i + 0.5)
                ea = edge(b, c, q) / edge(b, c, a)
                eb = edge(c, a, q) / edge(c, a, b)
                ec = edge(a, b, q) / edge(a, b, c)
                if min(ea, eb, ec) >= 0:
                    z = ea * a.z + eb * b.z + ec * c.z
                    t = t_of(z, triangle, ea, eb, ec)
                    if t < depth[i, j]:
                        depth[i, j] = t
                        canvas[i, j] = shade(triangle, ea, eb, ec)
    return canvas


def image_order(scene, camera, size):
    """Loop over pixels, and over objects for each."""
    width, height = size
    left, right, bottom, top = camera.viewport
    canvas = Canvas(size)
    for i in range(height):
        for j in range(width):
            x = left + (j + 0.5) / width * (right - left)
            y = top - (i + 0.5) / height * (top - bottom)
            ray = viewing_ray(camera, x, y)
            closest = MISS
            for object in scene.objects:
                hit = intersect(object, ray)
                if hit.t < closest.t:
                    closest = hit
            canvas[i, j] = color_at(scene, ray, closest)
    return canvas


PROGRAMS = rasterization, image_order
