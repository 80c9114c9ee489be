"""One camera of a file that may hold many: `transforms.json#12`, `sparse/0#IMG_7.jpg`."""

from __future__ import annotations

import os
from dataclasses import replace

from renderer.camera_formats.formats import check_distortion, read_cameras
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, PosedCamera, one_of
from renderer.errors import LucidaError


def without_choice(source: str) -> tuple[str, str]:
    """The file, and which of its cameras: the name or number behind a `#`, "" for none. What is
    there by its whole name is that file, with all its `#`."""
    signs = [place for place in range(len(source) - 1, 0, -1) if source[place] == "#"]
    for end in (len(source), *signs):
        if os.path.exists(source[:end]):  # not Path.exists(): it fails for a name that is too long
            return source[:end], source[end + 1 :]
    return (source[: signs[0]], source[signs[0] + 1 :]) if signs else (source, "")


def numbered(cameras: CameraSet, number: int) -> PosedCamera:
    """The camera of that number, from 0, whatever it is called. Raises LucidaError."""
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
    """All cameras of a file, and the chosen one: by its name or number in a text, or by its number;
    without either that of a file which holds one. several: None of one which holds more; otherwise
    that is an error.

    Only the cameras that are asked for must be without distortion. Raises LucidaError.
    """
    options = options or Options()
    found = read_cameras(source, format, replace(options, ignore_distortion=True))
    chosen = None
    try:
        if isinstance(which, int):
            chosen = numbered(found, which)
        elif which or not several or len(found.cameras) == 1:
            chosen = one_of(found, which)
    except LucidaError as error:
        example = "" if source.path is None else f", as in {source.name}#0"
        raise LucidaError("", error.problem, error.remedy + example, source.name) from None
    try:
        check_distortion(found.cameras if chosen is None else (chosen,), options)
    except LucidaError as error:
        raise error.in_file(source.name) from None
    return found, chosen
