"""The key names of calibration files in OpenCV's family, in one table for all of its programs.

A file's keys become roles, for each of its cameras. Sources: OpenCV's samples calibration.cpp and
stereo_calib.cpp; ROS's CameraInfo and camera_calibration_parsers; ORB-SLAM3's
Calibration_Tutorial; stella_vslam's configurations; VINS-Fusion's configurations; Kalibr's wiki,
"Yaml formats".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from renderer.camera_formats.distortion import NAMES
from renderer.camera_formats.storage import Table
from renderer.errors import LucidaError

Keys = dict[str, tuple[str, Any]]  # by role: the file's name for it, and its value

# Roles, and the names that programs use, in lower case, letters and digits only. A name inside a
# table counts with the table's name and without it: "Camera.type" is "cameratype".
_NAMES = {
    "K": "cameramatrix k intrinsics intrinsic intrinsicmatrix mtx",
    "P": "projectionmatrix p",
    **{"fx": "fx mu", "fy": "fy mv", "cx": "cx u0", "cy": "cy v0", "skew": "skew"},
    "size": "imagesize size resolution",
    "width": "imagewidth width w cameracols",
    "height": "imageheight height h camerarows",
    "R": "r rotation rotationmatrix",
    "rvec": "rvec rodrigues rotationvector",
    "t": "t tvec translation translationvector",
    "from world": "extrinsics extrinsic extrinsicmatrix rt camerafromworld worldtocamera world2cam "
    "w2c",
    "to world": "worldfromcamera cameratoworld cam2world c2w",
    "from previous": "tcncnm1",
    "views": "extrinsicparameters",  # of a calibration's pictures: rvec and tvec, one row each
    "lens": "distortioncoefficients distortioncoefficient distortioncoeffs distortioncoeff "
    "distortioncoefs distortionparameters distortionparams distortionvector distcoeffs distcoeff "
    "distcoefs distcoef distortion dist d",
    "lens model": "distortionmodel fisheyemodel",
    "camera model": "cameramodel cameratype modeltype",
    "mirror": "xi",
    "name": "cameraname",
    **{name: name.lower() for name in (*NAMES, "omega")},
}
_ROLES = {name: role for role, names in _NAMES.items() for name in names.split()}
_NUMBERS = (*NAMES, "omega", "mirror", "width", "height")  # roles of single numbers
_CAMERA = re.compile(r"[Cc]am(?:era)?\d*")  # a table, or a prefix, of one camera
# Tables that are parts of the only camera.
_PARTS = ("", "projection_parameters", "distortion_parameters", "mirror_parameters")
_STEREO = re.compile(
    r"(?:(m|k|cameramatrix|intrinsicmatrix)|d|distcoeffs|distortioncoefficients)([12])"
)
_SIDES = {"1": "left", "2": "right"}
_SOUNDS_LIKE_LENS = re.compile(r"dist(?!anc)|.*(?<!un)distort")


def plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())


def are_cameras(names: set[str]) -> bool:
    """Return True if a file with these names, without their tables', must hold a camera."""
    roles = {_ROLES.get(name) for name in names}
    pairs = {"m1", "m2"}, {"k1", "k2", "d1", "d2"}, {"cameramatrix1", "cameramatrix2"}
    is_stereo = any(names >= pair for pair in pairs)
    return is_stereo or not roles.isdisjoint({"K", "P"}) or roles >= {"fx", "fy"}


def cameras_in(table: Table) -> dict[str, Keys]:
    """Return the keys of each camera, by its name; "" for the only one.

    Raises LucidaError for a key that sounds like a lens, and is unknown.
    """
    shared: Keys = {}
    cameras: dict[str, Keys] = {}
    for name, value in _entries(table):
        head, _, last = name.rpartition(".")
        role = _ROLES.get(plain(name)) or _ROLES.get(plain(last))
        side = _STEREO.fullmatch(plain(name))
        if side and np.size(value) > 1:
            keys = cameras.setdefault(_SIDES[side[2]], {})
            role = "K" if side[1] else "lens"
        elif name == "Stereo.T_c1_c2":
            keys, role = cameras.setdefault("Camera2", {}), "to world"
        elif _CAMERA.fullmatch(head):
            keys = cameras.setdefault(head, {})
        elif head in _PARTS:
            keys = shared
        else:
            continue
        if head == "projection_parameters" and last in ("k2", "k3", "k4", "k5"):
            role = f"k{int(last[1]) - 1}"  # Kannala and Brandt's k1 is the focal length
        if role is None:
            _check_harmless(name, last, value)
        elif role not in _NUMBERS or np.size(value) == 1:
            keys.setdefault(role, (name, value))
    if "right" in cameras:
        cameras["right"] |= {role: shared.pop(role) for role in ("R", "t") if role in shared}
    if cameras.get("Camera2", {}).keys() == {"to world"}:
        del cameras["Camera2"]  # a stereo pose of a file with one camera
    for name in [name for name in cameras if name.lower() == "camera"]:
        if not {"K", "fx"} & cameras[name].keys():  # it belongs to Camera1 and Camera2
            shared |= cameras.pop(name)
    names = sorted(cameras, key=lambda name: (len(name), name))
    return {name: shared | cameras[name] for name in names} or {"": shared}


def _entries(table: Table, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield all values, with the names of the tables that they are in."""
    for name, value in table.items():
        if isinstance(value, dict):
            yield from _entries(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def _check_harmless(name: str, last: str, value: Any) -> None:
    """Raise LucidaError for numbers, not all 0, of a name that sounds like a lens."""
    numbers = np.ravel(value) if isinstance(value, list | np.ndarray | int | float) else ()
    if _SOUNDS_LIKE_LENS.match(plain(last)) and any(
        type(number) is not bool and number for number in numbers
    ):
        problem = "sounds like a lens's distortion, and is no name that is known"
        remedy = "call it distortion_coefficients: k1, k2, p1, p2, k3"
        raise LucidaError(name, problem, remedy)
