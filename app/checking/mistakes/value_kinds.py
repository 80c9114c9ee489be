"""The program for each kind of function, and the values that its lines use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from app.checking.mistakes.basis import BASIS
from app.checking.mistakes.hits import CLOSEST, SHAPES, SPHERE, TRIANGLE
from app.checking.mistakes.images import bitmap_program, gray_program, offset_program
from app.checking.mistakes.program import Program
from app.checking.mistakes.value_diagnosis import ValueCase
from renderer.shared_numbers import LUMINANCE


def value_program(
    kind: str,
    weights: Sequence[float] = LUMINANCE,
    inclusive: bool = True,
    base: int = 0,
    column_major: bool = False,
    stride: int = 1,
) -> Program:
    """Return the program of a kind. Raises KeyError for unknown kinds.

    kind: "basis", "hit-sphere", "hit-triangle", "closest-hit", "to-gray", "to-bitmap" or
    "memory-offset".
    weights: of red, green and blue.
    inclusive: a gray equal to the threshold is white.
    base, column_major, stride: of offsets.
    """
    if kind == "to-gray":
        red, green, blue = weights
        return gray_program((red, green, blue))
    if kind == "to-bitmap":
        return bitmap_program(inclusive)
    if kind == "memory-offset":
        return offset_program(base, column_major, stride)
    fixed = {"basis": BASIS, "hit-sphere": SPHERE, "hit-triangle": TRIANGLE}
    return (fixed | {"closest-hit": CLOSEST})[kind]


def value_case(
    kind: str, values: Mapping[str, Any], right: Any, given: Any, tolerance: float
) -> ValueCase:
    """Return a case of that kind.

    values: by the task's words (eye, target, up; origin, direction, center, radius, a, b, c;
    objects; rgb; gray, threshold; i, j, width, height).
    right, given: u, v, w (3, 3); t, inf for a miss; the object's number from 0 and t, (2,); an
    image (H, W); or a number.
    """
    known: dict[str, Any] = dict(values)
    for name in ("eye", "target", "up", "origin", "direction", "center", "a", "b", "c", "gray"):
        if name in known:
            known[name] = np.asarray(known[name], float)
    if kind == "to-gray":
        red, green, blue = np.moveaxis(np.asarray(values["rgb"], float), -1, 0)
        known |= {"red": red, "green": green, "blue": blue}
    if kind == "closest-hit":
        known |= SHAPES
    is_exact = kind in ("to-bitmap", "memory-offset")
    return ValueCase(known, right, given, None if is_exact else tolerance)
