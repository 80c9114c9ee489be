"""Calibrations of ORB-SLAM, VINS, Kalibr, OpenCV's stereo and ROS's .ini: one or several cameras in
one file.

Each kind becomes tables with the names of OpenCV's files, one for each camera, which opencv.py
reads. Sources: ORB-SLAM3's Calibration_Tutorial; the configurations of VINS-Fusion; Kalibr's wiki,
"Yaml formats"; OpenCV's samples/cpp/stereo_calib.cpp; ROS's camera_calibration_parsers.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import opencv
from renderer.camera_formats.entries import affine, errors_within
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.opencv_lens import plain
from renderer.camera_formats.posed import CameraSet
from renderer.camera_formats.storage import Table, table_in
from renderer.errors import LucidaError
from renderer.intrinsics import as_camera_from_world

Tables = dict[str, Table]  # by the cameras' names

_ORB = re.compile(r"Camera\d?\.fx$")
_KALIBR = re.compile(r"cam\d+$")
_STEREO = re.compile(r"(?:m|k|cameramatrix|intrinsicmatrix)([12])$")
_INI = re.compile(
    r"^(width|height|camera matrix|distortion|rectification|projection)[ \t]*\n"
    r"((?:[ \t]*\n|[-+\d.eE \t]+\n)+)",
    re.MULTILINE,
)
_REMEDY = "calibrate it as a pinhole with radtan or equidistant distortion"


def recognises(given: Given) -> bool:
    return _kind(given) is not None


def read(given: Given, options: Options) -> CameraSet:
    kind = _kind(given)
    if kind is None:
        raise LucidaError("", "is no calibration that is known", "give it without --from")
    tables = kind(given)
    sets = []
    for name, table in tables.items():
        with errors_within(name if len(tables) > 1 else ""):
            sets.append(opencv.read_table(table, options, options.pixel_origin or "center"))
    cameras = [
        replace(found.cameras[0], name=name if len(tables) > 1 else "")
        for name, found in zip(tables, sets, strict=True)
    ]
    taken = tuple(dict.fromkeys(phrase for found in sets for phrase in found.taken))
    return CameraSet("calibration", tuple(cameras), taken, sizing=sets[0].sizing)


def _kind(given: Given) -> Callable[[Given], Tables] | None:
    if not given.is_text or given.is_folder:
        return None
    if given.ending == ".ini" or (given.path is None and "[image]" in given.text):
        return _ros_ini if _INI.search(given.text) else None
    names = re.findall(r"^([A-Za-z][\w.]*)[ \t]*:", given.text, re.MULTILINE)
    if any(_ORB.match(name) for name in names):
        return _orb_slam
    if "projection_parameters" in names or ("model_type" in names and "camera_name" in names):
        return _vins
    if any(_KALIBR.match(name) for name in names):
        return _kalibr
    matrices = re.findall(r"^(\w+)[ \t]*:[ \t]*(?:!!|\[|\n)", given.text, re.MULTILINE)
    numbered = [_STEREO.match(plain(name)) for name in matrices]
    is_stereo = {"1", "2"} <= {match[1] for match in numbered if match}
    return _stereo if is_stereo else None


def _orb_slam(given: Given) -> Tables:
    table = table_in(given)
    found: Tables = {}
    for prefix in ("Camera", "Camera1", "Camera2"):
        own = {
            name.partition(".")[2]: table[name] for name in table if name.startswith(f"{prefix}.")
        }
        if "fx" not in own:
            continue
        shared = {
            name: table[f"Camera.{name}"]
            for name in ("width", "height")
            if f"Camera.{name}" in table
        }
        kind = str(own.pop("type", table.get("Camera.type", "PinHole")))
        if kind not in ("PinHole", "Rectified", "KannalaBrandt8"):
            raise LucidaError(f"{prefix}.type", f"{kind!r} is no lens that is known", _REMEDY)
        names = (
            "fx",
            "fy",
            "cx",
            "cy",
            "k1",
            "k2",
            "p1",
            "p2",
            "k3",
            "k4",
            "k5",
            "k6",
            "width",
            "height",
        )
        found[prefix] = shared | {name: own[name] for name in names if name in own}
        found[prefix]["distortion_model"] = "equidistant" if kind == "KannalaBrandt8" else ""
    if "Camera2" in found and "Stereo.T_c1_c2" in table:
        pose = affine("Stereo.T_c1_c2", table["Stereo.T_c1_c2"])
        found["Camera2"]["extrinsics"] = as_camera_from_world(pose)
    return found


def _vins(given: Given) -> Tables:
    table = table_in(given)
    model = str(table.get("model_type", "PINHOLE"))
    focal = _table(table, "projection_parameters")
    bent = table.get("distortion_parameters") or {}
    own: Table = {name: table[name] for name in ("image_width", "image_height") if name in table}
    if model == "PINHOLE":
        own |= {name: focal[name] for name in ("fx", "fy", "cx", "cy") if name in focal}
        own |= {name: bent[name] for name in ("k1", "k2", "p1", "p2") if name in bent}
    elif model == "KANNALA_BRANDT":
        names = {"mu": "fx", "mv": "fy", "u0": "cx", "v0": "cy"}
        names |= {f"k{n + 1}": f"k{n}" for n in range(1, 5)}
        own |= {names[name]: value for name, value in focal.items() if name in names}
        own["distortion_model"] = "equidistant"
    else:
        raise LucidaError("model_type", f"{model!r} is a lens that is not supported", _REMEDY)
    return {"camera": own}


def _kalibr(given: Given) -> Tables:
    table = table_in(given)
    found: Tables = {}
    pose: Floats = np.eye(4)
    for name in sorted(filter(_KALIBR.match, table), key=lambda name: int(name[3:])):
        with errors_within(name):
            own = _table(table, name)
            model, bends = own.get("camera_model", "pinhole"), own.get("distortion_model", "none")
            if model != "pinhole":
                problem = f"{model!r} is a lens that is not supported"
                raise LucidaError("camera_model", problem, _REMEDY)
            if "T_cn_cnm1" in own:
                pose = affine("T_cn_cnm1", own["T_cn_cnm1"]) @ pose
            found[name] = {
                "intrinsics": own.get("intrinsics"),
                "distortion_model": bends,
                "distortion_coeffs": own.get("distortion_coeffs", []),
                "camera_from_world": pose,
            }
            if "resolution" in own:
                found[name]["resolution"] = own["resolution"]
    return found


def _stereo(given: Given) -> Tables:
    table = table_in(given)
    sides: dict[str, Table] = {"1": {}, "2": {}}
    for name, value in table.items():
        short = plain(name)
        if match := _STEREO.match(short):
            sides[match[1]]["camera_matrix"] = value
        elif short[:-1] in ("d", "distcoeffs", "distortioncoefficients") and short[-1] in sides:
            sides[short[-1]]["distortion_coefficients"] = value
        elif short in ("imagewidth", "imageheight", "imagesize", "width", "height", "size"):
            for side in sides.values():
                side[name] = value
        elif short in ("r", "t"):
            sides["2"][name] = value
    return {"left": sides["1"], "right": sides["2"]}


def _ros_ini(given: Given) -> Tables:
    found: Table = {}
    names = {"camera matrix": "camera_matrix", "distortion": "distortion_coefficients"}
    for name, text in _INI.findall(given.text):
        numbers = [float(word) for word in text.split()]
        if name in ("width", "height"):
            found[name] = numbers[0] if numbers else None
        elif name in names:
            found[names[name]] = numbers
    return {"camera": found}


def _table(table: Table, name: str) -> dict[str, Any]:
    value = table.get(name)
    if not isinstance(value, dict):
        raise LucidaError(name, "is missing", "give it as a table of names and numbers")
    return value
