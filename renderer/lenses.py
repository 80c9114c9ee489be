"""Lenses: where a camera without a projection matrix sees a direction, and back.

A lens maps a direction to a point (a, b) of the image plane at distance 1, with the axes of
computer vision: a to the right, b downwards, and directions (X, Y, Z) with Z forwards. It does so
in two steps: an ideal projection to a plane (the pinhole's, a fisheye's), then a polynomial map of
that plane, the distortion. Only where both are one-to-one does a lens see anything.
Sources: OpenCV's documentation, "Camera calibration" and "Fisheye camera model"; COLMAP's
documentation, "Camera Models"; Devernay and Faugeras, Straight lines have to be straight (2001);
Kannala and Brandt, A generic camera model (2006).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.camera_checks import Floats, number
from renderer.errors import LucidaError

if TYPE_CHECKING:
    from numpy.polynomial import Polynomial

# The coefficients of each model. Those that are not given are 0. r8 is a fourth radial one, of r^8,
# which Metashape and nerfstudio call k4.
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
_TABLE = 4096  # intervals of the table in which the inversion of a radial map starts
_FARTHEST = 1e8  # the largest radius on the image plane, for maps that never fold
_STEPS = 60
MOST_SHOWN = 8  # steps of the inversion of a single point

Point = tuple[Floats, Floats]


@dataclass(frozen=True, slots=True)
class Lens:
    """A lens of a model in MODELS, with its coefficients.

    coefficients: by name; those missing are 0. Raises LucidaError naming the field.
    """

    model: str
    coefficients: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.model not in MODELS:
            remedy = f"give one of {', '.join(MODELS)}"
            raise LucidaError("lens.model", f"{self.model!r} is unknown", remedy)
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

    def coefficient(self, name: str) -> float:
        return self.coefficients.get(name, 0.0)

    def image_point(self, X: ArrayLike, Y: ArrayLike, Z: ArrayLike) -> Point:
        """Return where directions appear on the image plane; NaN for those that the lens does not
        see.

        X, Y, Z: any shape and length; Z is forwards.
        """
        x, y, z = np.broadcast_arrays(*(np.asarray(axis, float) for axis in (X, Y, Z)))
        with np.errstate(all="ignore"):
            a, b = _plane_point(self, x, y, z)
            bends = _distortion(self)
            return (a, b) if bends is None else bends.forward(a, b)

    def direction(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the directions that appear at points of the image plane: the inverse of
        image_point(); NaN outside of the lens.

        Z is 1 for the lenses whose ideal is the pinhole; the others' directions have length 1, but
        a cylinder's, which have X^2 + Z^2 = 1.
        """
        x, y = np.broadcast_arrays(np.asarray(a, float), np.asarray(b, float))
        with np.errstate(all="ignore"):
            bends = _distortion(self)
            if bends is not None:
                x, y = bends.inverse(x, y)
            return _plane_direction(self, x, y)

    def border(self) -> Floats | None:
        """Return the border of what the lens sees of the image plane, a closed curve of points
        (n, 2); None if it sees all of the plane.
        """
        if self.model in ("equirectangular", "cylindrical"):
            high = math.pi / 2 if self.model == "equirectangular" else _FARTHEST
            corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            return np.array(corners, float) * (math.pi, high)
        bends = _distortion(self)
        if bends is not None:
            return None if bends.end > _FARTHEST and bends.is_radial else bends.border()
        ends = {"stereographic": math.inf, "equisolid": 2.0, "orthographic": 1.0, "brown": math.inf}
        end = ends.get(self.model, math.pi)
        if self.model == "fov":
            end = math.pi / 2 / self.coefficient("omega")
        angles = np.linspace(-math.pi, math.pi, 721)
        around = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return None if math.isinf(end) else end * around

    def ends(self, axis: int) -> tuple[float, float]:
        """Return where the lens ends on the axis a (0) or b (1) of the image plane."""
        border = self.border()
        if border is None:
            return -math.inf, math.inf
        along, aside = border[:, axis], border[:, 1 - axis]
        k = np.flatnonzero((aside >= 0) != (np.roll(aside, -1) >= 0))
        after = (k + 1) % len(along)
        share = aside[k] / (aside[k] - aside[after])
        places = (along[k] + share * (along[after] - along[k])) * (1 - 1e-9)
        return float(places[places < 0].max()), float(places[places > 0].min())

    def inverse_steps(self, a: float, b: float) -> Floats:
        """Return how Newton's method undoes the distortion of a point of the image plane: (n, 3).

        Each row is a point of the ideal plane, with the distance by which its distorted point
        misses (a, b). Empty if nothing is distorted, or if no way of a few steps is found.
        """
        with np.errstate(all="ignore"):
            bends = _distortion(self)
            return np.zeros((0, 3)) if bends is None else bends.steps(a, b)

    def length(self, X: ArrayLike, Y: ArrayLike, Z: ArrayLike) -> Floats:
        """Return the length of directions in units of those that direction() returns."""
        x, y, z = (np.asarray(axis, float) for axis in (X, Y, Z))
        if self.model == "brown":
            return z + 0 * (x + y)
        across = np.hypot(x, z)
        return across + 0 * y if self.model == "cylindrical" else np.hypot(across, y)


