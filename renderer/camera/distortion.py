"""Distortion: a polynomial map of the plane, and its inverse."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .checks import Floats

if TYPE_CHECKING:
    from numpy.polynomial import Polynomial

FARTHEST = 1e8  # the largest radius on the image plane, for maps that never fold
_TABLE = 4096  # intervals of the table in which the inversion of a radial map starts
_STEPS = 60
_SIDES = 32  # lines around the map's values

Point = tuple[Floats, Floats]


@dataclass(frozen=True)
class Distortion:
    """Radial, tangential and thin-prism distortion of a plane.

    above, below: polynomials in r^2, whose quotient scales a point. end: the radius up to which the
    radial part rises. The map is valid from the middle outwards to its first fold: at `end`, or,
    with other than radial terms, at `_folds`, which depends on the angle.
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
        """Invert the radial part in one variable, and then the whole map by Newton's method in
        two.
        """
        target = np.hypot(a, b)
        radius = self._inverse_radius(target)
        if self.is_radial:
            scale = np.where(target > 0, radius / target, 1.0)
            return a * scale, b * scale
        start = np.where(np.isnan(radius), min(self.end, FARTHEST), radius)
        scale = np.where(target > 0, start / target, 0.0)
        x, y = np.full(a.shape, np.nan), np.full(a.shape, np.nan)
        near = self._may_reach(a, b)
        x[near], y[near] = self._newton(a[near], b[near], (a * scale)[near], (b * scale)[near])
        # Newton's method may fail near a fold, so follow the point outwards from the middle.
        left = np.flatnonzero(near & ~self._hits(a, b, x, y))
        near_x, near_y = np.zeros(left.size), np.zeros(left.size)
        for part in np.linspace(0, 1, 33)[1:]:
            at_a, at_b = part * a.ravel()[left], part * b.ravel()[left]
            near_x, near_y = self._newton(at_a, at_b, near_x, near_y)
            found = self._hits(at_a, at_b, near_x, near_y)  # a lost point stays lost
            left, near_x, near_y = left[found], near_x[found], near_y[found]
        x.flat[left], y.flat[left] = near_x, near_y
        seen = self._hits(a, b, x, y)
        return np.where(seen, x, np.nan), np.where(seen, y, np.nan)

    def _may_reach(self, a: Floats, b: Floats) -> NDArray[np.bool_]:
        """Return False for points beyond a line that has all of the map's values on one side."""
        border, near = self.border(), np.ones(a.shape, bool)
        for angle in np.linspace(0, 2 * math.pi, _SIDES, endpoint=False):
            across, down = math.cos(angle), math.sin(angle)
            most = (border @ (across, down)).max()
            near &= ~(across * a + down * b > most + 1e-3 * abs(most))
        return near

    def _hits(self, a: Floats, b: Floats, x: Floats, y: Floats) -> NDArray[np.bool_]:
        at_a, at_b = self._map(x, y)
        error = np.hypot(at_a - a, at_b - b)
        return (error < 1e-12 * (1 + np.hypot(a, b))) & (np.hypot(x, y) <= self._end_at(x, y))

    def border(self) -> Floats:
        """Return the border of the map's values, points (n, 2)."""
        with np.errstate(all="ignore"):
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
        farthest = min(self.end, FARTHEST)
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

        Newton's method runs within an interval of a table; a step that leaves it becomes a
        bisection.
        """
        end, most = min(self.end, FARTHEST), float(np.nanmax(target, initial=0.0))
        if self.end > FARTHEST:
            end = 1.0
            while end < FARTHEST and self._radial(np.array(end))[0] < most:
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
            x[left], y[left] = self.newton_step(a[left], b[left], at_x, at_y)
            moved = np.hypot(x[left] - at_x, y[left] - at_y)
            length = np.hypot(x[left], y[left])
            left = left[moved > 1e-9 * (1e-6 + length)]  # the error is about its square
            if not left.size:
                break
        return x.reshape(shape), y.reshape(shape)

    def newton_step(self, a: Floats, b: Floats, x: Floats, y: Floats) -> Point:
        """Return one step of Newton's method from (x, y) to the points mapped to (a, b)."""
        at_a, at_b = self._map(x, y)
        (xx, xy), (yx, yy) = self._slopes(x, y)
        da, db, turned = at_a - a, at_b - b, xx * yy - xy * yx
        new_x, new_y = x - (yy * da - xy * db) / turned, y - (xx * db - yx * da) / turned
        # A step beyond the lens ends at its border.
        length = np.hypot(new_x, new_y)
        scale = np.minimum(1.0, self._end_at(new_x, new_y) / np.maximum(length, 1e-300))
        return new_x * scale, new_y * scale

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


def first_fold(above: Polynomial, below: Polynomial) -> float:
    """Return the radius at which r above(r^2) / below(r^2) stops rising; inf if it never does."""
    s = above.identity()
    rising = above * below + 2 * s * (above.deriv() * below - above * below.deriv())
    roots = np.concatenate([rising.trim().roots(), below.trim().roots()])
    real = roots.real[(np.abs(roots.imag) <= 1e-9 * np.abs(roots.real)) & (roots.real > 0)]
    return math.sqrt(real.min(initial=math.inf))
