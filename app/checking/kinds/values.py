"""A student's return values, read generously: JSON values as numbers and vectors.

None means that the value is not of that type. Infinite and NaN numbers are numbers here; the
caller decides about them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

SHOWN = 80  # characters of a value in a message
DEPTH = 8  # of nested lists that are written out


def number(value: Any) -> float | None:
    """Return a number. A list of one number counts, as arrays of one element are lists."""
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def vector(value: Any) -> tuple[float, float, float] | None:
    """Return three numbers, from a list, a row or column of a matrix, or x, y, z. A fourth number
    that is 0 or 1 is a homogeneous coordinate.
    """
    if isinstance(value, dict):
        value = [value.get(name) for name in ("x", "y", "z")]
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if not isinstance(value, list) or len(value) not in (3, 4):
        return None
    numbers = [number(part) for part in value]
    if len(numbers) == 4 and numbers.pop() not in (0.0, 1.0):
        return None
    x, y, z = numbers
    return None if x is None or y is None or z is None else (x, y, z)


def vectors(value: Any, names: Sequence[str]) -> list[tuple[float, float, float]] | None:
    """Return a vector for each name: from a list in this order, by name, or from all numbers in a
    row.
    """
    value = in_order(value, names)
    if isinstance(value, list) and len(value) == 3 * len(names) != 3:
        value = [value[k : k + 3] for k in range(0, len(value), 3)]
    elif len(names) == 1 and vector(value) is not None:
        value = [value]
    if not isinstance(value, list) or len(value) != len(names):
        return None
    found = [vector(part) for part in value]
    read = [part for part in found if part is not None]
    return read if len(read) == len(names) else None


def in_order(value: Any, names: Sequence[str]) -> Any:
    """Return the parts of an answer that names them, in the order of the names; any other value
    unchanged.
    """
    if isinstance(value, dict) and all(name in value for name in names):
        return [value[name] for name in names]
    return value


def is_miss(value: Any) -> bool:
    """Return True if the value means a miss: None, False, inf, nan, or a list of nothing else.

    Minus infinity is not a miss: it is nearer than every hit.
    """
    if isinstance(value, list) and len(value) <= 2:
        return all(not isinstance(part, list) and is_miss(part) for part in value)
    if value is None or value is False:
        return True
    found = number(value)
    return found is not None and not math.isfinite(found) and found != -math.inf


def array(value: Any) -> NDArray[np.float64] | None:
    """Return a list of numbers as an array; None for anything else."""
    if not isinstance(value, list):
        return None
    try:
        made = np.array(value)
    except (ValueError, OverflowError):
        return None
    return made.astype(float) if made.dtype.kind in "biuf" else None


def shown(value: Any) -> str:
    """Return a returned value for a message: shortened, or only an array's shape."""
    text = text_of(value)
    if len(text) <= SHOWN:
        return text
    made = array(value)
    return f"{text[: SHOWN - 3]}..." if made is None else f"an array of shape {made.shape}"


def text_of(value: Any, depth: int = DEPTH) -> str:
    """Return a value as Python writes it, with numbers of six digits: (1, 0.5, -2)."""
    if depth == 0:
        return "..."
    match value:
        case bool() | None | str():
            return repr(value)
        case int() | float():
            return f"{value + 0.0:.6g}" if isinstance(value, float) else str(value)
        case list() | tuple():
            return "(" + ", ".join(text_of(part, depth - 1) for part in value) + ")"
        case dict():
            return (
                "{"
                + ", ".join(f"{name}: {text_of(part, depth - 1)}" for name, part in value.items())
                + "}"
            )
    return repr(value)