def check_lens(lens: object, projection: str) -> None:
    """Raise LucidaError if a camera cannot have it as its lens."""
    if not isinstance(lens, Lens):
        raise LucidaError("lens", f"is a {type(lens).__name__}, not a Lens", "give a Lens, or None")
    if projection != "perspective":
        problem = "parallel rays pass through no lens"
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
    """Return the angle to the axis of what appears at a distance from the image's middle."""
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


# Distortion: a map of the plane.


@dataclass(frozen=True)
class _Distortion:
    """Radial, tangential and thin-prism distortion of a plane.

    above, below: polynomials in r^2, whose quotient scales a point. end: the radius up to which the
    radial part rises. The map is trusted from the middle outwards to where it first folds: to
    `end`, or, with other than radial terms, to `_folds`, which depends on the angle.
    """

    above: Polynomial
    below: Polynomial
    p1: float
    p2: float
    prism: tuple[float, float, float, float]
    end: float

    @property
    def is_radial(self) -> bool:
        return not (self.p1 or self.p2 or any(self.prism))

    def forward(self, x: Floats, y: Floats) -> Point:
        a, b = self._map(x, y)
        seen = np.hypot(x, y) <= self._end_at(x, y)
        return np.where(seen, a, np.nan), np.where(seen, b, np.nan)

    def inverse(self, a: Floats, b: Floats) -> Point:
        """Invert the radial part in one variable; from there, all of it by Newton in two."""
        target = np.hypot(a, b)
        radius = self._inverse_radius(target)
        if self.is_radial:
            scale = np.where(target > 0, radius / target, 1.0)
            return a * scale, b * scale
        start = np.where(np.isnan(radius), min(self.end, _FARTHEST), radius)
        scale = np.where(target > 0, start / target, 0.0)
        x, y = self._newton(a, b, a * scale, b * scale)
        # Near a fold, Newton may miss: there it follows the point outwards from the middle.
        missed = ~self._hits(a, b, x, y) & (target <= np.hypot(*self._map(*self._border)).max())
        if missed.any():
            near_x, near_y = np.zeros(missed.sum()), np.zeros(missed.sum())
            for part in np.linspace(0, 1, 33)[1:]:
                near_x, near_y = self._newton(part * a[missed], part * b[missed], near_x, near_y)
            x[missed], y[missed] = near_x, near_y
        seen = self._hits(a, b, x, y)
        return np.where(seen, x, np.nan), np.where(seen, y, np.nan)

    def _hits(self, a: Floats, b: Floats, x: Floats, y: Floats) -> NDArray[np.bool_]:
        at_a, at_b = self._map(x, y)
        error = np.hypot(at_a - a, at_b - b)
        return (error < 1e-12 * (1 + np.hypot(a, b))) & (np.hypot(x, y) <= self._end_at(x, y))

    def border(self) -> Floats:
        """Return the border of the map's values, points (n, 2)."""
        return np.stack(self._map(*self._border), axis=-1)

    @property
    def _border(self) -> Point:
        angles, ends = self._folds
        return ends * np.cos(angles), ends * np.sin(angles)

    def _end_at(self, x: Floats, y: Floats) -> Floats | float:
        if self.is_radial:
            return self.end
        angles, ends = self._folds
        return np.interp(np.arctan2(y, x), angles, ends)

    @cached_property
    def _folds(self) -> tuple[Floats, Floats]:
        """The radius at which the map first folds, by the angle in the plane."""
        angles = np.linspace(-math.pi, math.pi, 721)[:, None]
        farthest = min(self.end, _FARTHEST)
        radii = np.concatenate([[0.0], farthest * np.geomspace(1e-6 / (1 + farthest), 1, 512)])
        folded = self._determinant(radii, angles) <= 0
        folded[:, -1] = True
        first = folded.argmax(axis=1)
        low, high = radii[np.maximum(first - 1, 0)], radii[first]
        for _ in range(50):
            middle = (low + high) / 2
            over = self._determinant(middle, angles[:, 0]) <= 0
            low, high = np.where(over, low, middle), np.where(over, middle, high)
        return angles[:, 0], high

    def _determinant(self, radius: Floats, angle: Floats) -> Floats:
        (xx, xy), (yx, yy) = self._slopes(radius * np.cos(angle), radius * np.sin(angle))
        return xx * yy - xy * yx

    def _radial(self, r: Floats) -> tuple[Floats, Floats]:
        """Return the distorted radius, and its derivative."""
        s = r * r
        above, below = self.above(s), self.below(s)
        slope = (self.above.deriv()(s) * below - above * self.below.deriv()(s)) / below**2
        return r * above / below, above / below + 2 * s * slope

    def _inverse_radius(self, target: Floats) -> Floats:
        """Return the radii that are distorted to `target`; NaN if none is.

        Newton, within an interval of a table; a step that leaves the interval is a bisection.
        """
        end, most = min(self.end, _FARTHEST), float(np.nanmax(target, initial=0.0))
        if self.end > _FARTHEST:
            end = 1.0
            while end < _FARTHEST and self._radial(np.array(end))[0] < most:
                end *= 2
        known = np.linspace(0, end, _TABLE + 1)
        distorted = np.maximum.accumulate(self._radial(known)[0])
        seen = target <= distorted[-1]
        wanted = target[seen]
        place = np.clip(np.searchsorted(distorted, wanted), 1, _TABLE)
        low, high = known[place - 1], known[place]
        r = np.clip(np.interp(wanted, distorted, known), low, high)
        left = np.arange(r.size)
        for _ in range(_STEPS):
            at, aim = r[left], wanted[left]
            value, slope = self._radial(at)
            over = value > aim
            low[left], high[left] = np.where(over, low[left], at), np.where(over, at, high[left])
            step = at - (value - aim) / slope
            within = (step >= low[left]) & (step <= high[left])
            r[left] = np.where(within, step, (low[left] + high[left]) / 2)
            left = left[~(np.abs(r[left] - at) <= 1e-9 * (1e-6 + at))]  # the error is its square
            if not left.size:
                break
        found = np.full(target.shape, np.nan)
        found[seen] = r
        return found

    def _newton(self, a: Floats, b: Floats, x: Floats, y: Floats) -> Point:
        """Return the points that are mapped to (a, b), found from (x, y)."""
        shape = x.shape
        a, b, x, y = (part.ravel() for part in (a, b, x.copy(), y.copy()))
        left = np.arange(x.size)
        for _ in range(_STEPS):
            at_x, at_y = x[left], y[left]
            x[left], y[left] = self._step(a[left], b[left], at_x, at_y)
            moved = np.hypot(x[left] - at_x, y[left] - at_y)
            length = np.hypot(x[left], y[left])
            left = left[moved > 1e-9 * (1e-6 + length)]  # the error is about its square
            if not left.size:
                break
        return x.reshape(shape), y.reshape(shape)

    def _step(self, a: Floats, b: Floats, x: Floats, y: Floats) -> Point:
        """Return one step of Newton's method from (x, y) to what is mapped to (a, b)."""
        at_a, at_b = self._map(x, y)
        (xx, xy), (yx, yy) = self._slopes(x, y)
        da, db, turned = at_a - a, at_b - b, xx * yy - xy * yx
        new_x, new_y = x - (yy * da - xy * db) / turned, y - (xx * db - yx * da) / turned
        # A step out of the lens ends at its border.
        length = np.hypot(new_x, new_y)
        scale = np.minimum(1.0, self._end_at(new_x, new_y) / np.maximum(length, 1e-300))
        return new_x * scale, new_y * scale

    def steps(self, a: float, b: float) -> Floats:
        """Return Newton's way to what is mapped to (a, b): points with their errors, (n, 3).

        It begins at (a, b) itself, or, if that leads nowhere, at the inverse of the radial part.
        Empty where both lead nowhere.
        """
        target = np.array([a]), np.array([b])
        radius = self._inverse_radius(np.hypot(*target))
        for length in (np.hypot(*target), np.where(np.isnan(radius), self.end, radius)):
            scale = np.minimum(length, min(self.end, _FARTHEST)) / np.maximum(
                np.hypot(a, b), 1e-300
            )
            x, y = target[0] * scale, target[1] * scale
            found = []
            for _ in range(MOST_SHOWN):
                at_a, at_b = self._map(x, y)
                found.append([x[0], y[0], np.hypot(at_a - a, at_b - b)[0]])
                if self._hits(*target, x, y).all():
                    return np.array(found)
                x, y = self._step(*target, x, y)
        return np.zeros((0, 3))

    def _map(self, x: Floats, y: Floats) -> Point:
        s = x * x + y * y
        radial = self.above(s) / self.below(s)
        s1, s2, s3, s4 = self.prism
        a = x * radial + 2 * self.p1 * x * y + self.p2 * (s + 2 * x * x) + s1 * s + s2 * s * s
        b = y * radial + self.p1 * (s + 2 * y * y) + 2 * self.p2 * x * y + s3 * s + s4 * s * s
        return a, b

    def _slopes(self, x: Floats, y: Floats) -> tuple[Point, Point]:
        """Return the derivatives of the distorted point: of a by x and y, of b by x and y."""
        s = x * x + y * y
        above, below = self.above(s), self.below(s)
        radial = above / below
        slope = 2 * (self.above.deriv()(s) * below - above * self.below.deriv()(s)) / below**2
        s1, s2, s3, s4 = self.prism
        prism_a, prism_b = 2 * s1 + 4 * s2 * s, 2 * s3 + 4 * s4 * s
        p1, p2 = self.p1, self.p2
        mixed = slope * x * y
        return (
            radial + slope * x * x + 2 * p1 * y + 6 * p2 * x + prism_a * x,
            mixed + 2 * p1 * x + 2 * p2 * y + prism_a * y,
        ), (
            mixed + 2 * p1 * x + 2 * p2 * y + prism_b * x,
            radial + slope * y * y + 6 * p1 * y + 2 * p2 * x + prism_b * y,
        )


