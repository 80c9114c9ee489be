"""Posed photographs of Gaussian splatting's cameras.json, Metashape's XML and Meshroom's .sfm.

Sources: camera_to_JSON() of graphdeco-inria/gaussian-splatting; Agisoft's Metashape User Manual,
"Camera models"; AliceVision, src/aliceVision/sfmDataIO/jsonIO.cpp.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats.distortion import lens_of
from renderer.camera_formats.entries import ORIGIN_TOLD, errors_within, flat, number_of, size_of
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.camera_formats.storage import xml_root
from renderer.errors import LucidaError
from renderer.intrinsics import as_camera_from_world

Table = Mapping[str, Any]

_SPLATTING = {"position", "rotation", "fx", "fy", "width", "height"}
_RADIAL = ("k1", "k2", "k3", "r8")  # Metashape's k1 to k4 of a frame camera
_ALICE = {  # Meshroom's models: of Lens, and the names of their parameters in order
    "pinhole": ("brown", ()),
    "radial1": ("brown", ("k1",)),
    "radial3": ("brown", ("k1", "k2", "k3")),
    "radialk1": ("brown", ("k1",)),
    "radialk3": ("brown", ("k1", "k2", "k3")),
    "brown": ("brown", ("k1", "k2", "k3", "p1", "p2")),
    "fisheye4": ("fisheye", ("k1", "k2", "k3", "k4")),
    "fisheye": ("fisheye", ("k1", "k2", "k3", "k4")),
}
_REMEDY = "undistort the photographs there, and export a pinhole"


class _Lens(NamedTuple):
    """A calibration: K in pixels, whole numbers at corners; a model and coefficients of Lens."""

    size: Size
    K: Floats
    model: str = "brown"
    coefficients: Mapping[str, float] = {}


def recognises(given: Given) -> bool:
    return _kind(given) is not None


def read(given: Given, options: Options) -> CameraSet:
    entries = {"splatting": _splatting, "metashape": _metashape, "meshroom": _meshroom}
    kind = _kind(given)
    if kind is None:
        raise LucidaError("", "is no reconstruction that is known", "give it without --from")
    origin = options.pixel_origin or "corner"
    cameras, lenses = [], {}
    for name, image, lens, pose in entries[kind](given):
        with errors_within(name):
            key = id(lens)
            if key not in lenses:
                lenses[key] = lens_of(lens.model, lens.coefficients, options)
            used, ignored = lenses[key]
            camera = Camera.from_intrinsics(
                lens.K, size=lens.size, camera_from_world=pose, pixel_origin=origin, lens=used
            )
        cameras.append(PosedCamera(camera, lens.size, name, image, ignored=ignored))
    program = {"splatting": "Gaussian splatting", "metashape": "Metashape", "meshroom": "Meshroom"}
    taken = (f"{program[kind]}'s poses: x right, y down, z forward", ORIGIN_TOLD[origin])
    return CameraSet("reconstruction", tuple(cameras), taken)


def _kind(given: Given) -> str | None:
    if not given.is_text:
        return None
    start = given.text.lstrip()[:1]
    if start == "<":
        return "metashape" if "<document" in given.text and "<sensor " in given.text else None
    if start not in ("[", "{"):
        return None
    table = given.json
    if isinstance(table, list) and table and isinstance(table[0], dict):
        return "splatting" if table[0].keys() >= _SPLATTING else None
    is_sfm = isinstance(table, dict) and {"views", "intrinsics", "poses"} <= table.keys()
    return "meshroom" if is_sfm and isinstance(table["views"], list) else None


_Entry = tuple[str, str, _Lens, Floats]  # name, photograph, calibration, camera_from_world


def _splatting(given: Given) -> Iterator[_Entry]:
    lenses: dict[str, _Lens] = {}
    for number, entry in enumerate(given.json):
        with errors_within(f"[{number}]"):
            if not isinstance(entry, dict) or not entry.keys() >= _SPLATTING:
                raise LucidaError("position", "is missing", "give an entry of Gaussian splatting")
            key = repr([entry[name] for name in ("fx", "fy", "width", "height")])
            if key not in lenses:
                fx, fy = (number_of(name, entry[name]) for name in ("fx", "fy"))
                size = size_of("width", entry["width"], entry["height"])
                K = _matrix(fx, fy, size[0] / 2, size[1] / 2)
                lenses[key] = _Lens(size, K)
            turned = flat("rotation", entry["rotation"], 9).reshape(3, 3)
            place = flat("position", entry["position"], 3)
            name = str(entry.get("img_name", number))
            yield (
                name,
                "",
                lenses[key],
                as_camera_from_world(np.column_stack([turned, place])),
            )


def _metashape(given: Given) -> Iterator[_Entry]:
    root = xml_root(given.text)
    for chunk in root.iter("chunk"):
        lenses = {sensor.get("id"): sensor for sensor in chunk.iter("sensor")}
        read: dict[str | None, _Lens] = {}
        world = _world(chunk.find("transform"))
        for camera in chunk.iter("camera"):
            if (text := camera.findtext("transform")) is None:
                continue  # it was not aligned
            name, sensor = str(camera.get("label", "")), camera.get("sensor_id")
            with errors_within(name):
                if sensor not in lenses:
                    raise LucidaError("sensor_id", f"{sensor!r} is missing", "export it again")
                if sensor not in read:
                    read[sensor] = _sensor(lenses[sensor])
                pose = world @ _numbers("transform", text, 16).reshape(4, 4)
                scale = np.cbrt(np.linalg.det(pose[:3, :3]))
                if not scale > 0:
                    raise LucidaError("transform", "has no inverse", "export it again")
                pose[:3, :3] /= scale
                yield name, "", read[sensor], as_camera_from_world(pose)


def _world(transform: ElementTree.Element | None) -> Floats:
    """Return world_from_chunk, (4, 4)."""
    matrix = np.eye(4)
    if transform is None or transform.find("rotation") is None:
        return matrix
    scale = _numbers("scale", transform.findtext("scale", "1"), 1)[0]
    matrix[:3, :3] = scale * _numbers("rotation", transform.findtext("rotation", ""), 9).reshape(
        3, 3
    )
    matrix[:3, 3] = _numbers("translation", transform.findtext("translation", "0 0 0"), 3)
    return matrix


def _sensor(sensor: ElementTree.Element) -> _Lens:
    """Return a sensor's calibration. Metashape's p1 and p2 are OpenCV's p2 and p1."""
    kind = sensor.get("type", "frame")
    if kind not in ("frame", "fisheye"):
        raise LucidaError("sensor", f"{kind!r} is a lens that is not supported", _REMEDY)
    adjusted = sensor.find("calibration[@class='adjusted']")
    calibration = sensor.find("calibration") if adjusted is None else adjusted
    if calibration is None:
        raise LucidaError("calibration", "is missing", "align the photographs first")
    own = [part.find("resolution") for part in (calibration, sensor)]
    sides = next((part.attrib for part in own if part is not None), {})
    width, height = (_numbers(side, sides.get(side, ""), 1)[0] for side in ("width", "height"))
    size = size_of("resolution", width, height)
    found = {
        part.tag: _numbers(part.tag, part.text or "", 1)[0]
        for part in calibration
        if part.tag != "resolution"
    }
    f = found.get("f", 0.0)
    K = _matrix(
        f + found.get("b1", 0.0),
        f,
        width / 2 + found.get("cx", 0.0),
        height / 2 + found.get("cy", 0.0),
    )
    K[0, 1] = found.get("b2", 0.0)
    p1, p2 = found.get("p2", 0.0), found.get("p1", 0.0)
    radial = [found.get(f"k{n}", 0.0) for n in range(1, 5)]
    if kind == "frame":
        bent = dict(zip(_RADIAL, radial, strict=True)) | {"p1": p1, "p2": p2}
        return _Lens(size, K, "brown", bent)
    bent = {f"k{n}": value for n, value in enumerate(radial, 1)}
    if p1 or p2:
        return _Lens(size, K, "thin_prism_fisheye", bent | {"p1": p1, "p2": p2})
    return _Lens(size, K, "fisheye", bent)


