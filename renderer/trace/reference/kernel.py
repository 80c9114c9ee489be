"""The image-order kernel, which traces the image pixel by pixel, along one viewing ray each.

Each thread of a team calls trace_image() with the same arguments; they share the blocks.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.arguments.image import BLOCK
from lucida.renderer.trace.compile.compiled import inlined, kernel
from lucida.renderer.trace.threads.atomic import count_done, is_cancelled, take_next

from .shade import color_at, corners_of, normals_at, object_of, point_on, rgb, turned
from .traverse import closest_hit
from .vectors import cross, dot, minus, row


@kernel
def trace_image(view, scene, tree, image, control):
    """Trace blocks of pixels until none are left, or the control array requests a stop.

    view: KernelView. scene: FlatScene. tree: Tree. image: Image, written.
    control: see thread_pool.py; its numbers are those of the blocks, row by row.
    """
    waiting = np.empty(tree.stack_size, np.int32)
    entered = np.empty(tree.stack_size, np.float64)
    _trace_blocks(view, scene, tree, (waiting, entered), image, control)


@inlined
def _trace_blocks(view, scene, tree, stack, image, control):
    height, width = image.height, image.width
    rows, columns = image.finished.shape
    while True:
        block = take_next(control)
        if block >= rows * columns:
            return
        top, left = block // columns * BLOCK, block % columns * BLOCK
        for i in range(top, min(top + BLOCK, height)):
            for j in range(left, min(left + BLOCK, width)):
                if is_cancelled(control):
                    return
                # Generate the viewing ray.
                origin, direction = viewing_ray(view, i, j, width, height)
                # Find the closest object.
                hit = closest_hit(tree, stack, origin, direction, view.t_min, view.t_max)
                # Determine the colour.
                write_pixel(scene, image, i, j, origin, direction, hit)
        image.finished[block // columns, block % columns] = 1
        count_done(control)


@inlined
def viewing_ray(view, i, j, width, height):
    """Return origin and direction of the ray through pixel (i, j)'s centre, like Camera.ray()."""
    if view.directions.size > 0:
        seen = view.directions
        return view.eye, (seen[i, j, 0], seen[i, j, 1], seen[i, j, 2])
    x = view.left + (j + 0.5) / width * (view.right - view.left)
    y = view.top - (i + 0.5) / height * (view.top - view.bottom)
    u, v, back, eye = view.u, view.v, view.back, view.eye
    across = (x * u[0] + y * v[0], x * u[1] + y * v[1], x * u[2] + y * v[2])
    if view.parallel:
        origin = (eye[0] + across[0], eye[1] + across[1], eye[2] + across[2])
        return origin, (-back[0], -back[1], -back[2])
    return eye, (across[0] - back[0], across[1] - back[1], across[2] - back[2])


@inlined
def write_pixel(scene, image, i, j, origin, direction, hit):
    """Write the channels that the image has, for a hit (t, primitive, b1, b2) or none."""
    t, primitive, b1, b2 = hit
    if image.has_depth:
        image.depth[i, j] = t
    if image.has_primitive:
        image.primitive[i, j] = primitive
    if image.has_id:
        image.id[i, j] = (
            object_of(scene.face_object, scene.sphere_object, primitive) if primitive >= 0 else -1
        )
    if not (image.has_normal or image.has_color):
        return
    normal, color = (0.0, 0.0, 0.0), rgb(scene.background)
    if primitive >= 0:
        point = point_on(origin, direction, t)
        geometric, normal = normals_at(scene, direction, point, primitive, b1, b2)
        if image.has_color:
            color = color_at(scene, direction, point, geometric, normal, primitive, b1, b2)
    if image.has_normal:
        image.normal[i, j, 0], image.normal[i, j, 1], image.normal[i, j, 2] = normal
    if image.has_color:
        image.color[i, j, 0], image.color[i, j, 1], image.color[i, j, 2] = color


@kernel
def shade_rays(scene, origins, directions, t, primitives, light):
    """Write the light along n rays with known hits, without shadows and mirrors.

    origins, directions, light: (n, 3). t, primitives: (n,), as from closest_hits().
    """
    for i in range(len(t)):
        color, primitive = rgb(scene.background), np.int64(primitives[i])
        if primitive >= 0:
            direction = row(directions, i)
            point = point_on(row(origins, i), direction, np.float64(t[i]))
            b1, b2 = _weights(scene, point, primitive)
            geometric, normal = normals_at(scene, direction, point, primitive, b1, b2)
            color = color_at(scene, direction, point, geometric, normal, primitive, b1, b2)
        light[i, 0], light[i, 1], light[i, 2] = color


@inlined
def _weights(scene, point, primitive):
    """Return a point's barycentrics of a triangle's second and third corner; 0, 0 on a sphere."""
    if primitive >= len(scene.faces):
        return 0.0, 0.0
    i, j, k = corners_of(scene.faces, primitive)
    matrix = scene.world_from_object[scene.face_object[primitive]]
    a = row(scene.vertices, i)
    to_b = turned(matrix, minus(row(scene.vertices, j), a))
    to_c = turned(matrix, minus(row(scene.vertices, k), a))
    at_a = turned(matrix, a)
    place = (matrix[0, 3] + at_a[0], matrix[1, 3] + at_a[1], matrix[2, 3] + at_a[2])
    inside, across = minus(point, place), cross(to_b, to_c)
    size = dot(across, across)
    return dot(cross(inside, to_c), across) / size, dot(cross(to_b, inside), across) / size
