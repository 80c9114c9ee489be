"""The cost of an image, counted: the steps of both loops, the same numbers on every machine.

Counts for object order; renderer/trace/jobs/counting.py counts for image order.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.explaining.projected import ROUNDING_PX
from renderer.camera import Camera, Size
from renderer.errors import LucidaError
from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, Scene
from renderer.scene.positions import world_vertices


@dataclass(frozen=True)
class Work:
    """The steps of one image. triangles, pixels: of the scene and the image.

    Object order: each triangle is set up, and tests the pixels of its bounding box (tested).
    Image order: each pixel has a ray, which visits nodes of the tree and tests triangles there.
    """

    triangles: int
    pixels: int
    set_up: int
    tested: int
    rays: int
    nodes: int
    tests: int


def pixels_tested(scene: Scene, camera: Camera, size: Size) -> int:
    """Return how many pixel centres are in the bounding boxes of the triangles' projections,
    summed.

    Each triangle must be in front of the eye as a whole; raises LucidaError otherwise.
    """
    flat, (width, height) = flatten(scene), size
    matrix = camera.camera_from_world
    points = world_vertices(flat) @ matrix[:3, :3].T + matrix[:3, 3]
    if not camera.is_parallel:
        t = -points[:, 2] / camera.distance
        if (t <= 0).any():
            raise LucidaError("scene", "reaches behind the eye", "move the camera back")
        points = points / t[:, None]
    left, right, bottom, top = camera.viewport
    total = np.ones(len(flat.faces), np.int64)
    columns = (points[:, 0] - left) / (right - left) * width - 0.5
    rows = (top - points[:, 1]) / (top - bottom) * height - 0.5
    for centers, count in ((columns, width), (rows, height)):
        corners = centers[flat.faces]
        first = np.ceil(np.maximum(corners.min(axis=1) - ROUNDING_PX, 0))
        last = np.floor(np.minimum(corners.max(axis=1) + ROUNDING_PX, count - 1))
        total *= np.maximum(last - first + 1, 0).astype(np.int64)
    return int(total.sum())


class Counter:
    """Counts the work of images; caches one scene's tree. Use it on one thread: it loads the
    compiler.
    """

    def __init__(self) -> None:
        self._prepared: tuple[Scene, Any] | None = None

    def work(self, scene: Scene, camera: Camera, size: Size) -> Work:
        """Count a scene whose objects are all in front of the camera's eye; raises LucidaError
        otherwise.
        """
        from renderer.trace.jobs import counting

        tested = pixels_tested(scene, camera, size)
        if self._prepared is None or self._prepared[0] is not scene:
            self._prepared = scene, counting.counting_tree(scene)
        ray = counting.trace_counts(self._prepared[1], camera, size)
        set_up = sum(len(e.shape.faces) for _, e in scene.visible if isinstance(e.shape, Mesh))
        return Work(set_up, size[0] * size[1], set_up, tested, ray.rays, ray.nodes, ray.tests)
