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
from lucida.renderer.camera.lenses import Lens
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
        # Since COLMAP 4. Those without an entry in _LENSES are only known by name.
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
# The model of Lens of each; "" where there is none.
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
_SAME = 1e-12  # relative: focal lengths that differ by less are one


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
    if "w" in known:  # of the whole sphere
        known |= {"fx": known["w"] / (2 * math.pi), "fy": known["h"] / math.pi}
        known |= {"cx": known["w"] / 2, "cy": known["h"] / 2}
    fx, fy = (known.get(name, known.get("f", 0.0)) for name in ("fx", "fy"))
    K = np.array([[fx, 0, known["cx"]], [0, fy, known["cy"]], [0, 0, 1]])
    bent = {lens_name(name): value for name, value in known.items() if name not in _PIXELS}
    return ColmapLens(check_size((width, height)), K, LENSES[model], bent)


def lens_name(name: str) -> str:
    """Return the name in Lens of a coefficient."""
    return "k1" if name == "k" else name


def model_for(
    lens: Lens | None, focal: tuple[float, float, float, float], size: Size
) -> tuple[str, list[float]]:
    """Return the model with the fewest parameters that holds a lens, and these.

    focal: fx, fy, cx, cy. Raises LucidaError.
    """
    if lens is None:
        return "PINHOLE", list(focal)
    fx, fy, cx, cy = focal
    known = {"fx": fx, "fy": fy, "cx": cx, "cy": cy}
    if math.isclose(fx, fy, rel_tol=_SAME):
        known["f"] = fx
    whole = (size[0] / (2 * math.pi), size[1] / math.pi, size[0] / 2, size[1] / 2)
    if lens.model == "equirectangular" and np.allclose(focal, whole, rtol=_SAME, atol=0):
        known |= {"w": size[0], "h": size[1]}
    needed = {name for name, value in lens.coefficients.items() if value}
    for model in sorted(LENSES, key=lambda model: len(MODELS[model])):
        names = MODELS[model]
        bends = {lens_name(name) for name in names if name not in _PIXELS}
        pixels = all(name in known for name in names if name in _PIXELS)
        if LENSES[model] == lens.model and pixels and needed <= bends:
            return model, [known.get(name, lens.coefficient(lens_name(name))) for name in names]
    if lens.model == "equirectangular":
        problem, remedy = "is not of the whole sphere", "give a viewport of 2 pi by pi"
    else:
        problem = f"with {', '.join(sorted(needed))} is a lens that no model of COLMAP holds"
        remedy = "leave some out, or give --ignore-distortion"
    raise LucidaError("lens", f"{lens.model} {problem}", remedy)
