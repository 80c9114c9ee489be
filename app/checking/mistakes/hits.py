"""Which of a ray's crossings with an object is its hit: rightly, and as people get it wrong."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lucida.app.checking.kinds.shapes import crossings, hits


def hit(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t > 0."""
    return hits(origin, direction, shape)[0]


def first_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t of any sign."""
    found = np.fmin.reduce(crossings(origin, direction, shape)[0])
    return np.where(np.isnan(found), np.inf, found)


def last_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the largest t > 0."""
    last = np.fmax.reduce(crossings(origin, direction, shape)[0])
    return np.where(last > 0, last, np.inf)


SHAPES = {"hit": hit, "first_crossing": first_crossing, "last_crossing": last_crossing}
