"""A scene prepared for tracing: flat arrays and BVH, and the kernel that runs on them.

The only way from the tracer's threads to compiled code: importing this module imports numba, so
only a Tracer's own thread imports it. Contains the simple method, one ray after another in float64,
and the choice between it and tiles (tiles/engine.py).
"""

from __future__ import annotations

from renderer.camera.camera import Camera
from renderer.scene.flat import flatten
from renderer.scene.model import Scene
from renderer.trace.arguments.image import Image, Rows, new_image
from renderer.trace.arguments.view import KernelView
from renderer.trace.bvh.binary import tree_of_scene
from renderer.trace.reference.kernel import trace_image
from renderer.trace.threads.thread_pool import Control, Team, cancel, new_control
from renderer.trace.tiles.engine import PacketEngine


def new_engine(
    scene: Scene, team: Team, method: str, shadows: bool, mirror_depth: int
) -> Engine | PacketEngine:
    """Return the scene prepared for one of tracer.METHODS; only packets have shadows and
    mirrors.
    """
    if method == "reference":
        return Engine(scene, team)
    return PacketEngine(scene, team, shadows, mirror_depth)


class Engine:
    """Traces images of one scene with a team of threads. Raises LucidaError (see flatten)."""

    def __init__(self, scene: Scene, team: Team) -> None:
        self._team = team
        self.set_scene(scene)

    def compile(self) -> None:
        """Compile the kernel by tracing an image that is already cancelled."""
        over = new_control()
        cancel(over)
        self.trace(Camera.canonical(), new_image((1, 1), ()), over)

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
