"""Counting, not timing, the work of the tracer's simple traversal for an image.

The counting kernel is the code of traverse.py, compiled a second time with counters: one ray after
another through the binary tree, as in the method "reference". Packets traverse a tree with 16
children per node, and visit fewer nodes, each for many rays at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from renderer.camera import Camera, Size
from renderer.scene.flat import flatten
from renderer.scene.model import Scene
from renderer.trace.arguments.view import KernelView
from renderer.trace.bvh.binary import tree_of_scene
from renderer.trace.compile.compiled import kernel
from renderer.trace.scalar.kernel import viewing_ray
from renderer.trace.scalar.traverse import Tree, closest_hit
from renderer.trace.threads.thread_pool import Team


class TraceCounts(NamedTuple):
    """The work for an image.

    rays: one per pixel. nodes: visits of a ray to a node. tests: of a ray with a triangle or a
    sphere.
    """

    rays: int
    nodes: int
    tests: int


def counting_tree(scene: Scene) -> Tree:
    """Return the scene's tree, built by one thread: the same on every machine. Raises like
    flatten().
    """
    return tree_of_scene(flatten(scene), Team(1))


def trace_counts(tree: Tree, camera: Camera, size: Size) -> TraceCounts:
    """Return the work for the closest hits of all viewing rays of an image (width, height)."""
    counts = np.zeros(2, np.int64)
    _count(KernelView.of(camera, size), tree, *size, counts)
    return TraceCounts(size[0] * size[1], *counts.tolist())


@kernel
def _count(view, tree, width, height, counts):
    stack = np.empty(tree.stack_size, np.int32), np.empty(tree.stack_size, np.float64)
    for i in range(height):
        for j in range(width):
            origin, direction = viewing_ray(view, i, j, width, height)
            closest_hit(tree, stack, origin, direction, view.t_min, view.t_max, counts)
