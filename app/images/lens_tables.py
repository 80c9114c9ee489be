"""The tables of lenses, made on a thread, so that no frame waits for a full image's."""

from __future__ import annotations

from lucida.app.ui.background import Background
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lens_faces import looked_up_faces

from .request import ImageRequest

Key = tuple[object, ...]


class LensTables:
    """A maker of the table for the latest request."""

    def __init__(self) -> None:
        self._work: Background[Key] = Background("lucida-lens")
        self._ready: Key = ()

    def ready(self, request: ImageRequest) -> bool:
        """Return True if the full image can be drawn at once. If not, its table is made, and the
        window is woken when it is ready.
        """
        camera = request.camera
        if camera.lens is None:
            return True
        key = _key(camera, request.size, request.enlargement)
        if (outcome := self._work.poll()) is not None:
            # An error here recurs in drawing, which reports it.
            self._ready = key if outcome.value is None else outcome.value
        if key != self._ready:
            self._work.ask(_made, camera, request.size, request.enlargement)
        return key == self._ready

    def close(self) -> None:
        self._work.close()


def _key(camera: Camera, size: Size, enlargement: int) -> Key:
    return camera.lens, camera.viewport, camera.distance, size, enlargement


def _made(camera: Camera, size: Size, enlargement: int) -> Key:
    """Make the table, which lens_faces.py keeps."""
    looked_up_faces(camera, size, enlargement)
    return _key(camera, size, enlargement)
