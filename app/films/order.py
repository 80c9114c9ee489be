"""A film as it is asked for, before its cameras are computed; may be sent to another process."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.films.encoding import film_writer
from app.films.film import Film
from app.films.frames import Look, Shot
from app.films.paths import Way
from renderer.camera import Size
from renderer.focus import scene_focus
from renderer.scene.model import Scene


@dataclass(frozen=True, eq=False)
class Order:
    """path: of the file, or a folder without an ending. size: of each image. count: of frames."""

    path: Path
    scene: Scene
    way: Way
    look: Look
    size: Size
    count: int
    fps: float

    def check(self) -> None:
        """Raise LucidaError if the file cannot hold such a film."""
        film_writer(self.path, self.look.frame_size(self.size), self.fps)

    def film(self) -> Film:
        """Return the film. Raises LucidaError."""
        write = film_writer(self.path, self.look.frame_size(self.size), self.fps)
        cameras = self.way.cameras(scene_focus(self.scene), self.size, self.count)
        shots = [Shot(camera, self.size) for camera in cameras]
        return Film(self.path, self.scene, shots, self.look, write)
