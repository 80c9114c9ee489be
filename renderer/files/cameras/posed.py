"""The cameras of a file, in any format, with their images' sizes and names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

NAMES_TOLD = 3  # cameras that an error's remedy lists


@dataclass(frozen=True)
class PosedCamera:
    """One camera of a file.

    size: (width, height) of its image; None if the format has none. The viewport then determines
    the aspect ratio, and fit means that it is widened to fit each image. name: the file's name for
    it, or the photograph's name. image: the photograph's path, "" if the file names none. It may
    not exist. ignored: the file's lens, if the camera was read without it.
    """

    camera: Camera
    size: Size | None = None
    name: str = ""
    image: str = ""
    fit: bool = False
    ignored: Lens | None = None


@dataclass(frozen=True, eq=False)
class CameraSet:
    """The cameras of a file, in its order.

    format: a name of FORMATS. taken: the conventions that were assumed, one phrase each ("integers
    at the pixels' centres"). points, point_colors: of a reconstruction, float64 (n, 3), and their
    colours in sRGB, uint8 (n, 3). notes: the phrases among taken that commands report: on unused
    keys, and on the origin of the images' size if the file does not state it.
    """

    format: str
    cameras: tuple[PosedCamera, ...]
    taken: tuple[str, ...] = ()
    points: NDArray[np.float64] | None = None
    point_colors: NDArray[np.uint8] | None = None
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        points = 0 if self.points is None else len(self.points)
        return f"CameraSet({self.format}: {len(self.cameras)} cameras, {points:,} points)"


def one_of(cameras: CameraSet, which: str = "") -> PosedCamera:
    """Return the camera with that name, or with that number (from 0).

    Without either, return the camera of a file that holds only one. Raises LucidaError listing the
    choices.
    """
    found = cameras.cameras
    if not which:
        if len(found) == 1:
            return found[0]
        raise LucidaError("", f"holds {len(found)} cameras", _remedy(found))
    named = [camera for camera in found if camera.name == which]
    if not named:  # a photograph by its bare file name
        named = [camera for camera in found if camera.name.rpartition("/")[2] == which]
    if len(named) == 1:
        return named[0]
    if named:
        problem = f"holds {len(named)} cameras named {which!r}"
        raise LucidaError("", problem, "give the number of one, from 0")
    if which.isascii() and which.isdigit() and len(which) < 10 and int(which) < len(found):
        return found[int(which)]
    raise LucidaError("", f"holds no camera {which!r}", _remedy(found))


def _remedy(found: tuple[PosedCamera, ...]) -> str:
    names = [camera.name for camera in found if camera.name]
    told = ", ".join(map(repr, names[:NAMES_TOLD]))
    more = ", ..." if len(names) > NAMES_TOLD else ""
    by_name = f" or one of {told}{more}" if names else ""
    return f"give a number from 0 to {len(found) - 1}{by_name}" if found else "give another file"
