"""Calibration files of OpenCV's family: OpenCV, ROS, ORB-SLAM, stella_vslam, VINS, Kalibr, and
printed K, R and t.

notations.py parses the notations; opencv_keys.py has the names.
Source: OpenCV's documentation, "Camera calibration and 3D reconstruction".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import (
    PixelOrigin,
    as_camera_from_world,
    decomposed,
    pixel_offset,
)
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

from . import entries
from .entries import ORIGIN_TOLD, affine, flat, number_of, plain
from .given import Given, Options
from .notations import MOST_BYTES, Table, assigned, is_ini, table_in, to_yaml
from .opencv_keys import Keys, are_cameras, cameras_in, lens_in, lens_table
from .posed import CameraSet, PosedCamera, in_image, one_of
from .rigid import rigid
from .rotations import from_vector

LENSES = ("brown", "fisheye", "equidistant")
_FOCAL = ("fx", "fy", "cx", "cy")

_Pose = tuple[str, Floats]  # the name in the file, for errors, and camera_from_world
_Entry = tuple[str, Any] | None  # a key of the file, and its value


def recognises(given: Given) -> bool:
    if len(given.data) > MOST_BYTES:
        return given.ending in (".yml", ".yaml")  # read() checks the size
    if isinstance(given.json, dict):
        found = entries.entries_of(given.json)
        names = [name for name, x in found if isinstance(x, dict) or entries.numbers_in(x).size]
    elif given.is_text:
        if "<opencv_storage" in given.text or is_ini(given.text):
            return True
        names = list(assigned(given.text))
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
    notes: dict[str, None] = {}
    pose = np.eye(4)
    found, unused = cameras_in(table)
    for name, keys in found.items():
        rectified: tuple[str, ...] = ()
        if "P" in keys and not {"K", "fx"}.isdisjoint(keys):
            # In ROS, P belongs to the rectified image, into which R rotates.
            rectified = ("P",) if "t" in keys else ("P", "R")
        others = [keys.pop(role)[0] for role in rectified if role in keys]
        lens = lens_in(keys)
        intrinsics = _intrinsics(keys)
        size, sizing = _size(keys, intrinsics[1], options, origin)
        (called, pose), told, more = _pose(keys, pose)
        name = (name if len(found) > 1 else "") or str(keys.get("name", ("", ""))[1] or "")
        camera = _camera(intrinsics, (called, pose), size, origin, lens)
        cameras.append(PosedCamera(camera, size, name))
        taken |= dict.fromkeys([told, "axes x right, y down, z forward", ORIGIN_TOLD[origin]])
        notes |= dict.fromkeys([*filter(None, [sizing]), *entries.notes_on([*others, *more])])
    notes |= dict.fromkeys(unused)
    return CameraSet("opencv", tuple(cameras), (*taken, *notes), notes=tuple(notes))


def write(cameras: Sequence[PosedCamera], options: Options) -> bytes:
    camera, size = in_image(one_of(cameras), options, "OpenCV")
    if camera.lens is not None:
        camera = rigid(camera, "OpenCV")
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
    }
    return to_yaml(table, notes).encode()


def _origin_told(given: Given) -> PixelOrigin:
    """Return the pixel origin that a file written by Lucida states; else OpenCV's own."""
    return "corner" if ORIGIN_TOLD["corner"] in given.text else "center"


def _intrinsics(keys: Keys) -> tuple[str, Floats]:
    """Return the name of K, and K itself."""
    if "K" in keys:
        name, value = keys["K"]
        numbers = flat(name, value, 9, 4)
        return name, _focal(*numbers) if numbers.size == 4 else numbers.reshape(3, 3)
    if "fx" in keys:
        for part in _FOCAL:
            if part not in keys:
                raise LucidaError(part, "is missing", "give fx, fy, cx and cy")
        K = _focal(*(number_of(*keys[part]) for part in _FOCAL))
        if "skew" in keys:
            K[0, 1] = number_of(*keys["skew"])
        return keys["fx"][0], K
    if "P" in keys:
        return keys["P"][0], _projected(*keys["P"])[0]
    raise LucidaError("camera_matrix", "is missing", "give it, K, or fx, fy, cx and cy")


