"""What a file of cameras holds, whatever its format: cameras with their images' sizes and names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Size
from renderer.errors import LucidaError

NAMES_TOLD = 3  # of the cameras in a file, in an error's remedy


@dataclass(frozen=True)
class Distortion:
    """What a lens does beside a pinhole: kept so that it is told, never drawn.

    model: as the format calls it. coefficients: by their names there. corner_px: how far it moves
    the corner of the image that it moves farthest, in pixels.
    """

    model: str
    coefficients: dict[str, float]
    corner_px: float


@dataclass(frozen=True)
class PosedCamera:
    """One camera of a file.

    size: (width, height) of its image; None where the format has none (the viewport then says the
    aspect ratio, and fit whether it is widened to each image's). name: what the file calls it, or
    the photograph's name. image: the photograph's path, "" where the file names none; whether it
    is there is not looked at. distortion: None for a pinhole.
    """

    camera: Camera
    size: Size | None = None
    name: str = ""
    image: str = ""
    fit: bool = False
    distortion: Distortion | None = None


@dataclass(frozen=True, eq=False)
class CameraSet:
    """The cameras of a file, in its order.

    format: a name of FORMATS. taken: the conventions that were taken, a phrase each ("integers at
    the pixels' centres"). sizing: that of them which says where the images' size is from, if the
    file does not say it. points: of a reconstruction, float64 (n, 3), and their colours in sRGB,
    uint8 (n, 3).
    """

    format: str
    cameras: tuple[PosedCamera, ...]
    taken: tuple[str, ...] = ()
    points: NDArray[np.float64] | None = None
    point_colors: NDArray[np.uint8] | None = None
    sizing: str = ""


def one_of(cameras: CameraSet, which: str = "") -> PosedCamera:
    """The camera of that name, or of that number (from 0); without either, the first of a file
    that holds one. Raises LucidaError that says what there is."""
    found = cameras.cameras
    if not which:
        if len(found) == 1:
            return found[0]
        raise LucidaError("", f"holds {len(found)} cameras", _remedy(found))
    named = [camera for camera in found if camera.name == which]
    if not named:  # a photograph by its file's name alone
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
