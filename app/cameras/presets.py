"""The classic cameras: six sides, axonometric and oblique views; and framing.

Pure functions.

Sources: Carlbom and Paciorek 1978, "Planar geometric projections and viewing transformations"
(isometric, cavalier, cabinet); ISO 5456-3 (dimetric: 7 and 42 degrees, 1 : 1 : 1/2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.scene.model import View

WIDEST = 1.0  # slope up to which a lens counts as a frame: 45 degrees to each side
MARGIN = 1.1  # the picture's size relative to the framed points
SMALLEST = 1e-9  # smallest extent, relative to the distance to the world's origin

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True)
class Preset:
    """A basis with a name."""

    name: str
    u: Vector
    v: Vector
    w: Vector


def _looking_along(w: Vector) -> tuple[Vector, Vector, Vector]:
    """Return the orthonormal basis of a camera that looks along -w, with y upwards."""
    camera = Camera.look_at(w, (0.0, 0.0, 0.0))
    return camera.u, camera.v, camera.w


def _receding(factor: float) -> Vector:
    """Return the w of an oblique view of the xy plane, which sees the point (0, 0, -1) at `factor`
    times (cos 45 deg, sin 45 deg): (0, 0, -1) = x u + y v - w.
    """
    part = factor * math.sqrt(0.5)
    return (part, part, 1.0)


PRESETS = (
    Preset("Front", (1, 0, 0), (0, 1, 0), (0, 0, 1)),
    Preset("Back", (-1, 0, 0), (0, 1, 0), (0, 0, -1)),
    Preset("Left", (0, 0, 1), (0, 1, 0), (-1, 0, 0)),
    Preset("Right", (0, 0, -1), (0, 1, 0), (1, 0, 0)),
    Preset("Top", (1, 0, 0), (0, 0, -1), (0, 1, 0)),
    Preset(
        "Bottom",
        (1, 0, 0),
        (0, 0, 1),
        (0, -1, 0),
    ),
    Preset(
        "Isometric",
        *_looking_along((1.0, 1.0, 1.0)),
    ),
    Preset(
        "Dimetric",
        *_looking_along((1.0, 1.0, math.sqrt(7.0))),
    ),
    Preset(
        "Cavalier",
        AXES["x"],
        AXES["y"],
        _receding(1.0),
    ),
    Preset(
        "Cabinet",
        AXES["x"],
        AXES["y"],
        _receding(0.5),
    ),
)


def preset_view(
    preset: Preset,
    view: View,
    framed_points: ArrayLike,
    everything: ArrayLike,
    aspect: float,
) -> View:
    """Return the preset's camera, in parallel projection, with the scene in the picture.

    framed_points, everything: (n, 3), world space, as in Focus.
    aspect: the image's width over its height.

    Raises LucidaError if the scene is too large for a camera.
    """
    viewport = (-aspect / 2, aspect / 2, -0.5, 0.5)
    camera = Camera(u=preset.u, v=preset.v, w=preset.w, viewport=viewport, projection="parallel")
    return replace(view, camera=framed(camera, framed_points, everything))


def framed(camera: Camera, points: ArrayLike, everything: ArrayLike = ()) -> Camera:
    """Return the camera moved so that `points` (n, 3) fill its viewport, centred in it.

    The basis, which may be any, and the viewport's shape stay. In perspective the eye moves; in
    parallel projection the viewport is resized. Without points, the camera is unchanged.
    everything: points that must also be in front of a parallel camera.
    A lens counts as the pinhole with its viewport, up to WIDEST.

    Raises LucidaError.
    """
    if camera.lens is not None:
        most = WIDEST * camera.distance
        left, right, bottom, top = np.clip(camera.viewport, -most, most).tolist()
        frame = replace(camera.pinhole, viewport=(left, right, bottom, top))
        return replace(camera, eye=framed(frame, points).eye)
    world = np.asarray(points, float).reshape(-1, 3)
    if not len(world):
        return camera
    linear = camera.camera_from_world[:3, :3]
    local = world @ linear.T
    low, high = local.min(axis=0), local.max(axis=0)
    middle = (low + high) / 2
    least = SMALLEST * (1.0 + float(np.abs(local).max()))
    left, right, bottom, top = camera.viewport
    center = np.array([left + right, bottom + top]) / 2
    half = np.array([right - left, top - bottom]) / 2 / MARGIN
    if camera.is_parallel:
        scale = float(max(((high - low)[:2] / 2 / half).max(), (least / half).max()))
        edges = (np.array(camera.viewport) * scale).tolist()
        heights = np.concatenate([local, np.asarray(everything, float).reshape(-1, 3) @ linear.T])
        back = float(heights[:, 2].max())
        z = back + max(0.25 * (back - float(heights[:, 2].min())), least)
        at = np.append(middle[:2] - center * scale, z)
        return replace(camera, eye=(camera.basis @ at).tolist(), viewport=tuple(edges))
    # A point at local (X, Y, Z) is seen at d (X - ex) / (ez - Z), with ex so that the middle is
    # seen at the centre. |d (X - mx) + cx (Z - mz)| <= half (ez - Z) gives the least ez.
    aside = np.abs(camera.distance * (local - middle)[:, :2] + center * (local - middle)[:, 2:])
    needed = local[:, 2] + np.maximum(aside / half, least).max(axis=1)
    z = float(max(needed.max(), high[2] + 0.05 * (high[2] - low[2])))
    at = np.append(middle[:2] - center / camera.distance * (z - middle[2]), z)
    return replace(camera, eye=(camera.basis @ at).tolist())


def look_at(view: View, eye: Iterable[float], target: Iterable[float], up: Iterable[float]) -> View:
    """Return the view from `eye` towards `target`, with `up` upwards; everything else is unchanged.

    Raises LucidaError naming eye, target or up.
    """
    camera = Camera.look_at(eye, target, up)
    return replace(
        view, camera=replace(view.camera, eye=camera.eye, u=camera.u, v=camera.v, w=camera.w)
    )


def clip_around(camera: Camera, points: ArrayLike) -> tuple[float, float]:
    """Return near and far, in units of w and rounded to three digits, that clip none of `points`
    (n, 3). They are the initial planes when clipping is switched on.
    """
    world = np.asarray(points, float).reshape(-1, 3)
    matrix = camera.camera_from_world
    depths = -(world @ matrix[2, :3] + matrix[2, 3])
    farthest = float(depths.max()) if len(depths) else 0.0
    if not farthest > 0:
        return 0.1, 100.0
    far = _outwards(1.01 * farthest, math.ceil)
    nearest = 0.99 * float(depths.min())
    return (_outwards(nearest, math.floor) if nearest > far / 1000 else far / 1000), far


def _outwards(value: float, rounding: object) -> float:
    digits = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{rounding(value / digits) * digits:.3g}")  # type: ignore[operator]
