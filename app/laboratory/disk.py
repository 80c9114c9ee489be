"""The size of a stored image on disk, and the files themselves.

Chooses the format of each kind; renderer/images/ has the formats.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.laboratory.kinds import BITMAP, COLOR, FLOAT, GRAY, HALF, Kind
from app.laboratory.stored import store
from renderer.atomic import atomic_write
from renderer.images import check_image_path, encode_array


@dataclass(frozen=True)
class DiskFormat:
    """A file format for a kind. note: how it keeps the numbers."""

    kind: Kind
    ending: str
    note: str

    @property
    def name(self) -> str:
        return self.ending[1:].upper()


FORMATS = (
    DiskFormat(BITMAP, ".pbm", "as they are, 8 pixels a byte"),
    DiskFormat(BITMAP, ".png", "compressed, lossless"),
    DiskFormat(GRAY, ".pgm", "as they are"),
    DiskFormat(GRAY, ".png", "compressed, lossless"),
    DiskFormat(COLOR, ".ppm", "as they are"),
    DiskFormat(COLOR, ".png", "compressed, lossless"),
    DiskFormat(HALF, ".exr", "compressed, lossless"),
    DiskFormat(FLOAT, ".pfm", "as they are"),
    DiskFormat(FLOAT, ".exr", "compressed, lossless"),
)


@dataclass(frozen=True)
class DiskRow:
    """A line of the table. storage_bytes: of the pixels in memory. file_bytes: of the file."""

    format: DiskFormat
    storage_bytes: int
    file_bytes: int


def encoded(array: NDArray, format: DiskFormat) -> bytes:
    """The file of a stored array; array: as stored.Stored has it for the format's kind."""
    return encode_array(np.ascontiguousarray(array), format.ending)


def sizes(
    color: ArrayLike,
    taken_ev: float = 0.0,
    method: str = "threshold",
    cancelled: Callable[[], bool] = lambda: False,
) -> tuple[DiskRow, ...]:
    """The size of every file of a linear image (H, W, 3): encodes each of them in memory.

    It takes a second or so for a large image: call it in a thread. cancelled: asked between the
    files; the entries so far are given where it says yes.
    """
    entries: list[DiskRow] = []
    kept = None
    for format in FORMATS:
        if cancelled():
            break
        if kept is None or kept.kind is not format.kind:
            kept = store(color, format.kind, taken_ev, method)
        entries.append(DiskRow(format, kept.storage_bytes, len(encoded(kept.array, format))))
    return tuple(entries)


def export(
    path: str | Path,
    color: ArrayLike,
    kind: Kind,
    taken_ev: float = 0.0,
    method: str = "threshold",
) -> int:
    """Write a linear image (H, W, 3) as `kind` keeps it, atomically. Return the size in bytes.

    Raises LucidaError for an ending that cannot hold the kind, or for a bad path.
    """
    endings = tuple(entry.ending for entry in FORMATS if entry.kind is kind)
    ending = check_image_path(path, endings)
    format = next(f for f in FORMATS if f.kind is kind and f.ending == ending)
    content = encoded(store(color, kind, taken_ev, method).array, format)
    with atomic_write(path) as file:
        file.write(content)
    return len(content)
