"""COLMAP's camera models, and the entries of a model's files: cameras, images, points.

The numbers and names of the models, and the order of their parameters, are those of
src/colmap/sensor/models.h. Source: that file, and COLMAP's documentation, "Camera Models".
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Size
from renderer.camera_checks import Floats, listed, number, positive
from renderer.camera_formats.entries import errors_within
from renderer.errors import LucidaError

# The parameters of each model in the file's order; "f" is both fx and fy. A model's id in binary
# files is its index here.
MODELS = {
    name: tuple(parameters.split())
    for name, parameters in {
        "SIMPLE_PINHOLE": "f cx cy",
        "PINHOLE": "fx fy cx cy",
        "SIMPLE_RADIAL": "f cx cy k",
        "RADIAL": "f cx cy k1 k2",
        "OPENCV": "fx fy cx cy k1 k2 p1 p2",
        "OPENCV_FISHEYE": "fx fy cx cy k1 k2 k3 k4",
        "FULL_OPENCV": "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6",
        "FOV": "fx fy cx cy omega",
        "SIMPLE_RADIAL_FISHEYE": "f cx cy k",
        "RADIAL_FISHEYE": "f cx cy k1 k2",
        "THIN_PRISM_FISHEYE": "fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1",
    }.items()
}
NAMES = tuple(MODELS)
# The Lens of a model by a part of its name; "brown" for all others.
_LENSES = {"THIN_PRISM": "thin_prism_fisheye", "FISHEYE": "fisheye", "FOV": "fov"}
_FOCAL = ("f", "fx", "fy")
_LARGEST_SIZE = 1_000_000  # pixels a side
_QUATERNION = ("QW", "QX", "QY", "QZ")
_POSE = (*_QUATERNION, "TX", "TY", "TZ")


class ColmapLens(NamedTuple):
    """A line of cameras.txt, checked. matrix: K, (3, 3), in pixels. model, coefficients:
    of Lens.
    """

    size: Size
    matrix: Floats
    model: str
    coefficients: dict[str, float]


class PosedImage(NamedTuple):
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


Lenses = dict[int, ColmapLens]  # by their CAMERA_ID


def add_lens(
    lenses: Lenses, camera: int, model: str, width: int, height: int, values: list[float]
) -> None:
    """Add a camera of a COLMAP model. Raises LucidaError if the id is taken or a value invalid."""
    if model not in MODELS:
        remedy = f"give one of {', '.join(NAMES)}; COLMAP's image_undistorter makes it a PINHOLE"
        raise LucidaError("MODEL", f"{model!r} is unknown", remedy)
    names = MODELS[model]
    if len(values) != len(names):
        problem = f"{model} has {len(names)} parameters, not {len(values)}"
        raise LucidaError("PARAMS", problem, f"give {', '.join(names)}")
    for name, side in (("WIDTH", width), ("HEIGHT", height)):
        if not 0 < side <= _LARGEST_SIZE:
            problem = f"{side} is not between 1 and {_LARGEST_SIZE}"
            raise LucidaError(name, problem, "give the image's size in pixels")
    known = dict(zip(names, values, strict=True))
    for name, value in known.items():
        positive(name, value, "1000, in pixels") if name in _FOCAL else number(name, value)
    if camera in lenses:
        raise LucidaError("CAMERA_ID", f"{camera} is given twice", "give each camera its own")
    fx, fy = (known.get(name, known.get("f", 0.0)) for name in ("fx", "fy"))
    K = np.array([[fx, 0, known["cx"]], [0, fy, known["cy"]], [0, 0, 1]])
    bent = {
        "k1" if name == "k" else name: value
        for name, value in known.items()
        if name not in (*_FOCAL, "cx", "cy")
    }
    kind = next((kind for name, kind in _LENSES.items() if name in model), "brown")
    lenses[camera] = ColmapLens((width, height), K, kind, bent)


def checked_image(where: str, pose: list[float], camera: int, name: str) -> PosedImage:
    """Return the image. pose: _POSE. Raises LucidaError for an invalid pose or name."""
    with errors_within(where, ": "):
        for field, value in zip(_POSE, pose, strict=True):
            number(field, value)
        if not math.hypot(*pose[:4]) > 1e-9:
            problem = f"{listed(pose[:4])} is no rotation"
            raise LucidaError(" ".join(_QUATERNION), problem, "give a quaternion of length 1")
        if not name or "\0" in name:
            raise LucidaError("NAME", f"{name!r} is no name of a photograph", "give one")
    return PosedImage(where, pose[:4], pose[4:], camera, name)
