"""A scene prepared for packets: flat arrays and trees, and the packet kernel run on them.

Does what engine.py's Engine does, many times faster. Knows nothing of tasks and threads' ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.scene.flat import flatten
from renderer.scene.model import Scene
from renderer.trace.control import Control, cancel, new_control
from renderer.trace.image import Image, new_image
from renderer.trace.instances import Instances
from renderer.trace.packet_effects import effects_of
from renderer.trace.packet_kernel import trace_packets
from renderer.trace.packet_view import packet_view
from renderer.trace.rays import any_hits, closest_hits
from renderer.trace.team import Team
from renderer.trace.view import View

Rays = NDArray[np.float32]


class PacketEngine:
    """Traces images of one scene by a team of threads. Raises LucidaError (see flatten).

    shadows, mirror_depth: see packet_effects.py.
    """

    def __init__(
        self, scene: Scene, team: Team, shadows: bool = False, mirror_depth: int = 0
    ) -> None:
        self._effects = shadows, mirror_depth
        self._team = team
        self._scene = scene
        self._flat = flatten(scene)
        self.instances = Instances(scene, self._flat, team)
        # Compile, by an image that is over before it begins.
        over = new_control()
        cancel(over)
        self.trace(View.of(Camera.canonical()), new_image((1, 1), ()), over)

    def set_scene(self, scene: Scene) -> None:
        """Follows a changed scene; unchanged meshes (the same arrays) keep their trees."""
        self._flat = flatten(scene, (self._scene, self._flat))
        self._scene = scene
        self.instances.update(scene, self._flat)

    def closest_hits(
        self, origins: Rays, directions: Rays, t_min: float, t_max: float
    ) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """(t, primitive) of many rays: see rays.py."""
        return closest_hits(self.instances, self._team, origins, directions, t_min, t_max)

    def any_hits(
        self, origins: Rays, directions: Rays, t_min: float, t_max: float
    ) -> NDArray[np.bool_]:
        """Whether each of many rays hits anything: see rays.py."""
        return any_hits(self.instances, self._team, origins, directions, t_min, t_max)

    def trace(self, view: View, image: Image, control: Control) -> None:
        """Fills the image; returns early if cancelled. Blocks without a finished mark are open."""
        self._team.run(
            trace_packets,
            packet_view(view, (image.width, image.height), self.instances),
            self.instances.world,
            self._flat,
            effects_of(*self._effects, self.instances.bounds[-1], view.eye),
            image,
            self.instances.stack_size,
            control,
            size=image.finished.size,
        )
