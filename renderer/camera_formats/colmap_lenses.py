"""COLMAP's camera models: their parameters, and their deviation from a pinhole.

The numbers and names of the models, and the order of their parameters, are those of
src/colmap/sensor/models.h. Source: that file, and COLMAP's documentation, "Camera Models".
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from renderer.camera import Size
from renderer.camera_checks import Floats, number, positive
from renderer.camera_formats.posed import Distortion
from renderer.errors import LucidaError


@dataclass(frozen=True)
class LensModel:
    """A camera model.

    parameters: their names, in the file's order; "f" is both fx and fy. fisheye: replace the
    tangent of the angle to the axis with the angle, before everything else.
    """

    parameters: tuple[str, ...]
    fisheye: bool = False


def _model(parameters: str, fisheye: bool = False) -> LensModel:
    return LensModel(tuple(parameters.split()), fisheye)


# A model's id in binary files is its index here.
MODELS = {
    "SIMPLE_PINHOLE": _model("f cx cy"),
    "PINHOLE": _model("fx fy cx cy"),
    "SIMPLE_RADIAL": _model("f cx cy k"),
    "RADIAL": _model("f cx cy k1 k2"),
    "OPENCV": _model("fx fy cx cy k1 k2 p1 p2"),
    "OPENCV_FISHEYE": _model("fx fy cx cy k1 k2 k3 k4", fisheye=True),
    "FULL_OPENCV": _model("fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6"),
    "FOV": _model("fx fy cx cy omega"),
    "SIMPLE_RADIAL_FISHEYE": _model("f cx cy k", fisheye=True),
    "RADIAL_FISHEYE": _model("f cx cy k1 k2", fisheye=True),
    "THIN_PRISM_FISHEYE": _model("fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1", fisheye=True),
}
NAMES = tuple(MODELS)
_PINHOLE = {"f", "fx", "fy", "cx", "cy"}
_LARGEST_SIZE = 1_000_000  # pixels a side


@dataclass(frozen=True)
class ColmapLens:
    """A line of cameras.txt, checked. parameters: by their names in the model."""

    model: str
    size: Size
    parameters: dict[str, float]

    @property
    def matrix(self) -> Floats:
        """K, (3, 3), in pixels."""
        known = self.parameters
        fx, fy = (known.get(name, known.get("f", 0.0)) for name in ("fx", "fy"))
        return np.array([[fx, 0, known["cx"]], [0, fy, known["cy"]], [0, 0, 1]])

    @property
    def distortion(self) -> Distortion | None:
        """The lens's distortion; None for a pinhole. A fisheye is never a pinhole, even if all its
        coefficients are 0.
        """
        rest = {name: value for name, value in self.parameters.items() if name not in _PINHOLE}
        if not any(rest.values()) and not MODELS[self.model].fisheye:
            return None
        (fx, _, cx), (_, fy, cy), _ = self.matrix
        width, height = self.size
        x, y = np.meshgrid(np.array([-cx, width - cx]) / fx, np.array([-cy, height - cy]) / fy)
        with np.errstate(all="ignore"):  # polynomials may overflow far outside the lens's picture
            moved_x, moved_y = distorted(self.model, rest, x, y)
            moved = np.hypot(fx * (moved_x - x), fy * (moved_y - y))
        return Distortion(self.model, rest, float(np.max(np.nan_to_num(moved, nan=np.inf))))


def lens(model: str, width: int, height: int, values: list[float]) -> ColmapLens:
    """Return a camera of a COLMAP model. Raises LucidaError if the values are invalid."""
    if model not in MODELS:
        raise LucidaError(
            "MODEL",
            f"{model!r} is unknown",
            f"give one of {', '.join(NAMES)}; COLMAP's image_undistorter makes it a PINHOLE",
        )
    names = MODELS[model].parameters
    if len(values) != len(names):
        raise LucidaError(
            "PARAMS",
            f"{model} has {len(names)} parameters, not {len(values)}",
            f"give {', '.join(names)}",
        )
    for name, side in (("WIDTH", width), ("HEIGHT", height)):
        if not 0 < side <= _LARGEST_SIZE:
            problem = f"{side} is not between 1 and {_LARGEST_SIZE}"
            raise LucidaError(name, problem, "give the image's size in pixels")
    for name, value in zip(names, values, strict=True):
        if name in ("f", "fx", "fy"):
            positive(name, value, "1000, in pixels")
        else:
            number(name, value)
    return ColmapLens(model, (width, height), dict(zip(names, values, strict=True)))


def distorted(
    model: str, coefficients: dict[str, float], x: Floats, y: Floats
) -> tuple[Floats, Floats]:
    """Return the point to which the lens moves (x, y) at distance 1; arrays of any shape.

    Each model is a part of one formula: radial terms, over a denominator, tangential (p1, p2) and
    thin-prism (sx1, sy1) terms. A fisheye applies them to the angle. FOV has a formula of its own.
    """
    known = coefficients.get
    r = np.hypot(x, y)
    if model == "FOV":
        omega = coefficients["omega"]
        scale = np.where(r > 0, np.arctan(2 * r * math.tan(omega / 2)) / (r * omega), 1.0)
        return scale * x, scale * y
    if MODELS[model].fisheye:
        scale = np.where(r > 0, np.arctan(r) / r, 1.0)
        x, y = scale * x, scale * y
    r2 = x * x + y * y
    k1, k2, k3, k4 = (
        known("k1", known("k", 0.0)),
        known("k2", 0),
        known("k3", 0),
        known("k4", 0),
    )
    radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
    if "k5" in coefficients:  # FULL_OPENCV
        radial = radial / (1 + r2 * (k4 + r2 * (known("k5", 0) + r2 * known("k6", 0))))
    else:
        radial = radial + k4 * r2**4
    p1, p2 = known("p1", 0), known("p2", 0)
    return (
        x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + known("sx1", 0) * r2,
        y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y) + known("sy1", 0) * r2,
    )
