"""The key names of calibration files in OpenCV's family, in one table for all of its programs,
and the names of their lenses.

A file's keys become roles, for each of its cameras. Sources: OpenCV's samples calibration.cpp and
stereo_calib.cpp; ROS's CameraInfo and camera_calibration_parsers; ORB-SLAM3's
Calibration_Tutorial; stella_vslam's configurations; VINS-Fusion's configurations; Kalibr's wiki,
"Yaml formats".
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

from . import distortion
from .distortion import NAMES
from .entries import entries_of, flat, notes_on, number_of, plain
from .notations import Table

Keys = dict[str, tuple[str, Any]]  # by role: the key's name in the file, and its value

# Roles, and the names that programs use, in lower case, letters and digits only. A name inside a
# table counts with the table's name and without it: "Camera.type" is "cameratype".
_NAMES = {
    "K": "cameramatrix k intrinsics intrinsic intrinsicmatrix mtx",
    "P": "projectionmatrix p",
    **{"fx": "fx mu gamma1", "fy": "fy mv gamma2", "cx": "cx u0", "cy": "cy v0", "skew": "skew"},
    "size": "imagesize size resolution",
    "width": "imagewidth width w cameracols",
    "height": "imageheight height h camerarows",
    "R": "r rotation rotationmatrix",
    "rvec": "rvec rodrigues rotationvector",
    "t": "t tvec translation translationvector",
    "from world": "extrinsics extrinsic extrinsicmatrix rt camerafromworld worldtocamera world2cam "
    "w2c",
    "to world": "worldfromcamera cameratoworld cam2world c2w",
    "from previous": "tcncnm1",  # Kalibr's: from the camera before it
    "lens": "distortioncoefficients distortioncoefficient distortioncoeffs distortioncoeff "
    "distortioncoefs distortionparameters distortionparams distortionvector distcoeffs distcoeff "
    "distcoefs distcoef distortion dist d",
    "lens model": "distortionmodel distortiontype lensmodel projectionmodel",
    "fisheye": "fisheyemodel isfisheye",
    "camera model": "cameramodel cameratype modeltype model",
    "mirror": "xi",
    "name": "cameraname",
    **{name: name.lower() for name in (*NAMES, "omega")},
}
_ROLES = {name: role for role, names in _NAMES.items() for name in names.split()}
_NUMBERS = (*NAMES, "omega", "mirror", "width", "height")  # roles of single numbers
_CAMERA = re.compile(r"[Cc]am(?:era)?\d*")  # a table, or a prefix, of one camera
# Tables that are parts of a camera's.
_PART = re.compile(
    r"(?:^|\.)(?:(?:projection|distortion|mirror)_parameters|intrinsics?|extrinsics?|distortion|"
    r"resolution|image_size|pose)$"
)
_INTRINSIC = {"K", "P", "fx"}
_SIZES = {"size", "width", "height"}
_STEREO = re.compile(
    r"(?:(m|k|cameramatrix|intrinsicmatrix)|d|distcoeffs|distortioncoefficients)([12])"
)
_SIDES = {"1": "left", "2": "right"}
# Lens's model by the programs' names for it, in lower case, letters and digits only.
_PINHOLES = """
0 none plumbbob rationalpolynomial radtan radialtangential opencv pinhole rectified perspective
"""
_MODELS = {
    **dict.fromkeys(["", *_PINHOLES.split()], ""),
    **dict.fromkeys(["1", "equidistant", "fisheye"], "fisheye"),
    **dict.fromkeys(["kannalabrandt", "kannalabrandt4", "kannalabrandt8"], "fisheye"),
    "fov": "fov",
}
_MODEL_ROLES = ("camera model", "lens model", "fisheye")
_LENS_NAMES = {"fisheye": distortion.FISHEYE_NAMES, "fov": ("omega",)}


def are_cameras(names: set[str]) -> bool:
    """Return True if a file with these names (without table names) must hold a camera."""
    roles = {_ROLES.get(name) for name in names}
    pairs = {"m1", "m2"}, {"k1", "k2", "d1", "d2"}, {"cameramatrix1", "cameramatrix2"}
    is_stereo = any(names >= pair for pair in pairs)
    return is_stereo or not roles.isdisjoint({"K", "P"}) or roles >= {"fx", "fy"}


def cameras_in(table: Table) -> tuple[dict[str, Keys], tuple[str, ...]]:
    """Return the keys of each camera by its name ("" if it has none), and notes on unused keys.

    Of several keys with one role, the first counts.
    """
    entries, tables = list(entries_of(table)), dict[str, set[str]]()
    for name, _ in entries:
        tables.setdefault(_owner(name), set()).add(plain(name.rpartition(".")[2]))
    cameras: dict[str, Keys] = {"": {}}
    unused = []
    for name, value in entries:
        head, _, last = name.rpartition(".")
        owner, last = _owner(name), plain(last)
        role = _ROLES.get(plain(name))
        side = _STEREO.fullmatch(last)
        if side and np.size(value) > 1:
            owner, role = _SIDES[side[2]], "K" if side[1] else "lens"
        elif not owner or _CAMERA.fullmatch(owner) or are_cameras(tables[owner]):
            role = role or _ROLES.get(last)
        else:
            owner = ""
        if head == "projection_parameters" and last in ("k2", "k3", "k4", "k5"):
            role = f"k{int(last[1]) - 1}"  # Kannala and Brandt's k1 is the focal length
        keys = cameras.setdefault(owner, {})
        if role is None or role in keys or (role in _NUMBERS and np.size(value) != 1):
            unused.append(name)
        else:
            keys[role] = name, value
    shared = cameras.pop("")
    if "right" in cameras:
        cameras["right"] |= {role: shared.pop(role) for role in ("R", "t") if role in shared}
    for name in [name for name in cameras if name.lower() == "camera"]:
        if not _INTRINSIC & cameras[name].keys():  # Camera1 and Camera2 share these keys
            shared |= cameras.pop(name)
    names = sorted(cameras, key=lambda name: (len(name), name))
    if _INTRINSIC & shared.keys() and any(_INTRINSIC & cameras[name].keys() for name in names):
        names, cameras[""] = ["", *names], shared  # a camera without a table
        shared = {role: shared[role] for role in _SIZES & shared.keys()}
    found = {name: shared | cameras[name] for name in names} or {"": shared}
    return found, notes_on(unused)


def _owner(name: str) -> str:
    """Return the name of the table that holds a key, without those for parts of a camera."""
    return _PART.sub("", name.rpartition(".")[0])


def lens_in(keys: Keys) -> Lens | None:
    """Return the lens. Raises LucidaError."""
    models = [_model(*keys[role]) for role in _MODEL_ROLES if role in keys]
    model = next(filter(None, models), "brown")
    if "mirror" in keys and number_of(*keys["mirror"]):
        name, value = keys["mirror"]
        problem = f"{value!r} is for a mirror or Mei's lens, which is not supported"
        raise LucidaError(name, problem, "give a pinhole or a fisheye")
    known = _LENS_NAMES.get(model, NAMES)
    if "lens" in keys:
        name, value = keys["lens"]
        counts = distortion.COUNTS if model == "brown" else (len(known),)
        numbers = flat(name, value)
        if numbers.size not in (0, *counts):
            wanted = " or ".join(map(str, counts))
            raise LucidaError(name, f"has {numbers.size} numbers", f"give {wanted}")
        coefficients = dict(zip(known, numbers.tolist(), strict=False))
    else:
        coefficients = {name: float(flat(*keys[name])[0]) for name in known if name in keys}
    return distortion.lens_of(model, coefficients)


def _model(name: str, value: object) -> str:
    """Return a model of Lens; "" for a pinhole, perhaps with OpenCV's coefficients."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # fisheye_model: 0.
    if (found := _MODELS.get(plain(str(value)))) is None:
        remedy = "give plumb_bob, rational_polynomial or equidistant, or undistort the images first"
        raise LucidaError(name, f"{value!r} is a lens that is not supported", remedy)
    return found


def lens_table(lens: Lens | None) -> Table:
    """Return the entries of a lens in a calibration file. Raises LucidaError."""
    if lens is None:
        return {"distortion_coefficients": np.zeros((5, 1))}
    if lens.coefficient("r8"):
        problem = f"{lens.coefficient('r8'):g} is a term that OpenCV does not have"
        raise LucidaError("lens.r8", problem, "leave it out")
    table: Table = {"distortion_model": "equidistant", "fisheye_model": 1}
    names: tuple[str, ...] = distortion.FISHEYE_NAMES
    if lens.model == "brown":
        last = max((NAMES.index(name) for name in lens.coefficients), default=0)
        names = NAMES[: next(n for n in distortion.COUNTS[1:] if n > last)]
        table = {"distortion_model": "plumb_bob" if len(names) == 5 else "rational_polynomial"}
    values = [[lens.coefficient(name)] for name in names]
    return table | {"distortion_coefficients": np.array(values)}
