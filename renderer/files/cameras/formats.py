"""The list of formats, and the functions that read and write a file of any of them.

A format is a module here and a line in FORMATS. A module has

    recognises(given: Given) -> bool            True if it looks like this format; never raises
    read(given: Given, options: Options) -> CameraSet
    write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]

which returns the content of the file under "", or the contents of a folder's files by their names.
LENSES are the models of lenses that it can hold; without it, none.
Each raises LucidaError; a camera that the format cannot hold is never written.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType

from lucida.renderer.files.cameras.distortion import check_held, without_lens
from lucida.renderer.files.cameras.given import Given, Options, from_json, given
from lucida.renderer.files.cameras.posed import CameraSet, PosedCamera
from lucida.renderer.files.reading import naming, suggestion
from lucida.renderer.system.errors import LucidaError, under


@dataclass(frozen=True)
class Format:
    """A camera format.

    name: on the command line. what: in words. needs: the parts by which a file is recognised.
    endings: of the file that is written, "" for a folder; the first is the default.
    """

    name: str
    what: str
    needs: str
    endings: tuple[str, ...]

    @property
    def module(self) -> ModuleType:
        return import_module(f"lucida.renderer.files.cameras.{self.name}")

    @property
    def lenses(self) -> Collection[str]:
        """Models of Lens that the format can hold."""
        models: Collection[str] = getattr(self.module, "LENSES", ())
        return models


_FRAMES = "frames with a transform_matrix"
_MATRICES = "a view matrix and a projection matrix of 16 numbers"
_K = "camera_matrix, K, P, or fx and fy"

# In the order in which recognised() tries them.
FORMATS = (
    Format("view", "Lucida's view file", "a table [camera]", (".toml",)),
    Format("colmap", "COLMAP's model", "the files cameras and images", ("",)),
    Format("nerf", "NeRF's and nerfstudio's transforms.json", _FRAMES, (".json",)),
    Format("opengl", "OpenGL's view and projection matrices", _MATRICES, (".txt",)),
    Format("opencv", "OpenCV's K, R and t, or a calibration of its family", _K, (".yml",)),
    Format("gltf", "cameras of a glTF file", "an asset with cameras", (".gltf",)),
)

_UNKNOWN = "is not a recognised camera format"
_TEXTS = (".json", ".yml", ".yaml", ".xml", ".toml", ".txt")


def format_named(name: str) -> Format:
    """Return the format with that name. Raises LucidaError if there is none."""
    for entry in FORMATS:
        if entry.name == name:
            return entry
    raise LucidaError(
        "format", f"{name!r} is unknown", suggestion(name, [entry.name for entry in FORMATS])
    )


def read_cameras(
    source: str | Path | Given, format: str = "", options: Options | None = None
) -> CameraSet:
    """Read the cameras of a file, a folder or a pasted text.

    format: a name of FORMATS; "" to recognise it by name and content. Raises LucidaError naming the
    file.
    """
    found = source if isinstance(source, Given) else given(source)
    options = options or Options()
    with naming(found.name):
        entry = format_named(format) if format else recognised(found)
        cameras: CameraSet = entry.module.read(found, options)
        if not cameras.cameras:
            raise LucidaError("", f"holds no camera ({entry.name})", "give another file")
    return cameras


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
    raise LucidaError("", _UNKNOWN, f"export glTF or COLMAP there, or give {wanted}")


def written(
    cameras: Sequence[PosedCamera], format: str, options: Options | None = None
) -> dict[str, bytes]:
    """Return cameras as files of a format: by name within a folder, or one file under "".

    Raises LucidaError if the format cannot hold them.
    """
    entry, options = format_named(format), options or Options()
    held = [_held(posed, entry, options) for posed in cameras]
    files: dict[str, bytes] = entry.module.write(held, options)
    return files


def _held(posed: PosedCamera, entry: Format, options: Options) -> PosedCamera:
    """Return the camera, without its lens if the options ignore it. Raises LucidaError for a lens
    that the format cannot hold: a lens is never dropped silently.
    """
    if options.ignore_distortion:
        return without_lens(posed)
    with under(posed.name):
        check_held(posed.camera, posed.size or options.size, entry.lenses, entry.name)
    return posed
