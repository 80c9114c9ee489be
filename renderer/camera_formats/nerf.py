"""NeRF's cameras: transforms.json as the synthetic scenes, instant-ngp and nerfstudio have it.

transform_matrix is camera-to-world, with OpenGL's axes: x right, y up, looking along -z.
Sources: nerfstudio's documentation, "Data conventions"; instant-ngp, "NeRF dataset tips".
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats import distortion
from renderer.camera_formats.entries import (
    ORIGIN_TOLD,
    affine,
    in_image,
    is_rotation,
    number_of,
    size_of,
)
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, Distortion, PosedCamera
from renderer.errors import LucidaError

Table = Mapping[str, Any]

_PINHOLES = ("", "PERSPECTIVE", "PINHOLE", "SIMPLE_PINHOLE")
# What instant-ngp calls lenses that are none, and poses of other axes.
_OTHER_LENSES = ("latlong", "equirectangular", "orthographic")
_BROWN = ("SIMPLE_RADIAL", "RADIAL", "OPENCV")
_FISHEYES = ("OPENCV_FISHEYE", "FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE")
_COEFFICIENTS = ("k1", "k2", "k3", "k4", "p1", "p2")
_SHARED = 1e-12  # of a number, what two frames' may differ by and be written once
_DISAGREES = 0.01  # of the focal length: files are written with few digits
_SKEW = 1e-9  # of the focal length, what is rounding

_Y_UP = np.diag([1.0, -1.0, -1.0])


def recognises(given: Given) -> bool:
    return isinstance(given.json, dict) and isinstance(given.json.get("frames"), list)


def read(given: Given, options: Options) -> CameraSet:
    table = given.json
    if not isinstance(table, dict):
        raise LucidaError("", "is no JSON object", "give a transforms.json")
    frames = table.get("frames")
    if not isinstance(frames, list):
        raise LucidaError("frames", "is missing" if frames is None else "is no list", "give frames")
    if not frames:
        raise LucidaError("frames", "is empty", "give a frame with its transform_matrix")
    folder = given.path.parent if given.path is not None else None
    size, taken = _size_for_all(table, frames, folder, options)
    cameras = []
    for i, frame in enumerate(frames):
        if not isinstance(frame, dict):
            raise LucidaError(f"frames[{i}]", "is no JSON object", "give a transform_matrix")
        try:
            cameras.append(_camera({**table, **frame}, size, folder, options))
        except LucidaError as error:
            inside = error.field in ("transform_matrix", *frame)
            raise error.within(f"frames[{i}]") if inside else error from None
    origin = options.pixel_origin or "corner"
    told = ["transform_matrix takes the camera's points to the world"]
    told += ["axes x right, y up, looking along -z (OpenGL)", ORIGIN_TOLD[origin]]
    if not all(is_rotation(camera.camera.basis) for camera in cameras):
        told.append("transform_matrix is no rotation, and held as it is")
    if any(_disagree({**table, **frame}) for frame in frames):
        told.append("fl_x is taken: camera_angle_x is another angle than fl_x and w make")
    if "applied_transform" in table:
        told.append("applied_transform is not undone: the poses stand as they are in the file")
    return CameraSet("nerf", tuple(cameras), (*told, *taken))


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    origin = options.pixel_origin or "corner"
    frames = []
    for i, posed in enumerate(cameras):
        try:
            frames.append(_frame(posed, i, options, origin))
        except LucidaError as error:
            raise error.within(posed.name) if posed.name else error from None
    shared = {
        name: value
        for name, value in (frames[0].items() if frames else ())
        if isinstance(value, int | float)
        and all(math.isclose(frame[name], value, rel_tol=_SHARED) for frame in frames)
    }
    own = [{name: frame[name] for name in frame if name not in shared} for frame in frames]
    table = {"camera_model": "PINHOLE", **shared, "frames": own}
    return {"": (json.dumps(table, indent=2, ensure_ascii=False) + "\n").encode()}


def _size_for_all(
    table: Table, frames: Sequence[Any], folder: Path | None, options: Options
) -> tuple[Size | None, tuple[str, ...]]:
    """The size for frames that have none, and what is to be told of it."""
    lacking = [
        frame for frame in frames if isinstance(frame, dict) and not {"w", "h"} & {*table, *frame}
    ]
    if not lacking or options.size is not None:
        return options.size, ()
    image = _image(lacking[0], folder)
    if found := _size_of_image(image):
        return found, (f"no w and h: the size of {image}, {found[0]} x {found[1]}",)
    return None, ("no w and h, nor an image: a square one is taken",)


def _size_of_image(path: str) -> Size | None:
    """Of an image that is there; what cannot be read is left to those who show it."""
    from PIL import Image

    try:
        if Path(path).is_file():  # a pipe might never end
            with Image.open(path) as image:
                return image.size
    except (OSError, ValueError, Image.DecompressionBombError, Image.DecompressionBombWarning):
        pass
    return None


def _image(frame: Table, folder: Path | None) -> str:
    """The photograph's path; the synthetic scenes leave its ending out. Raises LucidaError."""
    name = frame.get("file_path", "")
    if not isinstance(name, str):
        raise LucidaError("file_path", f"{name!r} is no text", "give the image's path")
    if not name:
        return ""
    path = PurePosixPath(name.replace("\\", "/"))
    if not re.fullmatch(r"\.[A-Za-z]\w*", path.suffix):
        path = PurePosixPath(f"{path}.png")
    return str(folder / path) if folder is not None else str(path)


