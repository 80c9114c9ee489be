"""The list of formats, and the functions that read and write a file of any of them.

A format is a module in this folder and a line in FORMATS. A module has

    recognises(given: Given) -> bool            True if it looks like this format; never raises
    read(given: Given, options: Options) -> CameraSet
    write(cameras: Sequence[PosedCamera], options: Options) -> bytes

which returns the content of the file; a format without endings is only read.
LENSES are the lens models that it can hold, none by default.
read and write raise LucidaError; a camera that the format cannot hold is never written.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType

from lucida.renderer.files.reading import naming, suggestion
from lucida.renderer.system.errors import LucidaError, under

from .distortion import check_held
from .given import Given, Options, from_json, given
from .posed import CameraSet, PosedCamera, one_of


@dataclass(frozen=True)
class Format:
    """A camera format.

    name: on the command line. what: a description. needs: the parts by which a file is recognised.
    endings: of written files; none for a format that is only read.
    """

    name: str
    what: str
    needs: str
    endings: tuple[str, ...]

    @property
    def module(self) -> ModuleType:
        return import_module(f"lucida.renderer.files.cameras.{self.name}")

    def check_written(self) -> None:
        """Raise LucidaError if the format is only read."""
        if not self.endings:
            names = ", ".join(entry.name for entry in FORMATS if entry.endings)
            raise LucidaError("format", f"{self.name!r} is only read", f"give one of {names}")


_FRAMES = "frames with a transform_matrix"
_MATRICES = "a view matrix and a projection matrix of 16 numbers"
_K = "camera_matrix, K, P, or fx and fy"

# recognised() tries them in this order.
FORMATS = (
    Format("view", "Lucida's view file", "a table [camera]", (".toml",)),
    Format("colmap", "COLMAP's model", "the files cameras and images", ()),
    Format("nerf", "NeRF's and nerfstudio's transforms.json", _FRAMES, ()),
    Format("opengl", "OpenGL's view and projection matrices", _MATRICES, (".txt",)),
    Format("opencv", "OpenCV's K, R and t, or a calibration file like OpenCV's", _K, (".yml",)),
    Format("gltf", "cameras of a glTF file", "an asset with cameras", (".gltf",)),
)

_TEXTS = (".json", ".yml", ".yaml", ".xml", ".toml", ".txt")


def format_named(name: str) -> Format:
    """Return the format with that name. Raises LucidaError if there is none."""
    known = {entry.name: entry for entry in FORMATS}
    if name not in known:
        raise LucidaError("format", f"{name!r} is unknown", suggestion(name, known))
    return known[name]


def read_cameras(
    source: str | Path | Given, format: str = "", options: Options | None = None
) -> CameraSet:
    """Read the cameras of a file, a folder or a pasted text.

    format: a name of FORMATS; "" to recognise it by name and content. Raises LucidaError naming the
    file.
    """
    found = source if isinstance(source, Given) else given(source)
    with naming(found.name):
        entry = format_named(format) if format else recognised(found)
        cameras: CameraSet = entry.module.read(found, options or Options())
        if not cameras.cameras:
            raise LucidaError("", f"holds no camera ({entry.name})", "give another file")
    return cameras


def without_choice(source: str) -> tuple[str, str]:
    """Split `transforms.json#12` or `sparse/0#IMG_7.jpg` into the file, and the camera's name or
    number after the `#` ("" for none).

    If `source` as a whole names an existing file, it is that file, including any `#`.
    """
    signs = [place for place in range(len(source) - 1, 0, -1) if source[place] == "#"]
    for end in (len(source), *signs):
        if os.path.exists(source[:end]):  # Path.exists() raises for a long name
            return source[:end], source[end + 1 :]
    return (source[: signs[0]], source[signs[0] + 1 :]) if signs else (source, "")


def read_chosen(
    source: Given,
    which: str = "",
    options: Options | None = None,
    several: bool = False,
) -> tuple[CameraSet, PosedCamera | None]:
    """Read all cameras of a file. Return them, and the selected one: see one_of().

    several: without `which`, return None as the selected one if the file holds more than one;
    otherwise that is an error. Raises LucidaError.
    """
    found = read_cameras(source, options=options)
    if several and not which and len(found.cameras) > 1:
        return found, None
    try:
        return found, one_of(found.cameras, which)
    except LucidaError as error:
        example = "" if source.path is None else f", as in {source.name}#0"
        raise LucidaError("", error.problem, error.remedy + example, source.name) from None


def recognised(found: Given) -> Format:
    """Return the format that a file looks like. Raises LucidaError."""
    for entry in FORMATS:
        if entry.module.recognises(found):
            return entry
    if found.ending in _TEXTS and found.data:
        text = found.text  # raises if it is not text
        if found.ending == ".json":
            from_json(text)
    if found.is_folder:
        remedy = "give the folder of a COLMAP model, such as sparse/0, or a file of cameras"
        raise LucidaError("", "is a folder without cameras", remedy)
    wanted = ", ".join(f"{entry.needs} ({entry.name})" for entry in FORMATS)
    remedy = f"export the cameras as glTF or COLMAP, or give {wanted}"
    raise LucidaError("", "is not a recognised camera format", remedy)


def written(cameras: Sequence[PosedCamera], format: str, options: Options | None = None) -> bytes:
    """Return cameras as a file of a format.

    Raises LucidaError if the format cannot hold them; a lens is never dropped silently.
    """
    entry, options = format_named(format), options or Options()
    entry.check_written()
    for posed in cameras:
        with under(posed.name):
            models = getattr(entry.module, "LENSES", ())
            check_held(posed.camera, models, entry.name)
    data: bytes = entry.module.write(cameras, options)
    return data
