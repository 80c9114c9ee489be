"""The closest object along a ray, found by walking the BVH."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.trace.compile.compiled import inlined

from .intersect import box_ray, enter_box, hit_sphere, hit_triangle, sheared_ray
from .shade import passes
from .vectors import minus


class Tree(NamedTuple):
    """A BVH ready for traversal: its nodes, and the shapes in the order of its leaves.

    middle: float64 (3,), the point of the world that bounds and shapes are relative to.
    bounds: float32 (nodes, 6), low x, y, z, high x, y, z of node 0, the root, and the others.
    links: int32 (nodes, 2): (first child, 0) for an inner node, whose second child is the next
        node; (first shape, number of shapes) for a leaf.
    order: int32 (n,), the primitive number of each shape.
    shapes: float64 (n, 9), corners a, b, c of a triangle, or centre and radius of a sphere.
    triangles: primitives from this number on are spheres.
    stack_size: the number of nodes that can wait in a traversal.
    extent: the largest |coordinate| of bounds.
    scene: FlatScene, which decides what rays pass.
    """

    middle: np.ndarray
    bounds: np.ndarray
    links: np.ndarray
    order: np.ndarray
    shapes: np.ndarray
    triangles: int
    stack_size: int
    extent: float
    scene: FlatScene


@inlined
def closest_hit(tree, stack, origin, direction, t_min, t_max):
    """Return the closest hit along a ray: (t, primitive, b1, b2), or (inf, -1, 0, 0).

    origin, direction: (3,) float64, world space; the direction need not be unit length. A NaN
    direction hits nothing.
    A hit counts for t_min < t < t_max, 0 <= t_min. Of hits at the same t, the lowest primitive
    number wins in every tree. b1, b2: barycentrics of a triangle's second and third corner.
    stack: scratch of the calling thread, int32 and float64 (tree.stack_size,): the nodes that wait,
    and the parameters at which the ray enters them.
    Source: Pharr, Jakob and Humphreys, Physically Based Rendering, "Bounding Volume Hierarchies".
    """
    bounds, links, order = tree.bounds, tree.links, tree.order
    waiting, entered = stack
    closest, primitive, b1, b2 = t_max, np.int64(-1), 0.0, 0.0
    if len(order) == 0 or np.isnan(direction[0]):
        return np.inf, primitive, b1, b2
    from_middle = minus(origin, (tree.middle[0], tree.middle[1], tree.middle[2]))
    to_boxes = box_ray(from_middle, direction, tree.extent)
    to_triangles = sheared_ray(from_middle, direction)
    node, top = np.int64(0), 0
    while True:
        count = links[node, 1]
        if count == 0:
            # Enter the nearer child; the other waits.
            near = np.int64(links[node, 0])
            far = near + 1
            t_near = enter_box(bounds, near, to_boxes, t_min, closest)
            t_far = enter_box(bounds, far, to_boxes, t_min, closest)
            if t_far < t_near:
                near, far, t_near, t_far = far, near, t_far, t_near
            if t_near < np.inf:
                if t_far < np.inf:
                    waiting[top], entered[top] = far, t_far
                    top += 1
                node = near
                continue
        else:
            # Try each shape of the leaf.
            first = np.int64(links[node, 0])
            for i in range(first, first + count):
                number = np.int64(order[i])
                c1, c2 = 0.0, 0.0
                if number < tree.triangles:
                    t, c1, c2 = hit_triangle(tree.shapes, i, to_triangles)
                else:
                    t = hit_sphere(tree.shapes, i, from_middle, direction, t_min, t_max)
                if t_min < t and (t < closest or (t == closest and number < primitive)):
                    if number < tree.triangles and passes(tree.scene, direction, number, c1, c2):
                        continue
                    closest, primitive, b1, b2 = t, number, c1, c2
        # Take the last waiting node that begins before the closest hit.
        while True:
            if top == 0:
                return closest if primitive >= 0 else np.inf, primitive, b1, b2
            top -= 1
            if entered[top] <= closest:
                break
        node = np.int64(waiting[top])
