"""How much the tracer's plain traversal does for an image: counted, not timed.

Owns the counting kernel. It walks with traverse.py's own code, compiled a second time with counts:
one ray after another through the binary tree, as the method "reference". Packets walk a tree of 16
children a node, and visit fewer nodes for many rays at once.
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
    """rays: one a pixel. nodes: of the tree, each as often as a ray visits it. tests: of a ray with
    a triangle or a sphere."""

    rays: int
    nodes: int
    tests: int


def counting_tree(scene: Scene) -> Tree:
    """The scene's tree, built by one thread: the same on every machine. Raises as flatten."""
    return tree_of_scene(flatten(scene), Team(1))


def trace_counts(tree: Tree, camera: Camera, size: Size) -> TraceCounts:
    """What the closest hits of all viewing rays of an image (width, height) take."""
    counts = np.zeros(2, np.int64)
    _count(KernelView.of(camera), tree, *size, counts)
    return TraceCounts(size[0] * size[1], *counts.tolist())


@kernel
def _count(view, tree, width, height, counts):
    stack = np.empty(tree.stack_size, np.int32), np.empty(tree.stack_size, np.float64)
    for i in range(height):
        for j in range(width):
            origin, direction = viewing_ray(view, i, j, width, height)
            closest_hit(tree, stack, origin, direction, view.t_min, view.t_max, counts)
