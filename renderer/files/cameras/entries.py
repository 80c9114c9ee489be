"""Entries of other programs' files by name: checked numbers, sizes and poses, and unused keys."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.checks import Floats, listed, number
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin, matrix
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError, errors_as

# The phrases for the two pixel origins in CameraSet.taken.
ORIGIN_TOLD: dict[PixelOrigin, str] = {
    "center": "integer coordinates at pixel centres",
    "corner": "integer coordinates at pixel corners, centres at .5",
}

SHOWN = 8  # unused keys that a note names; the others are counted
_LAST = (0.0, 0.0, 0.0, 1.0)  # row of an affine map


def number_of(name: str, value: object) -> float:
    """Return a finite number. Numbers written as text are rejected. Raises LucidaError."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise LucidaError(name, f"{value!r} is not a number", "give a finite number")
    return number(name, value)


def side_of(name: str, value: object) -> int:
    """Return a width or height: a whole number, perhaps written as a float. Raises LucidaError."""
    side = number_of(name, value)
    if side != int(side) or side < 1:
        raise LucidaError(name, f"{side:g} is not a count of pixels", "give a whole number above 0")
    return int(side)


def size_of(name: str, width: object, height: object) -> Size:
    """Return a checked size. Raises LucidaError."""
    with errors_as(name):
        return check_size((side_of(name, width), side_of(name, height)))


def flat(name: str, value: ArrayLike, *counts: int) -> Floats:
    """Return numbers flattened to one dimension, regardless of nesting.

    counts: the allowed numbers of them; any if empty. Raises LucidaError.
    """
    try:
        entries = np.ravel(value)
    except (TypeError, ValueError):
        entries = np.array([""])
    found = matrix(name, entries, entries.shape)
    if counts and found.size not in counts:
        wanted = " or ".join(map(str, counts))
        raise LucidaError(name, f"has {found.size} numbers", f"give {wanted}")
    return found


def affine(name: str, value: ArrayLike) -> Floats:
    """Return an affine map (4, 4), from 3 x 4 or 4 x 4 numbers row by row. Raises LucidaError."""
    found = matrix(name, value, (3, 4), (4, 4), (12,), (16,)).reshape(-1, 4)
    if len(found) == 3:
        return np.vstack([found, _LAST])
    if not np.allclose(found[3], _LAST, rtol=0, atol=1e-6):
        problem = f"its last row {listed(found[3])} is not (0, 0, 0, 1)"
        turned = np.allclose(found[:, 3], _LAST, rtol=0, atol=1e-6)
        remedy = "is it transposed? give it row by row" if turned else "give an affine matrix"
        raise LucidaError(name, problem, remedy)
    return found


def plain(name: str) -> str:
    """Return a key in lower case, letters and digits only."""
    return re.sub(r"[^a-z0-9]", "", name.lower())


def entries_of(tree: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield all values of nested tables, named like "cam0.size" and "cameras.0.size".

    A table with data is a matrix, and one value.
    """
    for name, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        is_list = isinstance(value, list) and any(isinstance(part, dict) for part in value)
        if is_list or (isinstance(value, dict) and "data" not in value):
            yield from entries_of(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def numbers_in(value: Any) -> Floats:
    """Return the numbers of a value, however nested; none if it holds anything else."""
    try:
        numbers = np.ravel(value)
    except (TypeError, ValueError):
        return np.zeros(0)
    return numbers.astype(float) if numbers.dtype.kind in "iufb" else np.zeros(0)


def notes_on(names: Iterable[str]) -> tuple[str, ...]:
    """Return a note that names the unused keys; () if there are none."""
    unused = list(dict.fromkeys(names))
    if not unused:
        return ()
    more = f" and {len(unused) - SHOWN} more" if len(unused) > SHOWN else ""
    return (f"not used: {', '.join(unused[:SHOWN])}{more}",)
