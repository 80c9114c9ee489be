"""Pictures of the window, encoded and saved on a thread."""

from __future__ import annotations

import datetime
import os
from pathlib import Path

import numpy as np

from lucida.app.ui.surface import Target
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .files import Files

Rect = tuple[float, float, float, float]  # left, top, right, bottom


class Captures:
    """Takes pictures of the window. wanted: the next frame is one.

    folder: for the pictures; None for the user's folder of pictures.
    """

    def __init__(self, files: Files) -> None:
        self._files = files
        self.folder: Path | None = None
        self.wanted = False

    def after_drawing(self, target: Target) -> None:
        """Take the picture. Call when the frame is drawn, before the swap."""
        if self.wanted:
            self.wanted, pixels = False, target.read()
            self._files.store(lambda: saved_picture(pixels, self.folder or pictures_folder()))


def free_path(path: Path, before_number: str = "-") -> Path:
    """Return the path, or the first free one with a number from 2 on: lucida.png, lucida-2.png."""
    found, number = path, 2
    while os.path.lexists(found):
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


def saved_picture(pixels: np.ndarray, folder: Path) -> str:
    """Save a picture under a free name: lucida 2026-01-31 10.15.59.png. Return a message.

    Raises LucidaError.
    """
    from PIL import Image

    now = datetime.datetime.now().strftime("%Y-%m-%d %H.%M.%S")
    path = free_path(folder / f"lucida {now}.png", " ")
    with atomic_write(path) as file:
        Image.fromarray(pixels).save(file, format="PNG")
    return f"Saved {path} ({pixels.shape[1]} x {pixels.shape[0]})."
