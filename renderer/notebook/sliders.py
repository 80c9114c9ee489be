"""The sliders of the live widget: a camera's numbers, and the camera after one has changed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.lenses import MODELS, USUAL, coefficient_range, with_coefficient
from lucida.renderer.camera.navigation import depth_of, distance_for, zoomed_viewport
from lucida.renderer.scene.focus import Focus


@dataclass(frozen=True)
class Slider:
    """A slider for a number. name: its field and, in a vector, its index: "eye.0". low, high: of
    the slider; the number may exceed them. logarithmic: low and high are above 0.
    """

    name: str
    label: str
    value: float
    low: float
    high: float
    logarithmic: bool = False


def sliders_of(camera: Camera, target: Vector, focus: Focus) -> list[Slider]:
    """Return a camera's sliders.

    They are the target of a level camera, or u, v and w; the field of view and the distance in
    perspective, or the viewport's height; and a lens's coefficients. target: the point looked at.
    """
    middle, reach = focus.center, focus.reach

    def vector(name: str, value: Vector) -> list[Slider]:
        ends = [(c - reach, c + reach) for c in middle] if name in ("eye", "target") else [(-1, 1)]
        named = zip("xyz", value, (ends * 3)[:3], strict=True)
        return [
            Slider(f"{name}.{k}", f"{name} {axis}", number, *range_)
            for k, (axis, number, range_) in enumerate(named)
        ]

    found = vector("eye", camera.eye)
    if is_level(camera):
        found += vector("target", target)
    else:
        found += [slider for name in "uvw" for slider in vector(name, getattr(camera, name))]
    if camera.is_parallel:
        bottom, top = camera.viewport[2:]
        ends = 0.02 * reach, 20 * reach
        return [*found, Slider("height", "viewport height", top - bottom, *ends, logarithmic=True)]
    angle = camera.fov_y_deg
    widest = 120.0 if angle < 120 else 359.0
    found.append(Slider("fov", "field of view \N{DEGREE SIGN}", angle, 1, widest))
    found.append(Slider("distance", "distance", camera.distance, 0.1, 10, logarithmic=True))
    if (lens := camera.lens) is not None:
        shown = dict.fromkeys((*USUAL.get(lens.model, MODELS[lens.model]), *lens.coefficients))
        found += [
            Slider(f"lens.{k}", k, lens.coefficient(k), *coefficient_range(lens.model, k))
            for k in shown
        ]
    return found


def with_number(camera: Camera, name: str, value: float, target: Vector) -> Camera:
    """Return the camera with another value of a slider. Raises LucidaError."""
    field, _, part = name.partition(".")
    match field:
        case "target":
            look = Camera.look_at(camera.eye, _with_part(target, part, value))
            return replace(camera, u=look.u, v=look.v, w=look.w)
        case "fov":
            return replace(camera, distance=distance_for(camera, value))
        case "height":
            left, right, bottom, top = camera.viewport
            middle = (left + right) / 2, (bottom + top) / 2
            return zoomed_viewport(camera, middle, (top - bottom) / value if value else math.inf)
        case "lens":
            assert camera.lens is not None
            return replace(camera, lens=with_coefficient(camera.lens, part, value))
        case "distance":
            return replace(camera, distance=value)
        case _:
            fields: dict[str, Any] = {field: _with_part(getattr(camera, field), part, value)}
            return replace(camera, **fields)


def is_level(camera: Camera) -> bool:
    """Return True if the basis is orthonormal, right-handed and without roll, as
    Camera.look_at()'s.
    """
    basis = camera.basis
    orthonormal = np.allclose(basis.T @ basis, np.eye(3), atol=1e-6)
    return bool(
        orthonormal and camera.determinant > 0 and camera.v[1] > 0 > abs(camera.u[1]) - 1e-6
    )


def target_of(camera: Camera, focus: Focus, last: Vector) -> Vector:
    """Return the point that a camera looks at: the last one, if it is still in the view direction,
    or else the one at the depth of the scene's middle.
    """
    back = np.asarray(camera.w)
    toward = np.asarray(last) - camera.eye
    off_axis = np.linalg.norm(np.cross(toward, back))
    if toward @ back < 0 and off_axis < 1e-6 * np.linalg.norm(toward) * np.linalg.norm(back):
        return last
    depth = depth_of(camera, focus.center)
    nearest = 0.1 * focus.reach / float(np.linalg.norm(back))
    x, y, z = (np.asarray(camera.eye) - max(depth, nearest) * back).tolist()
    return x, y, z


def _with_part(vector: Vector, part: str, value: float) -> tuple[float, ...]:
    return tuple(value if str(k) == part else number for k, number in enumerate(vector))
