"""COLMAP's models: a folder of cameras, images and points, as text or binary files.

K is in pixels measured from the image's corner; a pose is camera-from-world, with y down and z
forward. The files of rigs and frames, which newer versions write, add nothing to the images and are
ignored. Models are only read; a set of cameras is written as glTF.
Source: COLMAP's documentation, "Output Format".
"""

from __future__ import annotations

from collections.abc import Callable
from os.path import isdir, isfile  # unlike Path's methods, they never raise
from pathlib import Path, PureWindowsPath
from typing import TypeVar

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.intrinsics import viewport_of
from lucida.renderer.files.reading import naming, read_file
from lucida.renderer.system.errors import LucidaError, under

from . import colmap_records as records
from .distortion import lens_of
from .entries import ORIGIN_TOLD
from .given import Given, Options
from .posed import CameraSet, PosedCamera
from .rotations import rotation_of

FILES = ("cameras", "images", "points3D")
MORE_FILES = ("rigs", "frames")
LARGEST_FILE_BYTES = 1 << 30
BELOW = ("", "sparse/0", "sparse", "0")  # folders of the model in a data set
FOLDERS_UP = 3  # from the model to the folder that holds images/
_Content = TypeVar("_Content")
_READERS = {
    ".bin": (records.binary_cameras, records.binary_images, records.binary_points),
    ".txt": (records.text_cameras, records.text_images, records.text_points),
}


def recognises(given: Given) -> bool:
    return _model(given) is not None


def read(given: Given, options: Options) -> CameraSet:
    model = _model(given)
    if model is None:
        problem = "has no cameras and images of COLMAP, .bin or .txt"
        raise LucidaError("", problem, "give the folder of a model, such as sparse/0")
    folder, kind = model
    read_lenses, read_images, read_points = _READERS[kind]
    lenses = _read(folder / f"cameras{kind}", read_lenses)
    images = _read(folder / f"images{kind}", read_images)
    points = folder / f"points3D{kind}"
    # COLMAP's guide makes an empty points3D.txt for known poses.
    has_points = isfile(points) and (kind == ".bin" or points.stat().st_size)
    cloud = _read(points, read_points) if has_points else (None, None)
    origin = options.pixel_origin or "corner"
    optics = {}
    for number, found in lenses.items():
        (fx, _, cx), (_, fy, cy), _ = found.matrix.tolist()
        viewport = viewport_of(fx, fy, cx, cy, found.size, origin)
        optics[number] = viewport, lens_of(found.model, found.coefficients)
    photographs = _photographs(folder)
    numbers = np.array([image.pose for image in images]).reshape(-1, 7)
    with naming(folder / f"images{kind}"):
        poses = rotation_of(numbers[:, :4])
    eyes = -(poses.swapaxes(1, 2) @ numbers[:, 4:, None])[..., 0]
    bases = poses * np.array([[1.0], [-1.0], [-1.0]])  # to y up and z back
    posed = []
    for image, basis, eye in zip(images, bases.tolist(), eyes.tolist(), strict=True):
        with naming(folder / f"images{kind}"), under(image.where, ": "):
            if image.camera not in lenses:
                problem = f"{image.camera} is not in cameras{kind}"
                raise LucidaError("CAMERA_ID", problem, "add the camera, or correct the number")
            u, v, w = basis
            viewport, lens = optics[image.camera]
            camera = Camera(eye, u, v, w, 1.0, viewport, lens=lens)
        photograph = _photograph(photographs, image.name)
        size = lenses[image.camera].size
        posed.append(PosedCamera(camera, size, image.name, photograph))
    taken = (
        f"the {kind} files in {folder}",
        "camera from world, y down, z forward",
        ORIGIN_TOLD[origin],
    )
    return CameraSet("colmap", tuple(posed), taken, *cloud)


def _model(given: Given) -> tuple[Path, str] | None:
    """Return the folder of the model, and its files' ending; None if there is no model.

    If a file was given, the ending is its own. Otherwise binary files have priority, as in COLMAP.
    """
    if given.path is None:
        return None
    if not given.is_folder:
        kind = given.ending
        known = given.path.stem in FILES + MORE_FILES and kind in _READERS
        folder = given.path.parent
        return (folder, kind) if known and isfile(folder / f"cameras{kind}") else None
    for below in BELOW:
        for kind in _READERS:
            if isfile(given.path / below / f"cameras{kind}"):
                return given.path / below, kind
    return None


def _read(path: Path, reader: Callable[[bytes], _Content]) -> _Content:
    with naming(path):
        return reader(read_file(path, LARGEST_FILE_BYTES))


def _photographs(folder: Path) -> str | None:
    """Return the folder of the photographs: the nearest one that is named images."""
    above = [folder, *folder.absolute().parents][: FOLDERS_UP + 1]
    return next((str(up / "images") for up in above if isdir(up / "images")), None)


def _photograph(photographs: str | None, name: str) -> str:
    """Return the path of a photograph; "" for a name that leads out of the photographs' folder."""
    if photographs is None:
        return ""
    path = PureWindowsPath(name)  # accepts both slashes
    if path.anchor or ".." in path.parts:
        return ""
    return "/".join([photographs, *path.parts])
