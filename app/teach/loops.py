"""The two algorithms as the lecture writes them: rasterization and ray tracing, by their loops.

Owns the loops, and nothing else: the stepper shows these functions' sources while they run, which
is why they carry no types. What they call is in loop_parts.py. Only the order of the loops differs,
and what that makes of the test. Both take a Model, a Camera and a size (width, height), and give a
Canvas.
"""

from __future__ import annotations

from app.teach.loop_parts import (
    MISS,
    Canvas,
    DepthBuffer,
    bounding_box,
    color_at,
    intersect,
    viewing_ray,
)


def object_order(scene, camera, size):
    """For each object, for each pixel."""
    W, H = size
    left, right, bottom, top = camera.viewport
    canvas = Canvas(size, scene.background)
    depth = DepthBuffer(size)
    for object in scene.objects:
        rows, columns = bounding_box(object, camera, size)
        for i in rows:
            for j in columns:
                u = left + (j + 0.5) / W * (right - left)
                v = top - (i + 0.5) / H * (top - bottom)
                ray = viewing_ray(camera, u, v)
                hit = intersect(object, ray)
                if hit.t < depth[i, j]:
                    depth[i, j] = hit.t
                    canvas[i, j] = color_at(scene, ray, hit)
    return canvas


def image_order(scene, camera, size):
    """For each pixel, for each object."""
    W, H = size
    left, right, bottom, top = camera.viewport
    canvas = Canvas(size)
    for i in range(H):
        for j in range(W):
            u = left + (j + 0.5) / W * (right - left)
            v = top - (i + 0.5) / H * (top - bottom)
            ray = viewing_ray(camera, u, v)
            closest = MISS
            for object in scene.objects:
                hit = intersect(object, ray)
                if hit.t < closest.t:
                    closest = hit
            canvas[i, j] = color_at(scene, ray, closest)
    return canvas
