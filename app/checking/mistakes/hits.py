"""The crossings of rays with spheres and triangles, for the lines that ask for objects."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.catalogue import part
from app.checking.mistakes.program import Program


@functools.cache
def _solver(kind: str) -> Program:
    """Return the lines of a sphere or a triangle that find all crossings, of any sign."""
    lines, mistakes = part(f"hit-{kind}")
    if kind == "sphere":
        return Program(tuple(lines), (), ("near", "far"))
    return Program(
        tuple(lines), tuple(one for one in mistakes if one.name == "t < 0 accepted"), ("t",)
    )


def crossings(origin: Any, direction: Any, shape: Mapping[str, Any]) -> list[NDArray[np.float64]]:
    """Return all t, of any sign, at which the rays' lines hit a sphere or a triangle; NaN for a
    miss.

    origin, direction: (..., 3).
    shape: type, then center and radius, or a, b and c.
    """
    origin, direction = np.asarray(origin, float), np.asarray(direction, float)
    known = {name: np.asarray(value, float) for name, value in shape.items() if name != "type"}
    known |= {"origin": origin, "direction": direction}
    solver = _solver(shape["type"])
    roots = (root[..., 0] for root in solver.run(known, solver.mistakes))
    return [np.where(np.isfinite(root), root, np.nan) for root in roots]


def _least(found: list[NDArray[np.float64]], positive: bool = True) -> Any:
    made = [np.where(np.isnan(t) | (positive & (t <= 0)), np.inf, t) for t in found]
    return np.minimum.reduce(made)


def hit(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t > 0."""
    return _least(crossings(origin, direction, shape))


def first_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t of any sign."""
    return _least(crossings(origin, direction, shape), positive=False)


def last_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the largest t > 0."""
    found = [np.where(t > 0, t, -np.inf) for t in crossings(origin, direction, shape)]
    last = np.maximum.reduce(found)
    return np.where(last > 0, last, np.inf)


SHAPES = {"hit": hit, "first_crossing": first_crossing, "last_crossing": last_crossing}
