"""Calibration files of OpenCV's family: OpenCV, ROS, ORB-SLAM, stella_vslam, VINS, Kalibr, and K, R
and t as they are printed.

storage.py parses the notations, opencv_keys.py knows the names.
Source: OpenCV's documentation, "Camera calibration and 3D reconstruction".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats.entries import (
    ORIGIN_TOLD,
    affine,
    flat,
    in_image,
    is_rotation,
    number_of,
    side_of,
    single,
    size_of,
)
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.literals import NAME
from renderer.camera_formats.opencv_keys import Keys, are_cameras, cameras_in, plain
from renderer.camera_formats.opencv_lens import lens_in, lens_table
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.camera_formats.rigid import rigid
from renderer.camera_formats.rotations import from_vector, to_vector
from renderer.camera_formats.storage import (
    MOST_BYTES,
    Table,
    is_ini,
    table_in,
    to_json,
    to_yaml,
)
from renderer.errors import LucidaError
from renderer.intrinsics import PixelOrigin, as_camera_from_world, decomposed, pixel_offset
from renderer.lenses import Lens

LENSES = ("brown", "fisheye", "equidistant")
_FOCAL = ("fx", "fy", "cx", "cy")
_NAMED = re.compile(NAME + "[=:]", re.MULTILINE)
# A matrix without a name in pasted text: its meaning is unknown.
_NAMELESS = re.compile(r"(?:\A|[^\s=:,\[({][ \t]*\n)\s*(?:[A-Za-z_][\w.]*\()?[\[({]\s*[\[({]")
_AGREE = 1e-4  # tolerance between R and rvec, if a file has both

_Pose = tuple[str, Floats]  # the name in the file, for errors, and camera_from_world
_AT_ORIGIN = [("", np.eye(4))]


def recognises(given: Given) -> bool:
    if len(given.data) > MOST_BYTES:
        return given.ending in (".yml", ".yaml")  # read() checks the size
    if isinstance(given.json, dict):
        names = list(given.json)
    elif given.is_text:
        if "<opencv_storage" in given.text or is_ini(given.text):
            return True
        if given.path is None and _NAMELESS.search(given.text):
            return False
        names = _NAMED.findall(given.text)
    else:
        return False
    return are_cameras({plain(name.rpartition(".")[2]) for name in names})


def read(given: Given, options: Options) -> CameraSet:
    origin = options.pixel_origin or _origin_told(given)
    return read_table(table_in(given), options, origin)


def read_table(table: Table, options: Options, origin: PixelOrigin) -> CameraSet:
    """Return the cameras of a table with any of the names in opencv_keys.py. Raises LucidaError."""
    cameras: list[PosedCamera] = []
    taken: dict[str, None] = {}
    sizing, pose = "", np.eye(4)
    found = cameras_in(table)
    for name, keys in found.items():
        if "from previous" in keys:
            previous, change = keys["from previous"]
            pose = affine(previous, change) @ pose
            keys = keys | {"from world": (previous, pose)}
        own, told, sizing = _cameras(keys, options, origin, name if len(found) > 1 else "")
        cameras += own
        taken |= dict.fromkeys(told)
    return CameraSet("opencv", tuple(cameras), tuple(taken), sizing=sizing)


def _cameras(
    keys: Keys, options: Options, origin: PixelOrigin, name: str
) -> tuple[list[PosedCamera], list[str], str]:
    """Return the cameras of one table, a camera for each of its poses; the conventions; and the
    origin of the size in words.
    """
    K_name, K, projected = _intrinsics(keys)
    size, sizing = _size(keys, K, options, origin)
    poses, told = ([projected], f"K, R and t out of {K_name}") if projected else _poses(keys)
    lens, ignored = lens_in(keys, options)
    name = name or str(keys.get("name", ("", ""))[1] or "")
    cameras = []
    for called, pose in poses:
        camera = _camera((K_name, K), (called, pose), size, origin, lens)
        own = name if len(poses) == 1 else called
        cameras.append(PosedCamera(camera, size, own, ignored=ignored))
    taken = [told, "axes x right, y down, z forward", ORIGIN_TOLD[origin]]
    taken += [sizing] if sizing else []
    if not all(is_rotation(pose[:3, :3]) for _, pose in poses):
        taken.append("R is no rotation, and held as it is")
    return cameras, taken, sizing


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    camera, size = in_image(single(cameras, "a file of OpenCV"), options, "OpenCV")
    if camera.lens is not None:
        camera = rigid(camera, "OpenCV", size)
    origin = options.pixel_origin or "center"
    K, R, t = (part + 0.0 for part in camera.intrinsics(size, origin))  # no negative zeros
    notes = [
        "A world point p is seen at the pixel K (R p + t), divided by its third part:",
        f"x to the right, y down, z forward; {ORIGIN_TOLD[origin]}.",
    ]
    table: Table = {
        "image_width": size[0],
        "image_height": size[1],
        "camera_matrix": K,
        **lens_table(camera.lens),
        "R": R,
        "t": t[:, None],
        "rvec": to_vector(R)[:, None],
    }
    if options.ending == ".json":
        return {"": to_json({"conventions": " ".join(notes)} | table).encode()}
    return {"": to_yaml(table, notes).encode()}


def _origin_told(given: Given) -> PixelOrigin:
    """Return the pixel origin that a file written by Lucida states; else OpenCV's own."""
    return "corner" if ORIGIN_TOLD["corner"] in given.text else "center"