@lru_cache(maxsize=16)
def _distortion(lens: Lens) -> _Distortion | None:
    """Return the map of a lens's plane; None if it is the identity."""
    if not any(lens.coefficients.values()) or lens.model == "fov":
        return None
    from numpy.polynomial import Polynomial  # late: it takes longer than all else here

    k1, k2, k3, k4, k5, k6 = (lens.coefficient(f"k{n}") for n in range(1, 7))
    if lens.model == "brown":
        r8 = lens.coefficient("r8")
        above, below, widest = [1, k1, k2, k3, r8], [1, k4, k5, k6], math.inf
    else:
        above, below, widest = [1, k1, k2, k3, k4], [1], math.pi
    names = ("s1", "s2", "s3", "s4") if lens.model == "brown" else ("sx1", "", "sy1", "")
    s1, s2, s3, s4 = (lens.coefficient(name) for name in names)
    over, under = Polynomial(above), Polynomial(below)
    end = min(widest, _end(over, under))
    p1, p2 = lens.coefficient("p1"), lens.coefficient("p2")
    return _Distortion(over, under, p1, p2, (s1, s2, s3, s4), end)


def _end(above: Polynomial, below: Polynomial) -> float:
    """Return the radius at which r above(r^2) / below(r^2) stops rising; inf if it never does."""
    s = above.identity()
    rising = above * below + 2 * s * (above.deriv() * below - above * below.deriv())
    roots = np.concatenate([rising.trim().roots(), below.trim().roots()])
    real = roots.real[(np.abs(roots.imag) <= 1e-9 * np.abs(roots.real)) & (roots.real > 0)]
    return math.sqrt(real.min(initial=math.inf))
