"""The lens of a calibration file.

A lens is never dropped silently: a model that is unknown is an error.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import distortion
from lucida.renderer.files.cameras.entries import flat, number_of
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.files.cameras.opencv_keys import Keys, bare
from lucida.renderer.files.cameras.storage import Table
from lucida.renderer.system.errors import LucidaError

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
_NAMES = {"fisheye": distortion.FISHEYE_NAMES, "fov": ("omega",)}


def lens_in(keys: Keys, options: Options) -> distortion.FileLens:
    """Return the lens. Raises LucidaError."""
    models = [_model(*keys[role]) for role in _MODEL_ROLES if role in keys]
    model = next(filter(None, models), "brown")
    if "mirror" in keys and number_of(*keys["mirror"]):
        name, value = keys["mirror"]
        problem = f"{value!r} is of a mirror or Mei's lens, which is not supported"
        raise LucidaError(name, problem, "give a pinhole or a fisheye")
    known = _NAMES.get(model, distortion.NAMES)
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
    return distortion.lens_of(model, coefficients, options)


def _model(name: str, value: object) -> str:
    """Return a model of Lens; "" for a pinhole, perhaps with OpenCV's coefficients."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # fisheye_model: 0.
    if (found := _MODELS.get(bare(str(value)))) is None:
        remedy = "give plumb_bob, rational_polynomial or equidistant, or undistort the images first"
        raise LucidaError(name, f"{value!r} is a lens that is not supported", remedy)
    return found


def lens_table(lens: Lens | None) -> Table:
    """Return the entries of a lens in a calibration file. Raises LucidaError."""
    if lens is None:
        return {"distortion_coefficients": np.zeros((5, 1))}
    if lens.coefficient("r8"):
        problem = f"{lens.coefficient('r8'):g} is a term that OpenCV has not"
        raise LucidaError("lens.r8", problem, "leave it out, or give --ignore-distortion")
    table: Table = {"distortion_model": "equidistant", "fisheye_model": 1}
    names: tuple[str, ...] = distortion.FISHEYE_NAMES
    if lens.model == "brown":
        last = max((distortion.NAMES.index(name) for name in lens.coefficients), default=0)
        names = distortion.NAMES[: next(n for n in distortion.COUNTS[1:] if n > last)]
        table = {"distortion_model": "plumb_bob" if len(names) == 5 else "rational_polynomial"}
    values = [[lens.coefficient(name)] for name in names]
    return table | {"distortion_coefficients": np.array(values)}
