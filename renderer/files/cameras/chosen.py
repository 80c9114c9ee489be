"""One camera of a file that may hold many: `transforms.json#12`, `sparse/0#IMG_7.jpg`."""

from __future__ import annotations

import os

from lucida.renderer.files.cameras.formats import read_cameras
from lucida.renderer.files.cameras.given import Given, Options
from lucida.renderer.files.cameras.posed import CameraSet, PosedCamera, one_of
from lucida.renderer.system.errors import LucidaError


def without_choice(source: str) -> tuple[str, str]:
    """Split `source` into the file, and the camera's name or number after the `#` ("" for none).

    If the whole of `source` is an existing file's name, it is that file, including any `#`.
    """
    signs = [place for place in range(len(source) - 1, 0, -1) if source[place] == "#"]
    for end in (len(source), *signs):
        if os.path.exists(source[:end]):  # Path.exists() raises for a long name
            return source[:end], source[end + 1 :]
    return (source[: signs[0]], source[signs[0] + 1 :]) if signs else (source, "")


def numbered(cameras: CameraSet, number: int) -> PosedCamera:
    """Return the camera with that number, from 0, regardless of names. Raises LucidaError."""
    count = len(cameras.cameras)
    if not 0 <= number < count:
        raise LucidaError("", f"holds no camera {number}", f"give a number from 0 to {count - 1}")
    return cameras.cameras[number]


def read_chosen(
    source: Given,
    which: str | int = "",
    format: str = "",
    options: Options | None = None,
    several: bool = False,
) -> tuple[CameraSet, PosedCamera | None]:
    """Read all cameras of a file. Return them, and the selected one.

    which: the camera's name, or its number as text; or its number as an int. Without it, the camera
    of a file that holds only one. several: return None as the selected one if the file holds more
    than one; otherwise that is an error.

    Raises LucidaError.
    """
    found = read_cameras(source, format, options)
    chosen = None
    try:
        if isinstance(which, int):
            chosen = numbered(found, which)
        elif which or not several or len(found.cameras) == 1:
            chosen = one_of(found, which)
    except LucidaError as error:
        example = "" if source.path is None else f", as in {source.name}#0"
        raise LucidaError("", error.problem, error.remedy + example, source.name) from None
    return found, chosen
