"""COLMAP's camera models.

The numbers and names of the models, and the order of their parameters, are those of
src/colmap/sensor/models.h. Source: that file, and COLMAP's documentation, "Camera Models".
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.checks import Floats, number, positive
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError

# The parameters of each model in the file's order; "f" is both fx and fy. A model's id in binary
# files is its index here.
MODELS = {
    name: tuple(parameters.split())
    for name, parameters in {
        "SIMPLE_PINHOLE": "f cx cy",
        "PINHOLE": "fx fy cx cy",
        "SIMPLE_RADIAL": "f cx cy k",
        "RADIAL": "f cx cy k1 k2",
        "OPENCV": "fx fy cx cy k1 k2 p1 p2",
        "OPENCV_FISHEYE": "fx fy cx cy k1 k2 k3 k4",
        "FULL_OPENCV": "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6",
        "FOV": "fx fy cx cy omega",
        "SIMPLE_RADIAL_FISHEYE": "f cx cy k",
        "RADIAL_FISHEYE": "f cx cy k1 k2",
        "THIN_PRISM_FISHEYE": "fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1",
        # Since COLMAP 4. Only the names are known of models without an entry in _LENSES.
        "RAD_TAN_THIN_PRISM_FISHEYE": "fx fy cx cy k0 k1 k2 k3 k4 k5 p0 p1 s0 s1 s2 s3",
        "SIMPLE_DIVISION": "f cx cy k",
        "DIVISION": "fx fy cx cy k",
        "SIMPLE_FISHEYE": "f cx cy",
        "FISHEYE": "fx fy cx cy",
        "EUCM": "fx fy cx cy alpha beta",
        "EQUIRECTANGULAR": "w h",
    }.items()
}
NAMES = tuple(MODELS)
# Lens's model for each of them.
LENSES = {
    **dict.fromkeys(("SIMPLE_PINHOLE", "PINHOLE"), "brown"),
    **dict.fromkeys(("SIMPLE_RADIAL", "RADIAL", "OPENCV", "FULL_OPENCV"), "brown"),
    "FOV": "fov",
    **dict.fromkeys(("OPENCV_FISHEYE", "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE"), "fisheye"),
    "THIN_PRISM_FISHEYE": "thin_prism_fisheye",
    **dict.fromkeys(("SIMPLE_FISHEYE", "FISHEYE"), "equidistant"),
    "EQUIRECTANGULAR": "equirectangular",
}
_FOCAL = ("f", "fx", "fy", "w", "h")
_PIXELS = (*_FOCAL, "cx", "cy")


class ColmapLens(NamedTuple):
    """A line of cameras.txt, checked. matrix: K, (3, 3), in pixels. model, coefficients:
    of Lens.
    """

    size: Size
    matrix: Floats
    model: str
    coefficients: dict[str, float]


def colmap_lens(model: str, width: int, height: int, values: list[float]) -> ColmapLens:
    """Return a camera of a COLMAP model. Raises LucidaError if a value is invalid."""
    if model not in LENSES:
        remedy = f"give one of {', '.join(LENSES)}; COLMAP's image_undistorter makes it a PINHOLE"
        raise LucidaError("MODEL", f"{model!r} is a lens that is not supported", remedy)
    names = MODELS[model]
    if len(values) != len(names):
        problem = f"{model} has {len(names)} parameters, not {len(values)}"
        raise LucidaError("PARAMS", problem, f"give {', '.join(names)}")
    known = dict(zip(names, values, strict=True))
    for name, value in known.items():
        positive(name, value, "1000, in pixels") if name in _FOCAL else number(name, value)
    if "w" in known:  # a panorama of the whole sphere
        known |= {"fx": known["w"] / (2 * math.pi), "fy": known["h"] / math.pi}
        known |= {"cx": known["w"] / 2, "cy": known["h"] / 2}
    fx, fy = (known.get(name, known.get("f", 0.0)) for name in ("fx", "fy"))
    K = np.array([[fx, 0, known["cx"]], [0, fy, known["cy"]], [0, 0, 1]])
    bent = {"k1" if n == "k" else n: value for n, value in known.items() if n not in _PIXELS}
    return ColmapLens(check_size((width, height)), K, LENSES[model], bent)
