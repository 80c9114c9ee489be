"""The basis: editing one component while it stays orthonormal, and measuring it.

Pure functions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, cross, dot, volume

# For each edited vector: the one that is adjusted first, and its replacement.
_NEXT = {"u": ("v", "w"), "v": ("w", "u"), "w": ("v", "u")}
_TOWARDS = {"u": "w", "v": "w", "w": "u"}


def with_component(camera: Camera, name: str, axis: int, value: float) -> Camera:
    """Return the orthonormal camera with component `axis` (0, 1, 2) of u, v or w set to `value`.

    The edited vector keeps length 1 with exactly this component (clamped to -1 to 1); its other two
    components keep their ratio. The other vectors follow by Gram-Schmidt, and the handedness stays.
    Raises LucidaError.
    """
    value = min(max(value, -1.0), 1.0)
    rest = np.array(getattr(camera, name), float)
    rest[axis] = 0.0
    if np.linalg.norm(rest) < 1e-9:  # along the axis: turn towards another vector
        rest = np.array(getattr(camera, _TOWARDS[name]), float)
        rest[axis] = 0.0
    edited = rest * (math.sqrt(1 - value * value) / np.linalg.norm(rest))
    edited[axis] = value
    return with_vector(camera, name, edited)


def with_vector(camera: Camera, name: str, vector: Floats) -> Camera:
    """Return the orthonormal camera whose u, v or w points along `vector`; the other two follow.

    Source: Gram-Schmidt, from the vector that must keep its direction.
    """
    length = np.linalg.norm(vector)
    first = vector if abs(length - 1) < 1e-12 else vector / length  # keeps entered numbers exact
    second_name, third_name = _NEXT[name]
    second = np.asarray(getattr(camera, second_name), float)
    second = second - (second @ first) * first
    if np.linalg.norm(second) < 1e-6:  # the new vector took the second one's place
        second = np.asarray(getattr(camera, name), float)
        second = second - (second @ first) * first
    second = second / np.linalg.norm(second)
    third = np.cross(first, second)
    basis = {name: first, second_name: second, third_name: third}
    if volume(*(basis[n] for n in "uvw")) * camera.determinant < 0:
        basis[third_name] = -third
    return replace(camera, **{name: axis.tolist() for name, axis in basis.items()})


@dataclass(frozen=True)
class Measures:
    """The measures of three vectors u, v, w.

    lengths: |u|, |v|, |w|. angles_deg: between u and v, v and w, w and u; NaN if one has no length.
    determinant: the volume, negative if they are left-handed; 0 (NaN if numbers are not finite) if
    they are not a basis.
    """

    lengths: Vector
    angles_deg: Vector
    determinant: float


def measures(u: Vector, v: Vector, w: Vector) -> Measures:
    """Measure three vectors, which need not be a basis."""
    a, b, c = (math.hypot(*vector) for vector in (u, v, w))
    uv, vw, wu = (
        math.degrees(math.atan2(math.hypot(*cross(one, two)), dot(one, two)))
        if any(one) and any(two)
        else math.nan
        for one, two in ((u, v), (v, w), (w, u))
    )
    return Measures((a, b, c), (uv, vw, wu), volume(u, v, w))
