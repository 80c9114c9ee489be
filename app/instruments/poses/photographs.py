"""The photographs of a set's cameras: their paths, and small pictures of them, made on a thread."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.app.ui.background import Background
from lucida.renderer.system.errors import one_line

from .model import PoseSet
from .reprojected import with_points

SIDE_PX = 800  # a picture's longer side, at most

PhotoKey = tuple[PoseSet, int, bool]


@dataclass(frozen=True, eq=False)
class Photograph:
    """A photograph.

    path: None if there is no file.
    pixels: uint8 (height, width, 3), row 0 at the top; None if there is nothing to show.
    problem: the reason why there is no photograph.
    size: the file's own, (width, height).
    """

    path: Path | None = None
    pixels: NDArray[np.uint8] | None = None
    size: tuple[int, int] = (0, 0)
    problem: str = ""


class Photographs:
    """A reader of photographs on a thread."""

    def __init__(self) -> None:
        self._work: Background[tuple[PhotoKey, Photograph]] = Background("lucida-photographs")
        self._latest: tuple[PhotoKey, Photograph] | None = None
        self._asked: PhotoKey | None = None

    @property
    def busy(self) -> bool:
        """True while a picture that is still wanted is being read."""
        return self._asked is not None and self._work.busy

    def of(self, poses: PoseSet, number: int, dotted: bool = False) -> Photograph | None:
        """Return the photograph of a camera; None while it is being read. dotted: draw the set's
        points on it, if there are any.
        """
        outcome = self._work.poll()
        if outcome is not None and outcome.value is not None:
            self._latest = outcome.value
            self._asked = None if self._latest[0] == self._asked else self._asked
        key = poses, number, dotted
        if self._latest is not None and self._latest[0] == key:
            return self._latest[1]
        if self._asked != key:
            self._asked = key
            self._work.submit(lambda: (key, pictured(*key)))
        return None

    def forget(self) -> None:
        """Discard the picture, for another set."""
        self._latest = None
        self.want_none()

    def want_none(self) -> None:
        """Stop waiting for pictures."""
        self._asked = None

    def close(self) -> None:
        self._work.close()


def photo_path(poses: PoseSet, number: int) -> Path | None:
    """Return the expected path of a camera's photograph; None if the file names none."""
    image = poses.cameras[number].image
    return poses.folder / image if image else None  # an absolute path stays unchanged


def _is_there(path: Path) -> bool:
    try:
        return path.is_file()  # a pipe might never end
    except (OSError, ValueError):
        return False


def pictured(poses: PoseSet, number: int, dotted: bool) -> Photograph:
    """Return a camera's photograph, with the set's points as the camera sees them if `dotted`."""
    found = read_photograph(poses, number)
    if found.pixels is None or not dotted or not len(poses.points):
        return found
    return replace(found, pixels=with_points(poses, number, found.pixels))


def read_photograph(poses: PoseSet, number: int) -> Photograph:
    """Return a small picture of a camera's photograph, or the reason why there is none. Never raise
    because of a file.
    """
    from PIL import Image

    path, name = photo_path(poses, number), poses.cameras[number].name
    if path is None and not name:
        return Photograph(problem="The file names no photograph.")
    if path is None or not _is_there(path):
        return Photograph(problem=f"{one_line(_shown(poses, path, name))} is not there.")
    try:
        with Image.open(path) as opened:
            size = opened.size
            opened.draft("RGB", (SIDE_PX, SIDE_PX))  # decodes no more of a JPEG than needed
            opened.thumbnail((SIDE_PX, SIDE_PX))
            pixels = np.asarray(opened.convert("RGB"))
    except (OSError, ValueError, SyntaxError, MemoryError, Image.DecompressionBombError):
        return Photograph(path, problem=f"{one_line(path.name)} is not a readable picture.")
    return Photograph(path, pixels, size)


def _shown(poses: PoseSet, path: Path | None, name: str) -> str:
    """Return a path that is as short as possible, but clear."""
    if path is None:
        return name
    inside = path.is_relative_to(poses.folder)
    return str(path.relative_to(poses.folder) if inside else Path(*path.parts[-2:]))
