"""Pictures of the window, encoded and saved on a thread."""

from __future__ import annotations

import datetime
import os
from collections.abc import Callable, Collection
from pathlib import Path

import numpy as np

from lucida.app.ui.background import Background
from lucida.app.ui.surface import Target
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

Rect = tuple[float, float, float, float]  # left, top, right, bottom


class Captures:
    """Takes pictures while the window is open.

    wake: called on a thread when a picture has been saved.
    folder: for pictures without a given path; None for the user's folder of pictures.
    """

    def __init__(self, wake: Callable[[], None], folder: Path | None = None) -> None:
        self._work: Background[str] = Background("lucida-capture", wake, every=True)
        self._asked: Path | None = None
        self._promised: set[Path] = set()  # to pictures that may not be written yet
        self.folder = folder

    @property
    def busy(self) -> bool:
        return self._asked is not None or self._work.busy

    def ask(self, path: Path) -> None:
        """Ask for a picture of the next frame, in a file."""
        self._asked = path

    def default_path(self) -> Path:
        """Return a free name for a picture: lucida 2026-01-31 10.15.59.png. Raises LucidaError."""
        folder = self.folder or pictures_folder()
        now = datetime.datetime.now().strftime("%Y-%m-%d %H.%M.%S")
        path = free_path(folder / f"lucida {now}.png", " ", self._promised)
        self._promised.add(path)
        return path

    def after_drawing(self, target: Target) -> None:
        """Take the requested picture. Call when the frame is drawn, before the swap."""
        if self._asked is None:
            return
        path, self._asked = self._asked, None
        pixels = target.read()
        self._work.submit(lambda: _finish(pixels, path))

    def poll(self) -> tuple[str, bool] | None:
        """Return the result of the last picture: a message, and True if it was taken."""
        outcome = self._work.poll()
        if outcome is None:
            return None
        if outcome.error is not None:
            return str(outcome.error), False
        return outcome.value or "", True

    def close(self) -> None:
        self._work.close(5.0)


def free_path(path: Path, before_number: str = "-", taken: Collection[Path] = ()) -> Path:
    """Return the path, or the first free one with a number from 2 on: lucida.png, lucida-2.png.

    taken: paths that will exist.
    """
    found, number = path, 2
    while os.path.lexists(found) or found in taken:
        found = path.with_name(f"{path.stem}{before_number}{number}{path.suffix}")
        number += 1
    return found


def pictures_folder() -> Path:
    """Return the user's folder of pictures, created if necessary. Raises LucidaError."""
    import platformdirs

    try:
        folder = platformdirs.user_pictures_path()
        folder.mkdir(parents=True, exist_ok=True)
        return folder
    except (OSError, RuntimeError) as error:
        raise LucidaError("pictures", f"cannot be kept: {error}", "save to a named file") from None


def cut(pixels: np.ndarray, rect: Rect) -> np.ndarray:
    """Cut out a part of a picture, uint8 (height, width, 3), of at least one pixel."""
    height, width = pixels.shape[:2]
    left, right = (min(max(round(x), 0), width) for x in (rect[0], rect[2]))
    top, bottom = (min(max(round(y), 0), height) for y in (rect[1], rect[3]))
    left, top = min(left, width - 1), min(top, height - 1)
    return pixels[top : max(bottom, top + 1), left : max(right, left + 1)]


def _finish(pixels: np.ndarray, path: Path) -> str:
    """Encode the picture and put it in its place. Return a message."""
    from PIL import Image

    with atomic_write(path) as file:
        Image.fromarray(pixels).save(file, format="PNG")
    return f"Saved {path} ({pixels.shape[1]} x {pixels.shape[0]})."
