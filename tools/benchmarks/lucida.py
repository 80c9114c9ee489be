"""Lucida's own tracer behind the interface of the peers.

Owns how it is called, by its public interface only.
"""

from __future__ import annotations

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene import Mesh, Scene, SceneObject
from lucida.renderer.trace import Tracer
from tools.benchmarks.meshes import Faces, Vertices
from tools.benchmarks.peers import Hits, Peer

VISIBILITY = ("depth", "primitive", "normal")


class Lucida(Peer):
    """lucida.Tracer."""

    name, package = "Lucida", "camera-lucida"

    def __init__(self, threads: int | None = None) -> None:
        self._threads = threads

    def prepare(self, vertices: Vertices, faces: Faces) -> None:
        self.tracer = Tracer(Scene((SceneObject(Mesh(vertices, faces)),)), self._threads)
        # The tracer prepares a scene with its first image.
        self.tracer.render(Camera.canonical(), (1, 1), VISIBILITY)

    def trace(self, camera: Camera, size: Size) -> Frame:
        return self.tracer.render(camera, size, VISIBILITY)

    def read(self, answer: Frame) -> Hits:
        return Hits(
            answer.channel("depth").ravel(),
            answer.channel("primitive").ravel(),
            answer.channel("normal").reshape(-1, 3),
        )

    def close(self) -> None:
        if hasattr(self, "tracer"):
            self.tracer.close()
