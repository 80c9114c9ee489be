"""A scene in the packet engine and in the scalar reference, for comparisons."""

from __future__ import annotations

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.trace.arguments.image import new_image, to_frame
from lucida.renderer.trace.reference_engine import ReferenceEngine
from lucida.renderer.trace.threads.thread_pool import Team, new_control
from lucida.renderer.trace.tiles.engine import PacketEngine


class Both:
    """A scene in both engines."""

    def __init__(self, scene: Scene) -> None:
        self.team = Team(2)
        self.scene, self.flat = scene, flatten(scene)
        self.packets, self.reference = (
            PacketEngine(scene, self.team),
            ReferenceEngine(scene, self.team),
        )

    def frames(
        self, camera: Camera, size: tuple[int, int], channels: tuple[str, ...] = CHANNELS
    ) -> list[Frame]:
        """Return [reference, packets]."""
        frames = []
        for engine in (self.reference, self.packets):
            image = new_image(size, channels)
            for buffer in (image.color, image.depth, image.normal, image.id, image.primitive):
                buffer.fill(-77)  # every pixel is written
            engine.trace(camera, image, new_control())
            frames.append(to_frame(image, self.scene.background, 0.0))
        return frames

    def check(self, camera: Camera, size: tuple[int, int]) -> list[Frame]:
        """Return [reference, packets], which may differ only where the comparison explains it."""
        frames = self.frames(camera, size)
        comparison = compare_frames(self.flat, camera, size, *frames)
        assert not comparison.unexplained, f"{camera} {size}\n{comparison.summary()}"
        return frames

    def check_closely(self, camera: Camera, size: tuple[int, int]) -> Frame:
        """Return the packets' image, of which hardly any pixel's centre is on an edge."""
        reference, packets = self.check(camera, size)
        assert np.mean(reference.primitive != packets.primitive) <= 0.01 + 1 / packets.id.size
        return packets

    def close(self) -> None:
        self.team.close()
