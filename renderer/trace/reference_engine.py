"""A scene prepared for the simple method, which traces one ray after another in float64.

The interface is that of tiles/engine.py.
"""

from __future__ import annotations

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene

from .arguments.image import Image, Rows, new_image
from .arguments.view import KernelView
from .bvh.binary import tree_of_scene
from .reference.kernel import trace_image
from .threads.thread_pool import Control, Team, cancelled_control


class ReferenceEngine:
    """An engine that traces images of one scene ray by ray. Raises LucidaError (see flatten)."""

    def __init__(self, scene: Scene, team: Team) -> None:
        self._team = team
        self.set_scene(scene)

    def compile(self) -> None:
        """Compile the kernel by tracing an image that is already cancelled."""
        self.trace(Camera.canonical(), new_image((1, 1), ()), cancelled_control())

    def set_scene(self, scene: Scene) -> None:
        """Prepare another scene."""
        self._flat = flatten(scene)
        self._tree = tree_of_scene(self._flat, self._team)

    def trace(
        self, camera: Camera, image: Image, control: Control, rows: Rows | None = None
    ) -> None:
        """Fill the image; return early if cancelled. Unfinished blocks stay unmarked in
        image.finished. rows: all of the image's.
        """
        view = KernelView.of(camera, (image.width, image.height))
        blocks = image.finished.size
        self._team.run(trace_image, view, self._flat, self._tree, image, control, size=blocks)
