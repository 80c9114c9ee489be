"""The contents of a COLMAP model's files, text or binary: cameras, images, points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera_checks import listed, number
from renderer.camera_formats.colmap_lenses import ColmapLens
from renderer.errors import LucidaError

_QUATERNION = ("QW", "QX", "QY", "QZ")
_TRANSLATION = ("TX", "TY", "TZ")

Lenses = dict[int, ColmapLens]  # by their CAMERA_ID


@dataclass(frozen=True)
class PosedImage:
    """A posed image.

    where: its place in the file, for errors. quaternion (w, x, y, z) and translation: camera from
    world, y down and z forward. camera: an id. name: the photograph's, relative to the folder of
    images.
    """

    where: str
    quaternion: list[float]
    translation: list[float]
    camera: int
    name: str


class PointRecords(NamedTuple):
    """Points, float64 (n, 3), and their colours in sRGB, uint8 (n, 3)."""

    points: NDArray[np.float64]
    colors: NDArray[np.uint8]


def checked_image(
    where: str, quaternion: list[float], translation: list[float], camera: int, name: str
) -> PosedImage:
    """Return the image. Raises LucidaError for an invalid pose or name."""
    for names, values in ((_QUATERNION, quaternion), (_TRANSLATION, translation)):
        for field, value in zip(names, values, strict=True):
            number(f"{where}: {field}", value)
    if not math.hypot(*quaternion) > 1e-9:
        problem = f"{listed(quaternion)} is no rotation"
        raise LucidaError(f"{where}: QW QX QY QZ", problem, "give a quaternion of length 1")
    if not name or "\0" in name:
        problem = f"{name!r} is no name of a photograph"
        raise LucidaError(f"{where}: NAME", problem, "give one")
    return PosedImage(where, quaternion, translation, camera, name)


def add_lens(lenses: Lenses, number: int, lens: ColmapLens) -> None:
    """Add a lens. Raises LucidaError for an id that is taken."""
    if number in lenses:
        raise LucidaError("CAMERA_ID", f"{number} is given twice", "give each camera its own")
    lenses[number] = lens


def at(where: str, error: LucidaError) -> LucidaError:
    """Return the error, with its line or entry before its field."""
    field = f"{where}: {error.field}" if error.field else where
    return LucidaError(field, error.problem, error.remedy)
