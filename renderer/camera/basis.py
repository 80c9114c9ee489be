"""The basis of a camera: from a target, orthonormalised, and inverted."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from lucida.renderer.system.errors import LucidaError

from .checks import SMALLEST, Floats, Vector, listed, numbers, three

Basis = tuple[Vector, Vector, Vector]


def looking_at(
    eye: Iterable[float], target: Iterable[float], up: Iterable[float]
) -> tuple[Vector, Basis]:
    """Return the eye and an orthonormal basis that looks from it at a target, with `up` upwards in
    the image. Raises LucidaError.

    Source: Marschner and Shirley, Fundamentals of Computer Graphics, "Constructing a basis".
    """
    position, toward, upward = (
        np.array(numbers(name, value, 3))
        for name, value in (("eye", eye), ("target", target), ("up", up))
    )
    back = position - toward
    if not np.linalg.norm(back) >= SMALLEST:
        at = listed(toward)
        raise LucidaError("target", f"{at} is the eye itself", "look at another point")
    if not np.linalg.norm(upward) >= SMALLEST:
        remedy = "give a vector such as (0, 1, 0)"
        raise LucidaError("up", f"{listed(upward)} has no direction", remedy)
    w = back / np.linalg.norm(back)
    right = np.cross(upward / np.linalg.norm(upward), w)
    if not np.linalg.norm(right) > 1e-8:
        problem = f"{listed(upward)} is along the view direction"
        raise LucidaError("up", problem, "give another up")
    u = right / np.linalg.norm(right)
    return three(position), (three(u), three(np.cross(w, u)), three(w))


def orthonormal(u: Vector, v: Vector, w: Vector) -> Basis:
    """Return a basis orthonormalised by Gram-Schmidt; see Camera.orthonormalized()."""
    across, upward, back = (np.asarray(vector) for vector in (u, v, w))
    back = back / np.linalg.norm(back)
    upward = upward - (back @ upward) * back
    upward /= np.linalg.norm(upward)
    across = across - (back @ across) * back
    across -= (upward @ across) * upward
    across /= np.linalg.norm(across)
    return three(across), three(upward), three(back)


@lru_cache(maxsize=8)  # several views need the same camera's in a frame
def inverse(eye: Vector, u: Vector, v: Vector, w: Vector) -> Floats:
    """Return camera_from_world (4, 4), read-only."""
    linear = np.linalg.inv(np.array((u, v, w)).T)
    matrix = np.zeros((4, 4))
    matrix[:3, :3], matrix[:3, 3], matrix[3, 3] = linear, -linear @ eye, 1.0
    matrix.flags.writeable = False
    return matrix
