"""The cameras of a file, in any format, with their images' sizes and names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError

from .given import Options

NAMES_TOLD = 3  # cameras that an error's remedy lists


@dataclass(frozen=True)
class PosedCamera:
    """One camera of a file.

    size: (width, height) of its image; None if the format has none. In that case, the viewport
    determines the aspect ratio, and fit widens it to each image. name: the file's name for it, or
    the photograph's name. image: the path of the photograph, which may not exist; "" if the file
    names none.
    """

    camera: Camera
    size: Size | None = None
    name: str = ""
    image: str = ""
    fit: bool = False


@dataclass(frozen=True, eq=False)
class CameraSet:
    """The cameras of a file, in its order.

    format: a name of FORMATS. taken: the assumed conventions, one phrase each ("integers at the
    pixels' centres"). points, point_colors: of a reconstruction, float64 (n, 3), and their colours
    in sRGB, uint8 (n, 3). notes: the phrases among taken that commands report, about unused keys,
    and the origin of the images' size if the file does not state it.
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


def one_of(cameras: Sequence[PosedCamera], which: str = "") -> PosedCamera:
    """Return the camera with that name, or with that number (from 0).

    Without either, return the only camera. Raises LucidaError listing the choices.
    """
    named = [camera for camera in cameras if camera.name == which] if which else list(cameras)
    if not named:  # find a photograph by its file name alone
        named = [camera for camera in cameras if camera.name.rpartition("/")[2] == which]
    if not named and which.isascii() and which.isdigit() and len(which) < 10:
        named = list(cameras[int(which) :][:1])
    if len(named) == 1:
        return named[0]
    problem = f"holds no camera {which!r}"
    if named:
        problem = f"holds {len(named)} cameras" + f" named {which!r}" * bool(which)
    names = [repr(camera.name) for camera in cameras if camera.name]
    told = ", ".join([*names[:NAMES_TOLD], *["..."] * (len(names) > NAMES_TOLD)])
    by_name = f" or one of {told}" if told else ""
    raise LucidaError("", problem, f"give a number from 0 to {len(cameras) - 1}{by_name}")


def sized(posed: PosedCamera, options: Options) -> tuple[Camera, Size | None]:
    """Return the camera fitted to its image's size, and that size.

    The size is its own, or the requested one; None if neither is known.
    """
    size = posed.size or options.size
    camera = posed.camera.fitted(size) if posed.fit and size is not None else posed.camera
    return camera, size


def in_image(posed: PosedCamera, options: Options, target: str) -> tuple[Camera, Size]:
    """Return sized() for a format that needs a size. Raises LucidaError if there is none."""
    camera, size = sized(posed, options)
    if size is None:
        raise LucidaError("size", f"is unknown, but {target} needs one", "give --size WxH")
    return camera, check_size(size)