def _camera(table: Table, size: Size | None, folder: Path | None, options: Options) -> PosedCamera:
    """A frame, with what it shares with the others."""
    if "transform_matrix" not in table:
        raise LucidaError("transform_matrix", "is missing", "give 4 x 4 numbers")
    pose = affine("transform_matrix", table["transform_matrix"])
    if any(number_of("rolling_shutter", x) for x in _listed(table, "rolling_shutter")):
        problem = "the rows of an image are taken from different places"
        raise LucidaError("rolling_shutter", problem, "give a pose for each image")
    _check_pinhole(table)
    if "w" in table or "h" in table:
        for name in "wh":
            if name not in table:
                raise LucidaError(name, "is missing", "give w and h, or neither and --size WxH")
        size = size_of("w", table["w"], table["h"])
    origin = options.pixel_origin or "corner"
    image = _image(table, folder)
    name = str(table.get("file_path", "")).removeprefix("./")
    if size is None:
        return PosedCamera(_square(table, pose), None, name, image)
    K = _intrinsics(table, size)
    try:
        camera = Camera.from_intrinsics(
            K, size=size, world_from_camera=pose, axes="opengl", pixel_origin=origin
        )
    except LucidaError as error:
        fields = {"K": "fl_x", "world_from_camera": "transform_matrix"}
        field = fields.get(error.field, error.field)
        raise LucidaError(field, error.problem, error.remedy) from None
    return PosedCamera(camera, size, name, image, distortion=_lens(table, K, size, origin))


def _check_pinhole(table: Table) -> None:
    """Raises LucidaError for the lenses and axes that instant-ngp has beside camera_model."""
    for name in _OTHER_LENSES:
        if table.get(name):
            raise LucidaError(name, "is no pinhole", "give images of a pinhole camera")
    for name in table:
        if name.startswith("ftheta_p"):
            raise LucidaError(name, "is an f-theta lens's", "give images of a pinhole camera")
    if table.get("from_mitsuba"):
        problem = "turns the axes of the poses"
        raise LucidaError("from_mitsuba", problem, "give poses with y up, looking along -z")


def _disagree(table: Table) -> bool:
    """Whether the two ways to say the focal length are there and differ by a percent."""
    angle = table.get("camera_angle_x")
    if not isinstance(angle, float) or not 0 < angle < math.pi or not {"fl_x", "w"} <= table.keys():
        return False
    fx = table["w"] / 2 / math.tan(angle / 2)
    return not math.isclose(fx, table["fl_x"], rel_tol=_DISAGREES)


