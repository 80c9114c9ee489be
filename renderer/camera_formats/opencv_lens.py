"""The lens of a calibration file, under any of the names that people use for its coefficients.

A lens is never dropped silently: a name that sounds like one but is unknown is an error.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from renderer.camera_formats import distortion
from renderer.camera_formats.entries import flat
from renderer.camera_formats.given import Options
from renderer.camera_formats.storage import Table
from renderer.errors import LucidaError
from renderer.lenses import Lens

# In lower case, letters and digits only.
_VECTOR = (
    *("distortioncoefficients", "distortioncoefficient", "distortioncoeffs", "distortioncoeff"),
    *("distortioncoefs", "distortionparameters", "distortionparams", "distortionvector"),
    *("distcoeffs", "distcoeff", "distcoefs", "distcoef", "distortion", "dist", "d"),
)
_MODEL = ("distortionmodel", "fisheyemodel")
_PINHOLES = (
    *("", "0", "none", "plumbbob", "rationalpolynomial", "radtan", "radialtangential"),
    *("opencv", "pinhole"),
)
_FISHEYES = ("1", "equidistant", "fisheye", "kannalabrandt", "kannalabrandt4")
_SOUNDS_LIKE_ONE = re.compile(r"dist(?!anc)|.*(?<!un)distort")


class Names:
    """A table whose values are looked up by any of several names."""

    def __init__(self, table: Table) -> None:
        self._values = {plain(name): (name, value) for name, value in table.items()}

    def __contains__(self, names: tuple[str, ...]) -> bool:
        return any(name in self._values for name in names)

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def get(self, names: tuple[str, ...]) -> tuple[str, Any] | None:
        return next((self._values[name] for name in names if name in self._values), None)


def plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())


def lens_in(names: Names, options: Options) -> distortion.FileLens:
    """Return the lens. Raises LucidaError."""
    name, value = names.get(_MODEL) or ("distortion_model", "")
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # fisheye_model: 0.
    model = plain(str(value))
    is_fisheye, is_fov = model in _FISHEYES, model == "fov"
    if not (is_fov or model in (*_PINHOLES, *_FISHEYES)):
        remedy = "give plumb_bob, rational_polynomial or equidistant, or undistort the images first"
        raise LucidaError(name, f"{value!r} is a lens that is not known", remedy)
    _check_known(names)
    known = distortion.FISHEYE_NAMES if is_fisheye else ("omega",) if is_fov else distortion.NAMES
    if found := names.get(_VECTOR):
        counts = (4,) if is_fisheye else (1,) if is_fov else distortion.COUNTS
        numbers = flat(*found)
        if numbers.size not in (0, *counts):
            wanted = " or ".join(map(str, counts))
            raise LucidaError(found[0], f"has {numbers.size} numbers", f"give {wanted}")
        coefficients = dict(zip(known, numbers.tolist(), strict=False))
    else:  # a matrix of such a name (K1, P1) belongs to another camera
        entries = {name: names.get((plain(name),)) for name in known}
        coefficients = {
            name: float(flat(*entry)[0])
            for name, entry in entries.items()
            if entry is not None and np.size(entry[1]) == 1
        }
    kind = "fisheye" if is_fisheye else "fov" if is_fov else "brown"
    return distortion.lens_of(kind, coefficients, options)


def lens_table(lens: Lens | None) -> Table:
    """Return the entries of a lens in a calibration file. Raises LucidaError."""
    if lens is None:
        return {"distortion_coefficients": np.zeros((5, 1))}
    if lens.coefficient("r8"):
        problem = f"{lens.coefficient('r8'):g} is a term that OpenCV has not"
        raise LucidaError("lens.r8", problem, "leave it out, or give --ignore-distortion")
    table: Table = {"distortion_model": "equidistant", "fisheye_model": 1}
    names = distortion.FISHEYE_NAMES
    if lens.model == "brown":
        last = max((distortion.NAMES.index(name) for name in lens.coefficients), default=0)
        names = distortion.NAMES[: next(n for n in distortion.COUNTS[1:] if n > last)]
        table = {"distortion_model": "plumb_bob" if len(names) == 5 else "rational_polynomial"}
    values = [[lens.coefficient(name)] for name in names]
    return table | {"distortion_coefficients": np.array(values)}


def _check_known(names: Names) -> None:
    for name in names:
        if name in (*_VECTOR, *_MODEL) or not _SOUNDS_LIKE_ONE.match(name):
            continue
        own_name, value = names.get((name,)) or (name, None)
        numbers = np.ravel(value) if isinstance(value, list | np.ndarray | int | float) else ()
        if any(type(number) is not bool and number for number in numbers):
            problem = "sounds like a lens's distortion, and is no name that is known"
            remedy = "call it distortion_coefficients: k1, k2, p1, p2, k3"
            raise LucidaError(own_name, problem, remedy)
