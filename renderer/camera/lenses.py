"""Lenses: maps between directions and image points without a projection matrix.

A lens maps a direction to a point (a, b) of the image plane at distance 1, with the axes of
computer vision: a to the right, b downwards, and directions (X, Y, Z) with Z forwards. It does so
in two steps: an ideal projection to a plane (the pinhole's, a fisheye's), then a polynomial map of
that plane, the distortion. The image of a lens ends where one of the two is no longer one-to-one.
Sources: OpenCV's documentation, "Camera calibration" and "Fisheye camera model"; COLMAP's
documentation, "Camera Models"; Devernay and Faugeras, Straight lines have to be straight (2001);
Kannala and Brandt, A generic camera model (2006).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.system.errors import LucidaError

from .checks import Floats, number
from .distortion import FARTHEST, Distortion, Point, first_fold

# The coefficients of each model; missing ones are 0. r8 is the fourth radial one, of r^8, which
# Metashape and nerfstudio call k4.
MODELS: dict[str, tuple[str, ...]] = {
    "brown": ("k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "s1", "s2", "s3", "s4", "r8"),
    "fisheye": ("k1", "k2", "k3", "k4"),
    "fov": ("omega",),
    "thin_prism_fisheye": ("k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"),
    "equidistant": (),
    "stereographic": (),
    "equisolid": (),
    "orthographic": (),
    "equirectangular": (),
    "cylindrical": (),
}
USUAL = {"brown": ("k1", "k2", "p1", "p2", "k3")}  # coefficients that most calibrations have


@dataclass(frozen=True, slots=True)
class Lens:
    """A lens of a model in MODELS, with its coefficients.

    coefficients: by name; those missing are 0. Raises LucidaError naming the field.
    """

    model: str
    coefficients: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.model, str) or self.model not in MODELS:
            remedy = f"give one of {', '.join(MODELS)}"
            raise LucidaError("lens.model", f"{self.model!r} is unknown", remedy)
        given: object = self.coefficients
        if not isinstance(given, Mapping):
            problem = f"are a {type(given).__name__}"
            raise LucidaError("lens.coefficients", problem, 'give e.g. {"k1": -0.2}')
        names = MODELS[self.model]
        for name in self.coefficients:
            if name not in names:
                remedy = f"give {', '.join(names)}" if names else "leave it out"
                raise LucidaError(f"lens.{name}", f"is not a coefficient of {self.model}", remedy)
        known = {
            name: number(f"lens.{name}", self.coefficients[name])
            for name in names
            if name in self.coefficients
        }
        object.__setattr__(self, "coefficients", known)
        if self.model == "fov" and not 0 < self.coefficient("omega") < math.pi:
            problem = f"{self.coefficient('omega'):g} is not between 0 and pi"
            raise LucidaError("lens.omega", problem, "give the angle in radians")

    def __hash__(self) -> int:
        return hash((self.model, *self.coefficients.items()))

    def __str__(self) -> str:
        """Return the model and the coefficients: brown, k1 = -0.2."""
        numbers = (f"{name} = {value:g}" for name, value in self.coefficients.items())
        return ", ".join([self.model, *numbers])

    def coefficient(self, name: str) -> float:
        return self.coefficients.get(name, 0.0)

    def image_point(self, X: ArrayLike, Y: ArrayLike, Z: ArrayLike) -> Point:
        """Return the image points of directions; NaN for those outside the lens.

        X, Y, Z: any shape and length; Z is forwards.
        """
        x, y, z = np.broadcast_arrays(*(np.asarray(axis, float) for axis in (X, Y, Z)))
        with np.errstate(all="ignore"):
            a, b = _plane_point(self, x, y, z)
            bends = _distortion(self)
            return (a, b) if bends is None else bends.forward(a, b)

    def direction(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the directions at points of the image plane, inverting image_point(); NaN outside
        the lens.

        Z is 1 for the lenses whose ideal is the pinhole; the others' directions have length 1,
        except a cylinder's, which have X^2 + Z^2 = 1.
        """
        x, y = np.broadcast_arrays(np.asarray(a, float), np.asarray(b, float))
        with np.errstate(all="ignore"):
            bends = _distortion(self)
            if bends is not None:
                x, y = bends.inverse(x, y)
            return _plane_direction(self, x, y)

    def border(self) -> Floats | None:
        """Return the border of the lens's image on the plane, a closed curve of points (n, 2); None
        if it covers the whole plane.
        """
        if self.model in ("equirectangular", "cylindrical"):
            high = math.pi / 2 if self.model == "equirectangular" else FARTHEST
            corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            return np.array(corners, float) * (math.pi, high)
        bends = _distortion(self)
        if bends is not None:
            return None if bends.end > FARTHEST and bends.is_radial else bends.border()
        ends = {"stereographic": math.inf, "equisolid": 2.0, "orthographic": 1.0, "brown": math.inf}
        end = ends.get(self.model, math.pi)
        if self.model == "fov":
            end = math.pi / 2 / self.coefficient("omega")
        angles = np.linspace(-math.pi, math.pi, 721)
        around = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return None if math.isinf(end) else end * around

    def ends(self, axis: int) -> tuple[float, float]:
        """Return the ends of the lens's image on the axis a (0) or b (1) of the image plane."""
        border = self.border()
        if border is None:
            return -math.inf, math.inf
        along, aside = border[:, axis], border[:, 1 - axis]
        k = np.flatnonzero((aside >= 0) != (np.roll(aside, -1) >= 0))
        after = (k + 1) % len(along)
        with np.errstate(all="ignore"):  # a border at a pole of the map is not finite
            share = aside[k] / (aside[k] - aside[after])
            places = (along[k] + share * (along[after] - along[k])) * (1 - 1e-9)
        low = places[places < 0].max(initial=-math.inf)
        return float(low), float(places[places > 0].min(initial=math.inf))

    def length(self, X: ArrayLike, Y: ArrayLike, Z: ArrayLike) -> Floats:
        """Return the length of directions in units of direction()'s."""
        x, y, z = (np.asarray(axis, float) for axis in (X, Y, Z))
        if self.model == "brown":
            return z + 0 * (x + y)
        across = np.hypot(x, z)
        return across + 0 * y if self.model == "cylindrical" else np.hypot(across, y)


