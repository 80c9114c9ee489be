"""Readers of COLMAP's models, text and binary: cameras, images and points.

Each function takes a file's bytes and raises LucidaError naming the line or the entry.
Source: COLMAP's documentation, "Output Format".
"""

from __future__ import annotations

import io
import struct
from codecs import BOM_UTF8
from collections.abc import Iterator
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.files.cameras.colmap_lenses import (
    MODELS,
    NAMES,
    Lenses,
    PointRecords,
    PosedImage,
    add_lens,
    checked_image,
)
from lucida.renderer.system.errors import LucidaError, under

# The entries of a text file, and the same in a binary one.
_CAMERA = ("CAMERA_ID", "MODEL", "WIDTH", "HEIGHT", "PARAMS")
_IMAGE = ("IMAGE_ID", "QW", "QX", "QY", "QZ", "TX", "TY", "TZ", "CAMERA_ID", "NAME")
_TEXTS = ("MODEL", "NAME")
_WHOLE = ("CAMERA_ID", "IMAGE_ID", "WIDTH", "HEIGHT")
_POINT = np.dtype([("xyz", "<f8", 3), ("rgb", "u1", 3)])  # after the id; then error and track
_SHORT_BYTES = 1000  # a longer line's words are not counted


def text_cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    for number, line in _lines(data):
        with under(f"line {number}", ": "):
            camera, model, width, height, *values = _values(line, _CAMERA, -1)
            add_lens(found, camera, model, width, height, values)
    return found


def text_images(data: bytes) -> list[PosedImage]:
    """Return the images. Each has two lines; the second, its points, may be empty and is not kept.

    The number of images in a comment is not checked; COLMAP does not check it either.
    """
    found = []
    lines = _lines(data, blank=True)
    for number, line in lines:
        if not line:
            continue
        with under(f"line {number}", ": "):
            _, *pose, camera, name = _values(line, _IMAGE, len(_IMAGE) - 1)
        found.append(checked_image(f"line {number}", pose, camera, name))
        # A file without the second lines has a pose of ten words here.
        number, line = next(lines, (0, b""))
        if len(line) < _SHORT_BYTES and len(line.split()) % 3:
            remedy = "give each image two lines, of which the second may be empty"
            raise LucidaError(f"line {number}", "is not X Y POINT3D_ID again and again", remedy)
    return found


def text_points(data: bytes) -> PointRecords:
    """Return the points. Their tracks, of any length, are ignored."""
    if not any(True for _ in _lines(data)):
        return PointRecords(np.zeros((0, 3)), np.zeros((0, 3), np.uint8))
    try:
        # loadtxt() decodes the file in small pieces.
        table = np.loadtxt(_file(data), np.float64, usecols=range(1, 8), ndmin=2)
    except (ValueError, UnicodeError):
        raise _no_point() from None
    if ((table[:, 3:6] < 0) | (table[:, 3:6] > 255)).any():
        raise _no_point()
    return _checked_points(table[:, :3].copy(), table[:, 3:6].astype(np.uint8))


def binary_cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    file = _Binary(data)
    for entry in file.entries("camera"):
        camera, model, width, height = file.take("<IiQQ")
        with under(entry, ": "):
            if not 0 <= model < len(NAMES):
                remedy = f"give 0 to {len(NAMES) - 1}"
                raise LucidaError("MODEL", f"{model} is unknown", remedy)
        values = list(file.take(f"<{len(MODELS[NAMES[model]])}d"))
        with under(entry, ": "):
            add_lens(found, camera, NAMES[model], width, height, values)
    return found


def binary_images(data: bytes) -> list[PosedImage]:
    found = []
    file = _Binary(data)
    for entry in file.entries("image"):
        _, *pose, camera = file.take("<I7dI")
        name = data[file.place : data.find(b"\0", file.place)]
        file.skip(len(name) + 1)
        file.skip(24 * file.take("<Q")[0])  # its points: x, y, number
        found.append(checked_image(entry, pose, camera, name.decode("utf-8", "surrogateescape")))
    return found


def binary_points(data: bytes) -> PointRecords:
    file = _Binary(data)
    records = []
    for _ in file.entries("point"):
        file.skip(8)  # its number
        records.append(data[file.place : file.place + _POINT.itemsize])
        file.skip(_POINT.itemsize + 8)  # and its error
        file.skip(8 * file.take("<Q")[0])  # its track
    table = np.frombuffer(b"".join(records), _POINT)
    return _checked_points(table["xyz"].copy(), table["rgb"].copy())


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
            raise LucidaError(self._entry, problem, "copy the file whole")


def _no_point() -> LucidaError:
    return LucidaError("", "holds a line that is no point", "write it again with COLMAP")


def _checked_points(points: Any, colors: Any) -> PointRecords:
    wrong = np.flatnonzero(~(np.abs(points) <= LARGEST).all(axis=1))
    if len(wrong):
        field = f"point {wrong[0] + 1} of {len(points)}: XYZ"
        raise LucidaError(field, f"is not within {LARGEST:g}", "write it again with COLMAP")
    return PointRecords(points, colors)


def _file(data: bytes) -> io.BytesIO:
    """Return the data as a file, after any byte order mark."""
    return io.BytesIO(data.removeprefix(BOM_UTF8))


def _lines(data: bytes, blank: bool = False) -> Iterator[tuple[int, bytes]]:
    """Yield the number and text of each line that is not a comment. blank: also of empty lines."""
    for count, line in enumerate(_file(data), 1):
        line = line.strip()
        if (line or blank) and not line.startswith(b"#"):
            yield count, line


def _values(line: bytes, fields: tuple[str, ...], most_splits: int) -> list[Any]:
    """Return the values of a line, of which the last field may have several. Raises LucidaError."""
    try:
        words = line.decode("utf-8").split(None, most_splits)
    except UnicodeDecodeError:
        raise LucidaError("", "is not text in UTF-8", "save the file as UTF-8 text") from None
    if len(words) < len(fields):
        problem = f"has {len(words)} of the parts {' '.join(fields)}"
        raise LucidaError("", problem, "write the line whole")
    values: list[Any] = []
    for k, word in enumerate(words):
        field = fields[min(k, len(fields) - 1)]
        kind: Any = str if field in _TEXTS else int if field in _WHOLE else float
        try:
            values.append(kind(word))
        except ValueError:
            what = "whole number" if kind is int else "number"
            raise LucidaError(field, f"{word!r} is no {what}", "mend it") from None
    return values
