"""Readers of COLMAP's binary models: cameras.bin, images.bin and points3D.bin.

Each function takes a file's bytes and raises LucidaError naming the entry. A count is checked
against the rest of the file before anything is allocated for it.
Source: COLMAP's documentation, "Output Format".
"""

from __future__ import annotations

from struct import Struct
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

_COUNT = Struct("<Q")
_CAMERA = Struct("<IiQQ")  # id, model, width, height; then its parameters
_IMAGE = Struct("<I4d3dI")  # id, quaternion, translation, camera; then name, count, points
_POINT_2D_BYTES = 24
_POINT = np.dtype(
    [("id", "<u8"), ("xyz", "<f8", 3), ("rgb", "u1", 3), ("error", "<f8"), ("track", "<u8")]
)
_TRACK_BYTES = 8
_AT_ONCE = 1 << 16  # points


def cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    file = _Bytes(data)
    for entry in file.entries("camera", _CAMERA.size + 3 * 8):
        with under(entry, ": "):
            identity, model, width, height = file.take(_CAMERA)
            if not 0 <= model < len(NAMES):
                remedy = f"give 0 to {len(NAMES) - 1}"
                raise LucidaError("MODEL", f"{model} is unknown", remedy)
            values = list(file.take(Struct(f"<{len(MODELS[NAMES[model]])}d")))
            add_lens(found, identity, NAMES[model], width, height, values)
    file.check_end()
    return found


def images(data: bytes) -> list[PosedImage]:
    found = []
    file = _Bytes(data)
    for entry in file.entries("image", _IMAGE.size + 2 + _COUNT.size):
        with under(entry, ": "):
            _, *pose, camera = file.take(_IMAGE)
            name = file.name()
            (count,) = file.take(_COUNT)
            file.skip(count * _POINT_2D_BYTES)
        found.append(checked_image(entry, pose, camera, name))
    file.check_end()
    return found


def points(data: bytes) -> PointRecords:
    """Return the points.

    Each record's start follows from the track length of the one before, so the starts are found one
    by one. The contents are then gathered in large batches.
    """
    file = _Bytes(data)
    size, unpack = _POINT.itemsize, _COUNT.unpack_from
    count = file.count("point", size)
    starts = np.empty(count, np.int64)
    place, end = file.place, len(data)
    for index in range(count):
        starts[index] = place
        if place + size <= end:
            place += size + _TRACK_BYTES * unpack(data, place + size - 8)[0]
        else:
            place = end + 1
        if place > end:
            problem = f"the file ends within it, at {end:,} bytes"
            raise LucidaError(f"point {index + 1} of {count}", problem, "copy the file whole")
    file.place = place
    file.check_end()
    return _gathered(data, starts)


def _gathered(data: bytes, starts: np.ndarray[Any, np.dtype[np.int64]]) -> PointRecords:
    cloud = PointRecords(np.empty((len(starts), 3)), np.empty((len(starts), 3), np.uint8))
    file = np.frombuffer(data, np.uint8)
    for first in range(0, len(starts), _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        records = file[starts[part, None] + np.arange(_POINT.itemsize)].view(_POINT)[:, 0]
        cloud.points[part], cloud.colors[part] = records["xyz"], records["rgb"]
    wrong = np.flatnonzero(~(np.abs(cloud.points) <= LARGEST).all(axis=1))
    if len(wrong):
        field = f"point {wrong[0] + 1} of {len(starts)}: XYZ"
        raise LucidaError(field, f"is not within {LARGEST:g}", "write it again with COLMAP")
    return cloud


class _Bytes:
    """A file's bytes with a read position."""

    def __init__(self, data: bytes) -> None:
        self._data, self.place = data, 0

    def count(self, what: str, smallest: int) -> int:
        """Read the number of entries. smallest: the least size of an entry in bytes."""
        (count,) = self.take(_COUNT)
        left = len(self._data) - self.place
        if count * smallest > left:
            problem = f"says {count:,} of them, {left:,} bytes hold {left // smallest:,} at most"
            raise LucidaError(f"number of {what}s", problem, "copy the file whole")
        return int(count)

    def entries(self, what: str, smallest: int) -> list[str]:
        count = self.count(what, smallest)
        return [f"{what} {number} of {count}" for number in range(1, count + 1)]

    def take(self, struct: Struct) -> tuple[Any, ...]:
        place = self.place
        self.skip(struct.size)
        return struct.unpack_from(self._data, place)

    def skip(self, size_bytes: int) -> None:
        if self.place + size_bytes > len(self._data):
            problem = f"the file ends within it, at {len(self._data):,} bytes"
            raise LucidaError("", problem, "copy the file whole")
        self.place += size_bytes

    def name(self) -> str:
        end = self._data.find(b"\0", self.place)
        if end < 0:
            raise LucidaError("NAME", "does not end", "copy the file whole")
        name, self.place = self._data[self.place : end], end + 1
        return name.decode("utf-8", "surrogateescape")

    def check_end(self) -> None:
        left = len(self._data) - self.place
        if left:
            problem = f"is followed by {left:,} bytes of no known meaning"
            raise LucidaError("the last entry", problem, "write it again with COLMAP")
