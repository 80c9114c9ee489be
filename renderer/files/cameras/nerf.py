"""NeRF's cameras: transforms.json as in the synthetic scenes, instant-ngp and nerfstudio.

The format is only read. transform_matrix is camera-to-world, with OpenGL's axes: x right, y up,
looking along -z. A camera_model applies to the whole file.
Sources: nerfstudio's documentation, "Data conventions", and its
Cameras._generate_rays_from_coords(); instant-ngp, "NeRF dataset tips" and common_device.cuh.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import pixel_offset
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

from .distortion import FISHEYE_NAMES, lens_of
from .entries import ORIGIN_TOLD, affine, notes_on, number_of, size_of
from .given import Given, Options
from .posed import CameraSet, PosedCamera

Table = Mapping[str, Any]

# The coefficients of Lens by their names here: four radial and two tangential ones.
_OPENCV = {"k1": "k1", "k2": "k2", "k3": "k3", "k4": "r8", "p1": "p1", "p2": "p2"}
_FISHEYE = {name: name for name in FISHEYE_NAMES}
# The model of Lens by the name of a camera_model.
_MODELS = {
    **dict.fromkeys(("", "PERSPECTIVE", "PINHOLE", "SIMPLE_PINHOLE"), "brown"),
    **dict.fromkeys(("SIMPLE_RADIAL", "RADIAL", "OPENCV"), "brown"),
    **dict.fromkeys(("SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE", "FISHEYE"), "fisheye"),
    "OPENCV_FISHEYE": "fisheye",
}

_USED = {
    *("frames", "transform_matrix", "file_path", "camera_model", "is_fisheye"),
    *("fl_x", "fl_y", "cx", "cy", "w", "h", "camera_angle_x", "camera_angle_y"),
    *_OPENCV,
}
_ENDING = re.compile(r"[^.]\.[A-Za-z]\w*\Z")
_ANY_SIZE = (1000, 1000)  # of an image with only a known angle


def recognises(given: Given) -> bool:
    table = given.json
    frames = table.get("frames") if isinstance(table, dict) else None
    return isinstance(frames, list) and any(
        isinstance(part, dict) and "transform_matrix" in part for part in (table, *frames)
    )


def read(given: Given, options: Options) -> CameraSet:
    table = given.json if isinstance(given.json, dict) else {}
    frames = table.get("frames")
    if not (isinstance(frames, list) and frames and all(isinstance(f, dict) for f in frames)):
        problem = "are missing, or not a list of JSON objects"
        raise LucidaError("frames", problem, "give frames, each with a transform_matrix")
    folder = given.path and given.path.parent
    origin = options.pixel_origin or "corner"
    cameras = []
    tables = [{**table, **frame} for frame in frames]
    for i, whole in enumerate(tables):
        try:
            cameras.append(_camera(whole, folder, options))
        except LucidaError as error:
            inside = error.field in ("transform_matrix", *frames[i])
            raise error.within(f"frames[{i}]") if inside else error from None
    taken = ["transform_matrix takes the camera's points to the world"]
    taken += ["axes x right, y up, looking along -z (OpenGL)", ORIGIN_TOLD[origin]]
    if any(map(_disagree, tables)):
        taken.append("fl_x is taken: camera_angle_x is another angle than fl_x and w make")
    notes = ["no w and h: a square image is taken"] * (cameras[0].size is None)
    unused = (name for part in (table, *frames) for name in part if name not in _USED)
    notes += notes_on(unused)
    return CameraSet("nerf", tuple(cameras), (*taken, *notes), notes=tuple(notes))


def _disagree(table: Table) -> bool:
    """Return True if both forms of the focal length are given and differ by more than 1 %."""
    if not {"fl_x", "w", "camera_angle_x"} <= table.keys():
        return False
    fx = table["w"] / 2 / _half_width(table, "camera_angle_x")
    return not math.isclose(fx, table["fl_x"], rel_tol=0.01)


def _image(name: object, folder: Path | None) -> str:
    """Return the photograph's path; the synthetic scenes omit its ending. Raises LucidaError."""
    if not isinstance(name, str):
        raise LucidaError("file_path", f"{name!r} is not text", "give the image's path")
    if not name:
        return ""
    path = (folder or Path()) / PurePosixPath(name.replace("\\", "/"))
    return str(path if _ENDING.search(path.name) else path.with_name(f"{path.name}.png"))


def _camera(table: Table, folder: Path | None, options: Options) -> PosedCamera:
    """Return the camera of a frame. table: of the file and of the frame. Raises LucidaError."""
    name = table.get("file_path", "")
    image = _image(name, folder)
    if "transform_matrix" not in table:
        raise LucidaError("transform_matrix", "is missing", "give 4 x 4 numbers")
    world_from_camera = affine("transform_matrix", table["transform_matrix"])
    size = options.size
    if "w" in table or "h" in table:
        for side in "wh":
            if side not in table:
                raise LucidaError(side, "is missing", "give w and h, or neither and --size WxH")
        size = size_of("w", table["w"], table["h"])
    if size is None and ("fl_x" in table or "camera_angle_x" not in table):
        raise LucidaError("w", "is missing", "give w and h, or --size WxH")
    pixels = size or _ANY_SIZE
    K = _intrinsics(table, pixels, pixel_offset(options.pixel_origin or "corner"))
    lens = _lens(table)
    try:
        with np.errstate(all="ignore"):
            pose = np.linalg.inv(world_from_camera)
        camera = Camera.from_intrinsics(
            K, size=pixels, camera_from_world=pose, axes="opengl", pixel_origin="corner", lens=lens
        )
    except np.linalg.LinAlgError:
        raise LucidaError("transform_matrix", "has no inverse", "give a rotation") from None
    except LucidaError as error:
        field = "fl_x" if error.field == "K" else "transform_matrix"
        raise LucidaError(field, error.problem, error.remedy) from None
    return PosedCamera(camera, size, name.removeprefix("./"), image)


def _intrinsics(table: Table, size: Size, offset: float) -> Floats:
    """Return K, measured from the image's corner. offset: of the file's whole numbers from it."""
    width, height = size

    def entry(name: str, default: float) -> float:
        return number_of(name, table[name]) if name in table else default

    if "fl_x" in table:
        fx = fy = entry("fl_x", 0.0)
    elif "camera_angle_x" in table:
        fx = fy = width / 2 / _half_width(table, "camera_angle_x")
        if "camera_angle_y" in table:
            fy = height / 2 / _half_width(table, "camera_angle_y")
    else:
        raise LucidaError("fl_x", "is missing", "give fl_x or camera_angle_x")
    fy = entry("fl_y", fy)
    cx, cy = entry("cx", width / 2) + offset, entry("cy", height / 2) + offset
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])


def _half_width(table: Table, name: str) -> float:
    """Return half the image's width at distance 1, from its angle in radians."""
    angle = number_of(name, table[name])
    if not 0 < angle < math.pi:
        problem = f"{angle:g} is not between 0 and pi"
        raise LucidaError(name, problem, "give the angle from edge to edge in radians")
    return math.tan(angle / 2)


def _lens(table: Table) -> Lens | None:
    given = table.get("camera_model", "")
    model = _MODELS.get(given) if isinstance(given, str) else None
    if model is None:
        problem = f"{given!r} is a lens that is not supported"
        raise LucidaError("camera_model", problem, "give images of a camera with another lens")
    if model == "brown" and table.get("is_fisheye") is True:
        model = "fisheye"
    names = _FISHEYE if model == "fisheye" else _OPENCV
    found = {own: number_of(name, table[name]) for name, own in names.items() if name in table}
    return lens_of(model, found)
