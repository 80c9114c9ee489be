"""Readers of COLMAP's models, text and binary: cameras, images and points.

Each function takes a file's bytes and raises LucidaError naming the line or the entry.
Source: COLMAP's documentation, "Output Format".
"""

from __future__ import annotations

import contextlib
import io
import struct
from codecs import BOM_UTF8
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.system.errors import LucidaError, under

from .colmap_lenses import MODELS, NAMES, ColmapLens, colmap_lens

_CAMERA = "CAMERA_ID MODEL WIDTH HEIGHT PARAMS"
_IMAGE = "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME"
_POINT = np.dtype([("xyz", "<f8", 3), ("rgb", "u1", 3)])  # after the id; then error and track
_SHORT_BYTES = 1000  # a longer line's words are not counted
_REMEDY = "write it again with COLMAP"

Lenses = dict[int, ColmapLens]  # by their CAMERA_ID
Points = tuple[NDArray[np.float64], NDArray[np.uint8]]  # (n, 3), and their colours in sRGB (n, 3)


class PosedImage(NamedTuple):
    """A posed image.

    where: its place in the file, for errors. pose: a quaternion (w, x, y, z) and a translation,
    camera from world, y down and z forward. camera: an id. name: the photograph's, relative to the
    folder of images.
    """

    where: str
    pose: list[float]
    camera: int
    name: str


def text_cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    for number, line in _lines(data):
        with _reading(number, line, _CAMERA):
            camera, model, width, height, *values = line.split()
            size = int(width), int(height)
            found[int(camera)] = colmap_lens(model, *size, list(map(float, values)))
    return found


def text_images(data: bytes) -> list[PosedImage]:
    """Return the images. Each has two lines; the second, its points, may be empty and is ignored.

    The number of images in a comment is not checked; COLMAP does not check it either.
    """
    found = []
    lines = _lines(data, blank=True)
    for number, line in lines:
        if not line:
            continue
        with _reading(number, line, _IMAGE):
            _, *pose, camera, name = line.split(None, 9)
            numbers = list(map(float, pose))
            found.append(PosedImage(f"line {number}", numbers, int(camera), name))
        # A file without the second lines has a pose of ten words here.
        number, line = next(lines, (0, ""))
        with _reading(number, line, "X Y POINT3D_ID again and again, perhaps empty"):
            if len(line) < _SHORT_BYTES and len(line.split()) % 3:
                raise ValueError
    return found


def text_points(data: bytes) -> Points:
    """Return the points. Their tracks, of any length, are ignored."""
    if not any(True for _ in _lines(data)):
        return np.zeros((0, 3)), np.zeros((0, 3), np.uint8)
    try:
        # loadtxt() decodes the file in small pieces.
        file = io.BytesIO(data.removeprefix(BOM_UTF8))
        table = np.loadtxt(file, np.float64, usecols=range(1, 8), ndmin=2)
    except (ValueError, UnicodeError):
        table = np.full((1, 6), np.nan)
    colors = table[:, 3:6].clip(0, 255)
    return _checked(table[:, :3].copy(), np.nan_to_num(colors).astype(np.uint8))


def binary_cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    file = _Binary(data)
    for entry in file.entries("camera"):
        camera, model, width, height = file.take("<IiQQ")
        with under(entry, ": "):
            if not 0 <= model < len(NAMES):
                raise LucidaError("MODEL", f"{model} is unknown", f"give 0 to {len(NAMES) - 1}")
        values = list(file.take(f"<{len(MODELS[NAMES[model]])}d"))
        with under(entry, ": "):
            found[camera] = colmap_lens(NAMES[model], width, height, values)
    return found


def binary_images(data: bytes) -> list[PosedImage]:
    found = []
    file = _Binary(data)
    for entry in file.entries("image"):
        _, *pose, camera = file.take("<I7dI")
        name = data[file.place : data.find(b"\0", file.place)]
        file.skip(len(name) + 1)
        file.skip(24 * file.take("<Q")[0])  # its points: x, y, number
        found.append(PosedImage(entry, pose, camera, name.decode("utf-8", "surrogateescape")))
    return found


def binary_points(data: bytes) -> Points:
    file = _Binary(data)
    records = []
    for _ in file.entries("point"):
        file.skip(8)  # its number
        records.append(data[file.place : file.place + _POINT.itemsize])
        file.skip(_POINT.itemsize + 8)  # and its error
        file.skip(8 * file.take("<Q")[0])  # its track
    table = np.frombuffer(b"".join(records), _POINT)
    return _checked(table["xyz"].copy(), table["rgb"].copy())


class _Binary:
    """A binary file's bytes with a read position."""

    def __init__(self, data: bytes) -> None:
        self._data, self._entry, self.place = data, "", 0

    def entries(self, what: str) -> Iterator[str]:
        """Yield the name of each entry, which must be read before the next one."""
        (count,) = self.take("<Q")
        for number in range(1, count + 1):
            self._entry = f"{what} {number} of {count}"
            yield self._entry

    def take(self, form: str) -> tuple[Any, ...]:
        """Return the next values. Raises LucidaError if the file ends within them."""
        begin = self.place
        self.skip(struct.calcsize(form))
        return struct.unpack_from(form, self._data, begin)

    def skip(self, size_bytes: int) -> None:
        self.place += size_bytes
        if self.place > len(self._data):
            problem = f"the file ends within it, at {len(self._data):,} bytes"
            raise LucidaError(self._entry, problem, "copy the complete file")


def _checked(points: Any, colors: Any) -> Points:
    if not (np.abs(points) <= LARGEST).all():
        raise LucidaError("", f"holds a point that is not within {LARGEST:g}", _REMEDY)
    return points, colors


def _lines(data: bytes, blank: bool = False) -> Iterator[tuple[int, str]]:
    """Yield the number and text of each line that is not a comment. blank: also of empty lines."""
    for count, line in enumerate(io.BytesIO(data.removeprefix(BOM_UTF8)), 1):
        line = line.strip()
        if (line or blank) and not line.startswith(b"#"):
            yield count, line.decode("utf-8", "surrogateescape")


@contextlib.contextmanager
def _reading(number: int, line: str, fields: str) -> Iterator[None]:
    """Assign this line to errors raised inside. fields: its expected content."""
    with under(f"line {number}", ": "):
        try:
            yield
        except LucidaError:
            raise
        except ValueError:
            raise LucidaError("", f"{line[:60]!r} is not {fields}", _REMEDY) from None
