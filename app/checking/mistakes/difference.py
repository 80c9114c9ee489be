"""Comparison of a fitted camera with the required one, and the words for it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.checking.mistakes.fitted import AffineRays
from renderer.camera import Camera, Size

Floats = NDArray[np.float64]

OPPOSITE = {
    "u": "your u points to the left",
    "v": "your v points down",
    "w": "your w points forwards",
}


@dataclass(frozen=True, eq=False)
class Fit:
    """A required camera, and the affine rays that were given for it. target, up: the vectors that
    the task passes instead of a basis, or None.
    """

    asked: Camera
    size: Size
    rays: AffineRays
    target: ArrayLike | None = None
    up: ArrayLike | None = None


@dataclass(frozen=True)
class Difference:
    """A difference in one parameter.

    sayings: all that is true of it in general words, the most telling first.
    numbers: the same in this camera's numbers.
    """

    topic: str
    sayings: tuple[str, ...]
    numbers: str


Told = tuple[Difference, ...]


def in_words(topic: str, saying: str) -> Difference:
    """Return a difference with one saying, which needs no numbers."""
    return Difference(topic, (saying,), saying)


def factors(fit: Fit, lengths: Sequence[tuple[float, float]]) -> list[float]:
    """Return the possible factors of the directions: 1 if they kept their own lengths, and for each
    (found, required) length the factor that corrects it.
    """
    own = [1.0] if fit.rays.is_parallel or fit.rays.keeps_lengths else []
    if fit.rays.is_parallel:
        return own
    return own + [wanted / found for found, wanted in lengths if found > 0 and wanted > 0]


def closeness(fit: Fit) -> float:
    """Return the tolerance relative to the viewport's size: the error of the rays on the
    viewport.
    """
    rays, size = fit.rays, fit.size
    extent = min(
        float(np.linalg.norm(rays.column)) * size[0], float(np.linalg.norm(rays.row)) * size[1]
    )
    largest = rays.scale if rays.is_parallel else float(np.linalg.norm(rays.at))
    return 1e-9 + 16 * rays.error * max(1.0, largest / max(extent, 1e-300))


def is_close(a: ArrayLike, b: ArrayLike, relative: float, least: float = 0.0) -> bool:
    """Return True if two vectors or numbers are equal relative to the larger one, or to `least`."""
    size = max(float(np.linalg.norm(a)), float(np.linalg.norm(b)), least)
    return float(np.linalg.norm(np.subtract(a, b))) <= relative * size


def causes(fit: Fit, factor: float, close: float) -> Iterator[str]:
    """Yield mistakes in the field of view that enlarge the viewport by this factor. The angle is
    that of the viewport's half or of its edge. A negative factor also turns the viewport by half a
    turn.
    """
    left, right, bottom, top = fit.asked.viewport
    high, wide, d = (top - bottom) / 2, (right - left) / 2, fit.asked.distance
    for half, edge in dict.fromkeys(((high, high), (wide, wide), (high, top), (wide, right))):
        if edge <= 0:
            continue
        angle = math.atan2(edge, d)
        made = {
            "an angle in radians were in degrees": math.tan(math.radians(angle)),
            "an angle in degrees were in radians": math.tan(math.degrees(angle)),
            "the whole angle were half of it": math.tan(2 * angle),
            "half the angle were the whole": math.tan(angle / 2),
            "the tangent were left out": angle,
            "the tangent were upside down": 1 / math.tan(angle),
        }
        for cause, wrong in made.items():
            wanted = wrong * d / half
            if abs(wanted - 1) > close and abs(factor - wanted) <= close * abs(wanted):
                yield f"as if {cause}"


def number(value: float) -> str:
    rounded = f"{value:.4g}"
    return "0" if rounded == "-0" else rounded


def text(vector: Floats) -> str:
    size = float(np.abs(vector).max())
    return "(" + ", ".join(number(0.0 if abs(x) < 1e-9 * size else x) for x in vector) + ")"
