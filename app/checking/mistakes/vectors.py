"""The functions that the programs' lines may use, for one ray and for many at once.

The last functions select a ray's hit among its crossings with an object, correctly and incorrectly.

A number is an array (..., 1) and a vector (..., 3), so that `x*u` reads as in a formula.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.kinds.shapes import crossings, hits

Floats = NDArray[np.float64]


def dot(a: ArrayLike, b: ArrayLike) -> Floats:
    return np.asarray(np.vecdot(a, b))[..., None]


def norm(a: ArrayLike) -> Floats:
    return np.sqrt(dot(a, a))


def normalized(a: ArrayLike) -> Floats:
    return np.divide(a, norm(a))


def vector(*numbers: ArrayLike) -> Floats:
    """Return the vector of three numbers."""
    parts = np.broadcast_arrays(*(np.asarray(number, float) for number in numbers))
    return np.concatenate([np.atleast_1d(part) for part in parts], axis=-1)


def columns(*vectors: ArrayLike) -> Floats:
    """Return the matrix with these columns, (..., 3, 3)."""
    return np.stack(np.broadcast_arrays(*vectors), axis=-1).astype(float)


def rows(*vectors: ArrayLike) -> Floats:
    """Return the matrix with these rows."""
    return transposed(columns(*vectors))


def columns_of(matrix: ArrayLike) -> tuple[Floats, ...]:
    """Return the matrix's three columns, as vectors."""
    return tuple(np.moveaxis(np.asarray(matrix), -1, 0))


def transposed(matrix: ArrayLike) -> Floats:
    return np.asarray(np.swapaxes(matrix, -1, -2))


def inverse(matrix: ArrayLike) -> Floats:
    """Return the inverses; all NaN if one of the matrices is singular."""
    try:
        return np.asarray(np.linalg.inv(np.asarray(matrix, float)))
    except np.linalg.LinAlgError:
        return np.full_like(np.asarray(matrix, float), np.nan)


def times(matrix: ArrayLike, a: ArrayLike) -> Floats:
    """Return the product of a matrix (..., 3, 3) with a vector (..., 3)."""
    return np.asarray(np.einsum("...ij,...j->...i", np.asarray(matrix), np.asarray(a)))


def times_vector(matrix: ArrayLike, a: ArrayLike) -> Floats:
    """Return the product of a matrix (..., 4, 4) with a direction, whose fourth number is 0."""
    return times(np.asarray(matrix)[..., :3, :3], a)


def times_point(matrix: ArrayLike, a: ArrayLike) -> Floats:
    """Return the product of a matrix (..., 4, 4) with a point, whose fourth number is 1."""
    return times_vector(matrix, a) + np.asarray(matrix)[..., :3, 3]


FUNCTIONS: dict[str, Any] = {
    function.__name__: function
    for function in (
        dot, norm, normalized, vector, columns, columns_of, rows, transposed, inverse,
        times, times_vector, times_point,
    )
} | {
    "cross": np.cross, "sqrt": np.sqrt, "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "atan": np.arctan, "atan2": np.arctan2, "radians": np.radians, "degrees": np.degrees,
    "where": np.where, "floor": np.floor,
    "minimum": np.minimum, "maximum": np.maximum,
    "inf": np.inf,
}  # fmt: skip


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
