"""The growth of a plot's line: reported for counts, and for times if there is no doubt."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

ENOUGH = 4  # different n, before anything is said of counts
WIDE = 30  # times the least n, that the largest must be
SAME = 1.25  # times the least count: what differs by less is called the same
LOG_ERROR = 0.15  # relative error of a + b log n for a count
STEEP = 0.5  # the exponent between two neighbours from which a line of times counts as steep
RUN = 3  # steep points in a row, at the right end
EXPONENT_ERROR = 0.15  # of a line that is called proportional
TIME_ERROR = 0.25  # relative error of a proportional line for a time

Point = tuple[float, float]


def count_growth(points: Iterable[Point], n: str) -> str:
    """Return what counts (n, count) grow with: `the same`, `~ n`, `~ log n`, `~ n^k`; "" too
    early.
    """
    rising = _rising(points)
    if len(rising) < ENOUGH or rising[-1][0] < WIDE * rising[0][0]:
        return ""
    x, y = np.array(rising).T
    if y.max() <= SAME * y.min():
        return "the same"
    exponent = _slope(np.log(x), np.log(y))
    if abs(exponent - 1) <= 0.05:
        return f"~ {n}"
    slope = _slope(np.log(x), y)
    line = y.mean() + slope * (np.log(x) - np.log(x).mean())
    if slope > 0 and (np.abs(line - y) <= LOG_ERROR * y).all():
        return f"~ log {n}"
    return f"~ {n}^{exponent:.1f}"


def per_doubling(points: Iterable[Point]) -> float:
    """Return what is added to a count that grows as log n when n doubles; NaN for fewer than
    two.
    """
    rising = _rising(points)
    if len(rising) < 2:
        return math.nan
    x, y = np.array(rising).T
    return _slope(np.log2(x), y)


def is_proportional(points: Iterable[Point]) -> bool:
    """Return True if times (n, seconds) climb like n at the right end of their line.

    The line must be steep there for a few points, and straight: a flat line measures what every
    image costs, and a machine that does other things bends it.
    """
    rising = _rising(points)
    logs = [(math.log(n), math.log(value)) for n, value in rising]
    first = len(logs) - 1
    while first > 0 and _steep(logs[first - 1], logs[first]):
        first -= 1
    run = np.array(logs[first:])
    if len(run) < RUN:
        return False
    x, y = run.T
    exponent = _slope(x, y)
    line = y.mean() + exponent * (x - x.mean())
    is_straight = (np.abs(line - y) <= math.log1p(TIME_ERROR)).all()
    return bool(is_straight) and abs(exponent - 1) <= EXPONENT_ERROR


def _steep(a: Point, b: Point) -> bool:
    return b[1] - a[1] >= STEEP * (b[0] - a[0])


def _rising(points: Iterable[Point]) -> Sequence[Point]:
    """Return one point for each n, the least value, from the least n on, without points that have
    no logarithm.
    """
    least: dict[float, float] = {}
    for n, value in points:
        if n > 0 and value > 0 and math.isfinite(value):
            least[n] = min(value, least.get(n, math.inf))
    return sorted(least.items())


def _slope(x: np.ndarray, y: np.ndarray) -> float:
    """Return the slope of the best straight line."""
    dx = x - x.mean()
    return float((dx * y).sum() / (dx * dx).sum())
