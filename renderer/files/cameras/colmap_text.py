"""Readers of COLMAP's text models: cameras.txt, images.txt and points3D.txt.

Each function takes a file's bytes and raises LucidaError naming the line and the field.
Source: COLMAP's documentation, "Output Format".
"""

from __future__ import annotations

import io
from codecs import BOM_UTF8
from collections.abc import Callable, Iterator
from typing import TypeVar

import numpy as np

from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.files.cameras.colmap_lenses import (
    Lenses,
    PointRecords,
    PosedImage,
    add_lens,
    checked_image,
)
from lucida.renderer.system.errors import LucidaError, under

_Number = TypeVar("_Number", int, float)

_CAMERA = ("CAMERA_ID", "MODEL", "WIDTH", "HEIGHT")
_IMAGE = ("IMAGE_ID", "QW", "QX", "QY", "QZ", "TX", "TY", "TZ", "CAMERA_ID", "NAME")
_SHORT_BYTES = 1000  # a longer line's words are not counted


def cameras(data: bytes) -> Lenses:
    found: Lenses = {}
    for count, line in _lines(data):
        with under(f"line {count}", ": "):
            identity, model, width, height, *parameters = _words(line, _CAMERA, -1)
            sides = zip(("CAMERA_ID", "WIDTH", "HEIGHT"), (identity, width, height), strict=True)
            camera, wide, high = (_number(int, field, word) for field, word in sides)
            values = [_number(float, "PARAMS", word) for word in parameters]
            add_lens(found, camera, model, wide, high, values)
    return found


def images(data: bytes) -> list[PosedImage]:
    """Return the images. Each has two lines; the second, its points, may be empty and is not kept.

    The number of images in a comment is not checked; COLMAP does not check it either.
    """
    found = []
    lines = _lines(data, blank=True)
    for count, line in lines:
        if not line:
            continue
        with under(f"line {count}", ": "):
            words = _words(line, _IMAGE, len(_IMAGE) - 1)
            pose = [
                _number(float, field, word)
                for field, word in zip(_IMAGE[1:8], words[1:8], strict=True)
            ]
            camera = _number(int, "CAMERA_ID", words[8])
        found.append(checked_image(f"line {count}", pose, camera, words[9]))
        # A file without the second lines has a pose of ten words here.
        count, line = next(lines, (0, b""))
        if len(line) < _SHORT_BYTES and len(line.split()) % 3:
            remedy = "give each image two lines, of which the second may be empty"
            raise LucidaError(f"line {count}", "is not X Y POINT3D_ID again and again", remedy)
    return found


def points(data: bytes) -> PointRecords:
    """Return the points. Their tracks, of any length, are ignored."""
    if not any(True for _ in _lines(data)):
        return PointRecords(np.zeros((0, 3)), np.zeros((0, 3), np.uint8))
    try:
        # loadtxt() decodes the file in small pieces.
        table = np.loadtxt(_file(data), np.float64, usecols=range(1, 8), ndmin=2)
        colors = table[:, 3:6]
        if (np.abs(table[:, :3]) <= LARGEST).all() and ((colors >= 0) & (colors <= 255)).all():
            return PointRecords(table[:, :3].copy(), colors.astype(np.uint8))
    except (ValueError, UnicodeError):
        pass
    raise LucidaError("", "holds a line that is no point", "write it again with COLMAP")


def _file(data: bytes) -> io.BytesIO:
    """Return the data as a file, after any byte order mark."""
    file = io.BytesIO(data)
    file.seek(len(BOM_UTF8) if data.startswith(BOM_UTF8) else 0)
    return file


def _lines(data: bytes, blank: bool = False) -> Iterator[tuple[int, bytes]]:
    """Yield the number and text of each line that is not a comment. blank: also of empty lines."""
    for count, line in enumerate(_file(data), 1):
        line = line.strip()
        if (line or blank) and not line.startswith(b"#"):
            yield count, line


def _words(line: bytes, fields: tuple[str, ...], most_splits: int) -> list[str]:
    try:
        words = line.decode("utf-8").split(None, most_splits)
    except UnicodeDecodeError:
        raise LucidaError("", "is not text in UTF-8", "save the file as UTF-8 text") from None
    if len(words) < len(fields):
        problem = f"has {len(words)} of the parts {' '.join(fields)}"
        raise LucidaError("", problem, "write the line whole")
    return words


def _number(kind: Callable[[str], _Number], field: str, word: str) -> _Number:
    try:
        return kind(word)
    except ValueError:
        what = "whole number" if kind is int else "number"
        raise LucidaError(field, f"{word!r} is no {what}", "mend it") from None
