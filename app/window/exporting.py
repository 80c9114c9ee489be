"""Exports of a scene and its camera for other renderers, or as a page: on a thread, with progress
and cancel.

Reports what could not be exported.
"""

from __future__ import annotations

import time
from pathlib import Path

from lucida.app.ui.background import Background
from lucida.app.web import ENDINGS as PAGES
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.export import export_scene
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.cancelling import Cancellation, CancelledError, cancelled_by
from lucida.renderer.system.errors import describe, one_line

Lines = tuple[str, ...]
NOT_CARRIED = "Not as it is there:"


class Exports:
    """The exports of one window, one at a time."""

    def __init__(self) -> None:
        self._work: Background[Lines] = Background("lucida-export")
        self._cancellation = Cancellation()
        self._path = Path()
        self._began_s = 0.0

    @property
    def busy(self) -> bool:
        return self._work.busy

    @property
    def name(self) -> str:
        """The name of the file that is being written; empty if none is."""
        return one_line(self._path.name) if self._work.busy else ""

    @property
    def time_s(self) -> float:
        """The time of the writing so far, in seconds."""
        return time.monotonic() - self._began_s if self._work.busy else 0.0

    def begin(self, path: str, scene: Scene, camera: Camera, size: Size) -> None:
        """Write a file, whose ending names the format. Call while none is being written.

        size: (width, height) of the image.
        """
        self._cancellation = Cancellation()
        check = self._cancellation.check
        self._path, self._began_s = Path(path), time.monotonic()

        def write() -> Lines:
            with cancelled_by(check):
                if Path(path).suffix.lower() in PAGES:
                    from lucida.app.web.scene_page import write_scene_page

                    write_scene_page(path, scene, View(camera))
                    return ()
                return export_scene(path, scene, camera, size)

        self._work.submit(write)

    def cancel(self) -> None:
        """End the writing between two of its parts, and remove the unfinished file."""
        self._cancellation.cancel()

    def poll(self) -> tuple[str, str]:
        """Return what was done since the last call, and what the user must read; or ""."""
        outcome = self._work.poll()
        if outcome is None:
            return "", ""
        name = one_line(self._path.name)
        if isinstance(outcome.error, CancelledError):
            return f"Exporting {name} was cancelled: nothing was written.", ""
        if outcome.error is not None:
            return "", describe(outcome.error)
        title, notes = f"Exported {name}. {NOT_CARRIED}", outcome.value or ()
        exported = one_line(f"Exported the scene and its camera as {self._path}.")
        return exported, "\n".join((title, *notes)) if notes else ""

    def close(self) -> None:
        self.cancel()
        self._work.close(5.0)