def _meshroom(given: Given) -> Iterator[_Entry]:
    table = given.json
    lenses = {str(entry.get("intrinsicId")): entry for entry in table["intrinsics"]}
    poses = {str(entry.get("poseId")): entry for entry in table["poses"]}
    read: dict[str, _Lens] = {}
    for number, view in enumerate(table["views"]):
        with errors_within(f"views[{number}]"):
            lens, pose = str(view.get("intrinsicId")), str(view.get("poseId"))
            if pose not in poses:
                continue  # it was not aligned
            if lens not in lenses:
                raise LucidaError("intrinsicId", f"{lens!r} is missing", "export it again")
            if lens not in read:
                read[lens] = _intrinsic(lenses[lens])
            place = poses[pose].get("pose", {}).get("transform", {})
            # By columns, camera from world: by rows, world from camera.
            turned = _words("rotation", place.get("rotation"), 9).reshape(3, 3)
            center = _words("center", place.get("center"), 3)
            image = str(view.get("path", ""))
            name = image.rpartition("/")[2] or str(view.get("viewId", number))
            yield name, image, read[lens], as_camera_from_world(np.column_stack([turned, center]))


def _intrinsic(entry: Table) -> _Lens:
    kind = str(entry.get("type", "pinhole"))
    bends = str(entry.get("distortionType", "none"))
    model, names = _ALICE.get(kind if bends == "none" else bends, ("", ()))
    values = _words("distortionParams", entry.get("distortionParams", []))
    if not model or (values[len(names) :] != 0).any():
        raise LucidaError("type", f"{kind} is a lens that is not supported", _REMEDY)
    width, height = (_words(side, [entry.get(side)], 1)[0] for side in ("width", "height"))
    size = size_of("width", width, height)
    pixels = entry.get("pxFocalLength")
    if pixels is not None:
        f = _words("pxFocalLength", pixels if isinstance(pixels, list) else [pixels])
    else:
        millimetres = _words("focalLength", [entry.get("focalLength")], 1)[0]
        sensor = _words("sensorWidth", [entry.get("sensorWidth")], 1)[0]
        f = np.array([millimetres / sensor * max(size) if sensor > 0 else 0.0])
    cx, cy = _words("principalPoint", entry.get("principalPoint", [0, 0]), 2)
    if abs(cx) < width / 4 and abs(cy) < height / 4:  # since 2021 it counts from the middle
        cx, cy = cx + width / 2, cy + height / 2
    coefficients = dict(zip(names, values.tolist(), strict=False))
    return _Lens(size, _matrix(f[0], f[-1], cx, cy), model, coefficients)


def _matrix(fx: float, fy: float, cx: float, cy: float) -> Floats:
    return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


def _numbers(name: str, text: str, count: int) -> Floats:
    return _words(name, text.split(), count)


def _words(name: str, words: Any, *counts: int) -> Floats:
    """Return numbers, which may be written as text. Raises LucidaError."""
    try:
        values = [float(word) for word in words]
    except (TypeError, ValueError):
        raise LucidaError(name, f"{words!r} is no list of numbers", "export it again") from None
    return flat(name, values, *counts)