def _projected(name: str, value: ArrayLike) -> tuple[Floats, Floats]:
    """Return K and the pose of a projection matrix."""
    P = flat(name, value, 12).reshape(3, 4)
    with np.errstate(all="ignore"):
        try:
            inverse = np.linalg.inv(P[:, :3])
        except np.linalg.LinAlgError:
            raise LucidaError(name, "has no inverse", "give K [R | t]") from None
        sign = np.sign(np.linalg.det(inverse))  # the sign of P is arbitrary
        K, R, t = decomposed(sign * inverse, -inverse @ P[:, 3], "corner")
    return K, _rigid(R, t)


def _focal(fx: float, fy: float, cx: float, cy: float) -> Floats:
    return np.array([[fx, 0.0, cx], [0, fy, cy], [0, 0, 1]])


def _size(keys: Keys, K: Floats, options: Options, origin: str) -> tuple[Size, str]:
    """Return the image's size, and its origin in words if the file does not state it."""
    if "size" in keys:
        name, value = keys["size"]
        width, height = flat(name, value, 2).tolist()
        return entries.size_of(name, width, height), ""
    wide, high = keys.get("width"), keys.get("height")
    if wide and high:
        return entries.size_of(wide[0], entries.side_of(*wide), entries.side_of(*high)), ""
    if wide or high:
        missing = "image_height" if wide else "image_width"
        raise LucidaError(missing, "is missing", "give both, or neither and --size WxH")
    if options.size:
        return options.size, ""
    with np.errstate(all="ignore"):
        middle = 2 * (K[:2, 2] / K[2, 2] + pixel_offset(origin))
    if not ((middle > 0.5) & (middle < 1e9)).all():
        raise LucidaError("image_width", "is missing", "give the image's size, or --size WxH")
    size = entries.size_of("image_width", *(float(np.round(side)) for side in middle))
    told = f"no image size is given: {size[0]} x {size[1]}, centred on the principal point"
    return size, told


def _pose(keys: Keys, previous: Floats) -> tuple[_Pose, str, list[str]]:
    """Return the pose of a camera, its origin in words, and the names of poses that are not used.

    previous: the previous camera's pose.
    """
    if found := keys.get("from previous"):
        told = f"{found[0]} places it relative to the previous camera"
        return (found[0], affine(*found) @ previous), told, []
    poses = list(_poses(keys))
    if not poses:
        return ("", np.eye(4)), "no pose: the camera is at the origin", []
    first, pose, told = poses[0]
    return (first, pose), told, [name for name, _, _ in poses[1:]]


def _poses(keys: Keys) -> Iterator[tuple[str, Floats, str]]:
    """Yield the name of each pose that a camera has, camera_from_world, and its origin in words."""
    if found := keys.get("from world"):
        yield found[0], affine(*found), f"{found[0]} takes world points to the camera"
    if found := keys.get("to world"):
        pose = as_camera_from_world(affine(*found))
        yield found[0], pose, f"{found[0]} takes the camera's points to the world"
    turned, moved = keys.get("R") or keys.get("rvec"), keys.get("t")
    if found := keys.get("P"):
        yield found[0], _projected(*found)[1], f"K, R and t from {found[0]}"
    if turned or moved:
        yield _parts(turned, moved)


def _parts(turned: _Entry, moved: _Entry) -> tuple[str, Floats, str]:
    """Return the name, the matrix and the origin in words of a rotation and a translation."""
    R = np.eye(3)
    if turned:
        numbers = flat(*turned, 9, 3)
        R = numbers.reshape(3, 3) if numbers.size == 9 else from_vector(numbers)
    t = flat(*moved, 3) if moved else np.zeros(3)
    used = [entry[0] for entry in (turned, moved) if entry]
    lacking = "" if len(used) == 2 else f"; no {'rotation' if moved else 'translation'}"
    return used[0], _rigid(R, t), f"{' and '.join(used)} take world points to the camera{lacking}"


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
