"""The program for each kind of function, and the values that its lines use."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

import numpy as np

from lucida.app.checking.mistakes.catalogue import part
from lucida.app.checking.mistakes.hits import SHAPES
from lucida.app.checking.mistakes.program import Program
from lucida.app.checking.mistakes.value_diagnosis import ValueCase
from lucida.renderer.camera.checks import Vector
from lucida.renderer.images.shared_numbers import LUMINANCE


@functools.cache
def value_program(
    kind: str,
    weights: Vector = LUMINANCE,
    inclusive: bool = True,
    base: int = 0,
    column_major: bool = False,
    stride: int = 1,
) -> Program:
    """Return the program of a kind. Raises KeyError for unknown kinds.

    kind: "basis", "hit-sphere", "hit-triangle", "closest-hit", "to-gray", "to-bitmap",
    "memory-offset", "project", "project-fisheye" or "undistort".
    weights: of red, green and blue.
    inclusive: a gray equal to the threshold is white.
    base, column_major, stride: of offsets, in bytes per pixel. A stride of 1 counts pixels.
    """
    values: dict[str, str] = {}
    facts: set[str] = set()
    match kind:
        case "basis":
            values, facts = {"back": "eye - target"}, {"target"}
        case "to-gray":
            red, green, blue = (f"{weight:g}" for weight in weights)
            values = {"red": red, "green": green, "blue": blue}
        case "to-bitmap":
            signs = (">=", ">", "<", "<=") if inclusive else (">", ">=", "<=", "<")
            values = dict(zip(("sign", "other", "inverse", "darker"), signs, strict=True))
            at = "is white as well: at least" if inclusive else "is black: more than"
            values["at_threshold"] = at
        case "memory-offset":
            i, j = ("i", "j") if base == 0 else (f"(i - {base})", f"(j - {base})")
            place, other = f"{i} * width + {j}", f"{j} * height + {i}"
            values = {"i": i, "j": j, "base": str(base), "stride": str(stride)}
            values |= {"place": place, "other": other, "order": "row after row", "scaled": ""}
            facts = {"base"} if base else set()
            if column_major:
                values |= {"place": other, "other": place, "order": "column after column"}
                facts.add("column-major")
            if stride != 1:
                values["scaled"] = f" * {stride}"
                facts.add("stride")
    lines, mistakes = part(kind, values, facts)
    if kind == "basis":
        answer, more = part("answer")
        lines, mistakes = lines + answer, mistakes + more
    return Program(tuple(lines), tuple(mistakes), (lines[-1].code.partition(" ")[0],))


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