def _listed(table: Table, name: str) -> Sequence[Any]:
    value = table.get(name, ())
    return value if isinstance(value, list) else ()


def _square(table: Table, pose: Floats) -> Camera:
    """A camera of which only the angle is known."""
    if "fl_x" in table or "camera_angle_x" not in table:
        raise LucidaError("w", "is missing", "give w and h, or --size WxH")
    half = _half_width(table, "camera_angle_x")
    if _lens(table, np.eye(3), (1, 1), "corner") is not None:
        problem = "is missing beside a distortion, which is in pixels"
        raise LucidaError("w", problem, "give w and h, or --size WxH")
    u, v, w, eye = (tuple(column) for column in pose[:3].T.tolist())
    return Camera(eye, u, v, w, 1.0, (-half, half, -half, half))


def _half_width(table: Table, name: str) -> float:
    """Of the image, at distance 1, by its angle in radians."""
    angle = number_of(name, table[name])
    if not 0 < angle < math.pi:
        problem = f"{angle:g} is not between 0 and pi"
        raise LucidaError(name, problem, "give the angle from edge to edge in radians")
    return math.tan(angle / 2)


def _intrinsics(table: Table, size: Size) -> Floats:
    width, height = size
    if "fl_x" in table:
        fx = number_of("fl_x", table["fl_x"])
    elif "camera_angle_x" in table:
        fx = width / 2 / _half_width(table, "camera_angle_x")
    else:
        raise LucidaError("fl_x", "is missing", "give fl_x or camera_angle_x")
    if "fl_y" in table:
        fy = number_of("fl_y", table["fl_y"])
    elif "camera_angle_y" in table and "fl_x" not in table:
        fy = height / 2 / _half_width(table, "camera_angle_y")
    else:
        fy = fx
    cx = number_of("cx", table["cx"]) if "cx" in table else width / 2
    cy = number_of("cy", table["cy"]) if "cy" in table else height / 2
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])


def _lens(table: Table, K: Floats, size: Size, origin: str) -> Distortion | None:
    """Four radial terms and two tangential ones, as nerfstudio has them; of a fisheye k1 to k4."""
    model = table.get("camera_model", "")
    if model not in (*_PINHOLES, *_BROWN, *_FISHEYES):
        problem = f"{model!r} is no pinhole"
        raise LucidaError("camera_model", problem, "give images of a pinhole camera")
    found = {n: number_of(n, table[n]) for n in _COEFFICIENTS if n in table}
    if model in _FISHEYES or table.get("is_fisheye") is True:
        found = {name: found.get(name, 0.0) for name in distortion.FISHEYE_NAMES}
        return distortion.lens(str(model) or "fisheye", found, distortion.fisheye, K, size, origin)
    bend = partial(distortion.radial_tangential, above=distortion.FISHEYE_NAMES, below=())
    return distortion.lens(str(model) or "OPENCV", found, bend, K, size, origin)


def _frame(posed: PosedCamera, index: int, options: Options, origin: str) -> dict[str, Any]:
    camera, size = in_image(posed, options, "NeRF")
    K, R, _ = camera.intrinsics(size, origin)
    if abs(K[0, 1]) > _SKEW * abs(K[0, 0]):
        problem = f"u and v are not at right angles in the image: K's skew is {K[0, 1]:g}"
        raise LucidaError("v", problem, "make the basis orthonormal, or write opencv")
    if K[0, 0] < 0:
        problem = "the basis is left-handed: a mirrored image"
        raise LucidaError("u", problem, "turn u round, or write opencv")
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R.T @ _Y_UP, camera.eye
    return {
        "file_path": posed.name or posed.image or f"frame_{index:05}",
        "w": size[0],
        "h": size[1],
        "fl_x": float(K[0, 0]),
        "fl_y": float(K[1, 1]),
        "cx": float(K[0, 2]),
        "cy": float(K[1, 2]),
        "camera_angle_x": 2 * math.atan(size[0] / 2 / float(K[0, 0])),
        "camera_angle_y": 2 * math.atan(size[1] / 2 / float(K[1, 1])),
        "transform_matrix": pose.tolist(),
    }