def _intrinsics(keys: Keys) -> tuple[str, Floats, _Pose | None]:
    """Return the name of K, K itself, and the pose if both come from a projection matrix."""
    if "K" in keys:
        name, value = keys["K"]
        numbers = flat(name, value, 9, 4)
        return name, _focal(*numbers) if numbers.size == 4 else numbers.reshape(3, 3), None
    if "fx" in keys:
        for part in _FOCAL:
            if part not in keys:
                raise LucidaError(part, "is missing", "give fx, fy, cx and cy")
        K = _focal(*(number_of(*keys[part]) for part in _FOCAL))
        if "skew" in keys:
            K[0, 1] = number_of(*keys["skew"])
        return keys["fx"][0], K, None
    if "P" in keys:
        name, value = keys["P"]
        P = flat(name, value, 12).reshape(3, 4)
        with np.errstate(all="ignore"):
            try:
                inverse = np.linalg.inv(P[:, :3])
            except np.linalg.LinAlgError:
                raise LucidaError(name, "has no inverse", "give K [R | t]") from None
            sign = np.sign(np.linalg.det(inverse))  # the sign of P is arbitrary
            K, R, t = decomposed(sign * inverse, -inverse @ P[:, 3], "corner")
        return name, K, (name, np.column_stack([R, t]))
    raise LucidaError("camera_matrix", "is missing", "give it, K, or fx, fy, cx and cy")


def _focal(fx: float, fy: float, cx: float, cy: float) -> Floats:
    return np.array([[fx, 0.0, cx], [0, fy, cy], [0, 0, 1]])


def _size(keys: Keys, K: Floats, options: Options, origin: str) -> tuple[Size, str]:
    """Return the image's size, and its origin in words if the file does not state it."""
    if "size" in keys:
        name, value = keys["size"]
        width, height = flat(name, value, 2).tolist()
        return size_of(name, width, height), ""
    wide, high = keys.get("width"), keys.get("height")
    if wide and high:
        return size_of(wide[0], side_of(*wide), side_of(*high)), ""
    if wide or high:
        missing = "image_height" if wide else "image_width"
        raise LucidaError(missing, "is missing", "give both, or neither and --size WxH")
    if options.size:
        return options.size, ""
    with np.errstate(all="ignore"):
        middle = 2 * (K[:2, 2] / K[2, 2] + pixel_offset(origin))
    if not ((middle > 0.5) & (middle < 1e9)).all():
        raise LucidaError("image_width", "is missing", "give the image's size, or --size WxH")
    size = size_of("image_width", *(float(np.round(side)) for side in middle))
    told = f"no image size is given: {size[0]} x {size[1]}, whose middle is the principal point"
    return size, told


def _poses(keys: Keys) -> tuple[list[_Pose], str]:
    """Return the poses in a file, and their origin in words."""
    if found := keys.get("from world"):
        return [(found[0], affine(*found))], f"{found[0]} takes world points to the camera"
    if found := keys.get("to world"):
        pose = as_camera_from_world(affine(*found))
        return [(found[0], pose)], f"{found[0]} takes the camera's points to the world"
    if found := keys.get("views"):
        numbers = flat(*found)
        if not numbers.size or numbers.size % 6:
            problem = f"has {numbers.size} numbers"
            raise LucidaError(found[0], problem, "give 6 a row: rvec and tvec")
        rows = numbers.reshape(-1, 6)
        poses = [(f"view {i}", _rigid(from_vector(r[:3]), r[3:])) for i, r in enumerate(rows)]
        return poses, f"{found[0]}: rvec and tvec of each picture of the calibration"
    moved, turned, vector = keys.get("t"), keys.get("R"), keys.get("rvec")
    if {"P", "K"} <= keys.keys() and not moved:  # ROS: R rotates into the rectified image
        return _AT_ORIGIN, "no pose: the camera stands at the origin, not rectified"
    if not (moved or turned or vector):
        return _AT_ORIGIN, "no pose: the camera stands at the origin"
    R = np.eye(3)
    if turned:
        numbers = flat(*turned, 9, 3)
        R = numbers.reshape(3, 3) if numbers.size == 9 else from_vector(numbers)
    if vector:
        other = from_vector(flat(*vector, 3))
        if turned and np.abs(other - R).max() > _AGREE:
            problem = f"is another rotation than {turned[0]}"
            raise LucidaError(vector[0], problem, "give one of the two")
        R = R if turned else other
    t = flat(*moved, 3) if moved else np.zeros(3)
    used = [entry[0] for entry in (turned or vector, moved) if entry]
    told, name = " and ".join(used), used[0]
    lacking = "" if len(used) == 2 else f"; no {'rotation' if moved else 'translation'}"
    return [(name, _rigid(R, t))], f"{told} take world points to the camera{lacking}"


def _rigid(R: Floats, t: Floats) -> Floats:
    return np.vstack([np.column_stack([R, t]), [0, 0, 0, 1]])


def _camera(
    intrinsics: tuple[str, Floats], pose: _Pose, size: Size, origin: str, lens: Lens | None
) -> Camera:
    """Return the camera. Errors use the file's names for K and the pose."""
    try:
        return Camera.from_intrinsics(
            intrinsics[1], size=size, camera_from_world=pose[1], pixel_origin=origin, lens=lens
        )
    except LucidaError as error:
        fields = {"K": intrinsics[0], "camera_from_world": pose[0]}
        field = fields.get(error.field, error.field)
        raise LucidaError(field, error.problem, error.remedy) from None
