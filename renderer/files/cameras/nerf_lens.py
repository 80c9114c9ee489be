"""The lens of a transforms.json, as nerfstudio and instant-ngp name it.

A camera_model is the whole file's. Sources: nerfstudio's Cameras._generate_rays_from_coords();
instant-ngp, common_device.cuh.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras.distortion import FISHEYE_NAMES, FileLens, lens_of
from lucida.renderer.files.cameras.entries import number_of
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.files.cameras.posed import PosedCamera
from lucida.renderer.system.errors import LucidaError

Table = Mapping[str, Any]

_PINHOLES = ("", "PERSPECTIVE", "PINHOLE", "SIMPLE_PINHOLE")
_BROWN = ("SIMPLE_RADIAL", "RADIAL", "OPENCV")
_FISHEYES = ("OPENCV_FISHEYE", "FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE")
# The coefficients of Lens by their names here.
_OPENCV = {"k1": "k1", "k2": "k2", "k3": "k3", "k4": "r8", "p1": "p1", "p2": "p2"}
PANORAMA = "EQUIRECTANGULAR"
# The camera_model that is written, by the model of Lens.
_WRITTEN = {
    "brown": "OPENCV",
    "fisheye": "OPENCV_FISHEYE",
    "equidistant": "OPENCV_FISHEYE",
    "equirectangular": PANORAMA,
}
LENSES = tuple(_WRITTEN)
NAMES = (*_OPENCV, "latlong")


def is_panorama(table: Table) -> bool:
    return table.get("camera_model") == PANORAMA or bool(table.get("latlong"))


def lens_in(table: Table, options: Options) -> FileLens:
    """Return the lens: four radial terms and two tangential ones, as in nerfstudio; k1 to k4 of a
    fisheye.
    """
    model = table.get("camera_model", "")
    if is_panorama(table):
        return lens_of("equirectangular", {}, options)
    if model not in (*_PINHOLES, *_BROWN, *_FISHEYES):
        problem = f"{model!r} is a lens that is not supported"
        raise LucidaError("camera_model", problem, "give images of a camera with another lens")
    found = {n: number_of(n, table[n]) for n in _OPENCV if n in table}
    if model in _FISHEYES or table.get("is_fisheye") is True:
        return lens_of("fisheye", {n: found.get(n, 0.0) for n in FISHEYE_NAMES}, options)
    return lens_of("brown", {_OPENCV[n]: value for n, value in found.items()}, options)


def model_for(cameras: Sequence[PosedCamera]) -> str:
    """Return the camera_model of a file, which is for all of its frames. Raises LucidaError."""
    lenses = [posed.camera.lens for posed in cameras]
    kinds = {"PINHOLE" if lens is None else _WRITTEN[lens.model] for lens in lenses}
    if kinds == {"PINHOLE", "OPENCV"}:
        return "OPENCV"
    if len(kinds) > 1:
        problem = f"is {' and '.join(sorted(kinds))}, and a transforms.json has one for all frames"
        raise LucidaError("camera_model", problem, "choose cameras with --frame or --image")
    return kinds.pop() if kinds else "PINHOLE"


def coefficients(lens: Lens | None, model: str) -> dict[str, float]:
    """Return the lens's numbers in a frame. Raises LucidaError."""
    names = {"OPENCV": _OPENCV, "OPENCV_FISHEYE": {name: name for name in FISHEYE_NAMES}}
    known = names.get(model, {})
    if lens is None:
        return dict.fromkeys(known, 0.0)
    for name, value in lens.coefficients.items():
        if value and name not in known.values():
            problem = f"{value:g} is a term that a transforms.json has not"
            remedy = "leave it out, or give --ignore-distortion"
            raise LucidaError(f"lens.{name}", problem, remedy)
    return {written: lens.coefficient(name) for written, name in known.items()}
