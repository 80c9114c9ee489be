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

from renderer.camera_formats.distortion import check_held, without_lens
from renderer.camera_formats.entries import errors_within
from renderer.camera_formats.given import Given, Options, from_json, given
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.errors import LucidaError
from renderer.scene.reading import suggestion


@dataclass(frozen=True)
class Format:
    """A camera format.

    name: on the command line. what: in words. endings: of the file that is written, "" for a
    folder; the first is the default.
    """

    name: str
    what: str
    endings: tuple[str, ...]

    @property
    def module(self) -> ModuleType:
        return import_module(f"renderer.camera_formats.{self.name}")

    @property
    def lenses(self) -> Collection[str]:
        """Models of Lens that the format can hold."""
        models: Collection[str] = getattr(self.module, "LENSES", ())
        return models


# In the order in which recognised() tries them.
FORMATS = (
    Format("view", "Lucida's view file", (".toml",)),
    Format("colmap", "COLMAP's model", ("",)),
    Format("nerf", "NeRF's and nerfstudio's transforms.json", (".json",)),
    Format("opengl", "OpenGL's view and projection matrices", (".txt",)),
    Format("opencv", "OpenCV's K, R and t, or a calibration of its family", (".yml", ".json")),
    Format("gltf", "cameras of a glTF file", (".gltf",)),
)

UNKNOWN = "is not a recognised camera format"
_TEXTS = (".json", ".yml", ".yaml", ".xml", ".toml", ".txt")
# Formats that are not read, by words of their files.
_NOT_READ = {
    "import bpy": "Blender's scripts are",
    '"PerspectiveCamera"': "three.js's JSON is",
    "<sensor ": "Metashape's XML is",
    '"poseId"': "Meshroom's .sfm is",
    '"img_name"': "Gaussian splatting's cameras.json is",
    "PinholeCamera": "Open3D's JSON is",
}


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
    try:
        entry = format_named(format) if format else recognised(found)
        cameras: CameraSet = entry.module.read(found, options)
        if not cameras.cameras:
            raise LucidaError("", f"holds no camera ({entry.name})", "give another file")
        return cameras
    except LucidaError as error:
        raise error if error.source else error.in_file(found.name) from None


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
    for mark, what in _NOT_READ.items():
        if found.is_text and mark in found.text:
            raise LucidaError("", f"{UNKNOWN}: {what} not read", "export glTF or COLMAP there")
    names = ", ".join(entry.name for entry in FORMATS)
    raise LucidaError("", UNKNOWN, f"say which with `lucida camera --from`: {names}")


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
    """Return the camera, without its lens if that is to be ignored. Raises LucidaError for a lens
    that the format cannot hold: a lens is never dropped silently.
    """
    if options.ignore_distortion:
        return without_lens(posed)
    with errors_within(posed.name):
        check_held(posed.camera, posed.size or options.size, entry.lenses, entry.name)
    return posed
