"""The photographs of a set's cameras: where they are, and small pictures of them, read in a thread.

Owns the thread, and the last pictures, which are as small as a panel shows them. Knows nothing of
how they are shown.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.poses.model import PoseSet
from app.widgets.background import Background
from renderer.errors import one_line

ENDINGS = (".png", ".jpg", ".jpeg", ".JPG", ".PNG")  # of a photograph that is named without one
SIDE_PX = 800  # a picture's longer side, at most
KEPT = 24  # pictures: at most 50 MB


@dataclass(frozen=True, eq=False)
class Photograph:
    """path: where it is; None: it is not there. pixels: uint8 (height, width, 3), row 0 at the
    top; None where there is nothing to show, of which problem says why. size: the file's own,
    (width, height)."""

    path: Path | None = None
    pixels: NDArray[np.uint8] | None = None
    size: tuple[int, int] = (0, 0)
    problem: str = ""


class Photographs:
    """wake: called from the thread when one has been read."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._work: Background[tuple[tuple[PoseSet, int], Photograph]] = Background(
            "lucida-photographs", wake
        )
        self._kept: OrderedDict[tuple[PoseSet, int], Photograph] = OrderedDict()
        self._asked: tuple[PoseSet, int] | None = None

    @property
    def busy(self) -> bool:
        return self._work.busy

    def of(self, poses: PoseSet, number: int) -> Photograph | None:
        """The photograph of a camera; None while it is being read."""
        outcome = self._work.poll()
        if outcome is not None:
            self._asked = None
            if outcome.value is not None:
                self._kept[outcome.value[0]] = outcome.value[1]
                while len(self._kept) > KEPT:
                    self._kept.popitem(last=False)
        key = poses, number
        found = self._kept.get(key)
        if found is not None:
            self._kept.move_to_end(key)
        elif self._asked != key:
            self._asked = key
            self._work.submit(lambda: (key, read_photograph(poses, number)))
        return found

    def forget(self) -> None:
        """Another set: the pictures' memory is free."""
        self._kept.clear()

    def close(self) -> None:
        self._work.close()


def photo_of(poses: PoseSet, number: int) -> Path | None:
    """The photograph of a camera, where it is there. Looks at the disk: for a thread."""
    for place in photo_places(poses, number):
        try:
            if place.is_file():
                return place
        except (OSError, ValueError):
            continue
    return None


def photo_places(poses: PoseSet, number: int) -> list[Path]:
    """Where the photograph of a camera may be, the likeliest first; none where it has none."""
    image = poses.cameras[number].image
    if not image:
        return []
    base = poses.path if poses.path.is_dir() else poses.path.parent
    # Data sets keep sparse/0 beside images.
    folders = [base, base / "images", base.parent / "images", base.parent.parent / "images"]
    named = [folder / image for folder in folders]  # an absolute one stays what it is
    if not named[0].suffix:
        named += [place.with_name(place.name + ending) for place in named for ending in ENDINGS]
    return list(dict.fromkeys(named))


def read_photograph(poses: PoseSet, number: int) -> Photograph:
    """A small picture of it, or in words why there is none. No file makes it raise."""
    from PIL import Image

    image = poses.cameras[number].image
    if not image:
        return Photograph(problem="the file names no photograph")
    path = photo_of(poses, number)
    if path is None:
        return Photograph(problem=f"{one_line(image)} is not there")
    try:
        with Image.open(path) as opened:
            size = opened.size
            opened.draft("RGB", (SIDE_PX, SIDE_PX))  # of a JPEG, no more is decoded than needed
            opened.thumbnail((SIDE_PX, SIDE_PX))
            pixels = np.asarray(opened.convert("RGB"))
    except (OSError, ValueError, SyntaxError, MemoryError, Image.DecompressionBombError):
        return Photograph(path, problem=f"{one_line(path.name)} is no picture that can be read")
    return Photograph(path, pixels, size)