def coefficient_range(model: str, name: str) -> tuple[float, float]:
    """Return the ends of a coefficient's slider; other values are legal but rare."""
    if name == "omega":
        return 0.01, 3.0
    if name[0] in "ps":
        return -0.05, 0.05
    return (-0.5, 0.5) if (model, name) == ("brown", "k1") else (-0.2, 0.2)


def with_coefficient(lens: Lens, name: str, value: float) -> Lens:
    """Return the lens with another coefficient, without those that are 0. Raises LucidaError."""
    return Lens(lens.model, {k: v for k, v in {**lens.coefficients, name: value}.items() if v})


def check_lens(lens: object, projection: str) -> None:
    """Raise LucidaError if a camera cannot have it as its lens."""
    if not isinstance(lens, Lens):
        raise LucidaError(
            "lens", f"is of type {type(lens).__name__}, not a Lens", "give a Lens, or None"
        )
    if projection != "perspective":
        problem = "parallel rays cannot pass through a lens"
        raise LucidaError("lens", problem, "give a perspective camera, or no lens")


# Ideal projections: directions to a plane, and back.


def _plane_point(lens: Lens, x: Floats, y: Floats, z: Floats) -> Point:
    model = lens.model
    if model == "equirectangular":
        return np.arctan2(x, z), np.arctan2(y, np.hypot(x, z))
    if model == "cylindrical":
        return np.arctan2(x, z), y / np.hypot(x, z)
    if model == "brown":
        ahead = np.where(z > 0, z, np.nan)
        return x / ahead, y / ahead
    across = np.hypot(x, y)
    radius = _radius_of(lens, np.arctan2(across, z))
    scale = np.where(across > 0, radius / across, np.where(z > 0, 1 / z, np.nan))
    return x * scale, y * scale


def _plane_direction(lens: Lens, a: Floats, b: Floats) -> tuple[Floats, Floats, Floats]:
    model = lens.model
    if model == "brown":
        return a, b, np.where(np.isnan(a), np.nan, 1.0)
    if model == "equirectangular":
        a = np.where((abs(a) <= math.pi) & (abs(b) <= math.pi / 2), a, np.nan)
        return np.sin(a) * np.cos(b), np.sin(b) + 0 * a, np.cos(a) * np.cos(b)
    if model == "cylindrical":
        a = np.where(abs(a) <= math.pi, a, np.nan)
        return np.sin(a), b + 0 * a, np.cos(a)
    radius = np.hypot(a, b)
    angle = _angle_of(lens, radius)
    scale = np.where(radius > 0, np.sin(angle) / radius, 1.0)
    return a * scale, b * scale, np.cos(angle)


def _radius_of(lens: Lens, angle: Floats) -> Floats:
    """Return the distance from the image's middle of directions at an angle to the axis."""
    match lens.model:
        case "stereographic":
            return 2 * np.tan(np.where(angle < math.pi, angle, np.nan) / 2)
        case "equisolid":
            return 2 * np.sin(angle / 2)
        case "orthographic":
            return np.sin(np.where(angle <= math.pi / 2, angle, np.nan))
        case "fov":
            omega = lens.coefficient("omega")
            ahead = np.where(angle < math.pi / 2, angle, np.nan)
            return np.arctan(2 * np.tan(ahead) * math.tan(omega / 2)) / omega
        case _:  # equidistant, which fisheyes distort
            return angle


def _angle_of(lens: Lens, radius: Floats) -> Floats:
    """Return the angle to the axis of directions at a distance from the image's middle."""
    match lens.model:
        case "stereographic":
            return 2 * np.arctan(radius / 2)
        case "equisolid":
            return 2 * np.arcsin(radius / 2)
        case "orthographic":
            return np.arcsin(radius)
        case "fov":
            omega = lens.coefficient("omega")
            within = np.where(radius * omega < math.pi / 2, radius, np.nan)
            return np.arctan(np.tan(within * omega) / (2 * math.tan(omega / 2)))
        case _:
            return np.where(radius <= math.pi, radius, np.nan)


@lru_cache(maxsize=16)
def _distortion(lens: Lens) -> Distortion | None:
    """Return the map of a lens's plane; None if it is the identity."""
    if not any(lens.coefficients.values()) or lens.model == "fov":
        return None
    from numpy.polynomial import Polynomial  # imported late, because it is slow

    k1, k2, k3, k4, k5, k6 = (lens.coefficient(f"k{n}") for n in range(1, 7))
    if lens.model == "brown":
        r8 = lens.coefficient("r8")
        above, below, widest = [1, k1, k2, k3, r8], [1, k4, k5, k6], math.inf
    else:
        above, below, widest = [1, k1, k2, k3, k4], [1], math.pi
    names = ("s1", "s2", "s3", "s4") if lens.model == "brown" else ("sx1", "", "sy1", "")
    s1, s2, s3, s4 = (lens.coefficient(name) for name in names)
    over, under = Polynomial(above), Polynomial(below)
    end = min(widest, first_fold(over, under))
    p1, p2 = lens.coefficient("p1"), lens.coefficient("p2")
    return Distortion(over, under, p1, p2, (s1, s2, s3, s4), end)
