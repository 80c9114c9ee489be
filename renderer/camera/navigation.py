"""Moving the camera: orbit, pan, zoom, and the switch of projection.

Pure functions from a camera to a camera. They also work for skewed, scaled and left-handed bases,
which turn rigidly. They raise LucidaError (from Camera) if a motion leaves the legal range; the
caller then keeps the old camera.

Points in the image are (x, y) on the image plane, in units of u and v (Camera.image_point).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.system.errors import LucidaError

from .camera import Camera
from .checks import LARGEST, Vector

Floats = NDArray[np.float64]
Point = tuple[float, float]

WORLD_UP = (0.0, 1.0, 0.0)
NEAREST, FARTHEST = 1e-4, 100.0  # where the wheel stops, in units of the scene's reach
WHEEL_STEP = 1.15  # things are larger by this factor after a turn of the wheel
SLOWEST = 0.1  # part of the scene's reach: the least depth of aim()
STEEPEST_DEG = 89.5  # angle of the view direction to the horizon, so that nothing flips


def turned(camera: Camera, pivot: ArrayLike, axis: ArrayLike, angle_rad: float) -> Camera:
    """Return the camera turned rigidly about an axis through the pivot, right-handed.

    Source: Rodrigues' rotation formula.
    """
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + math.sin(angle_rad) * cross + (1 - math.cos(angle_rad)) * cross @ cross
    center = np.asarray(pivot, float)
    eye = center + turn @ (np.asarray(camera.eye) - center)
    u, v, w = ((turn @ axis).tolist() for axis in (camera.u, camera.v, camera.w))
    return replace(camera, eye=eye.tolist(), u=u, v=v, w=w)


def orbited(camera: Camera, pivot: ArrayLike, right_rad: float, up_rad: float) -> Camera:
    """Return the camera on a turntable about the pivot, as if the world were dragged in the image.

    right_rad, up_rad: the drag to the right and upwards, as angles.

    The world's up stays up: there is no roll, and the view direction stops short of the poles. The
    dragged point follows the pointer in mirrored and upside-down images, too.
    """
    up = np.asarray(WORLD_UP)
    right = _horizontal_right(camera)
    back = np.asarray(camera.w) / np.linalg.norm(camera.w)
    mirrored = -1.0 if right @ camera.u < 0 else 1.0
    upside_down = -1.0 if np.cross(back, right) @ camera.v < 0 else 1.0
    elevation = math.asin(float(np.clip(back @ up, -1, 1)))
    limit = max(math.radians(STEEPEST_DEG), abs(elevation))
    lower = upside_down * up_rad  # dragging upwards lowers the eye
    steeper = float(np.clip(elevation - lower, -limit, limit)) - elevation
    camera = turned(camera, pivot, right, -steeper)
    return turned(camera, pivot, up, -mirrored * right_rad)


def panned(camera: Camera, start: Point, end: Point, parameter: float) -> Camera:
    """Return the camera moved so that the point seen at `start` is seen at `end`, exactly.

    parameter: the ray parameter of the dragged point (perspective only). Outside the lens,
    nothing moves.
    """
    if camera.lens is not None:
        offset = parameter * (camera.direction(*start) - camera.direction(*end))
        return moved(camera, offset) if np.isfinite(offset).all() else camera
    scale = 1.0 if camera.is_parallel else parameter
    dx, dy = (end[0] - start[0]) * scale, (end[1] - start[1]) * scale
    return moved(camera, -(dx * np.asarray(camera.u) + dy * np.asarray(camera.v)))


def moved(camera: Camera, offset: ArrayLike) -> Camera:
    """Return the camera with its eye moved by a world vector."""
    eye = np.asarray(camera.eye) + np.asarray(offset, float)
    return replace(camera, eye=eye.tolist())


def zoomed(camera: Camera, at: Point, factor: float, parameter: float) -> Camera:
    """Return the camera that sees things `factor` times as large, about the fixed image point `at`.

    Perspective: the eye moves along that ray towards the point at `parameter`, and never reaches
    it. Parallel: the viewport shrinks about `at`. Outside the lens, nothing moves.
    """
    if camera.is_parallel:
        return zoomed_viewport(camera, at, factor)
    direction = camera.direction(*at)
    if np.isnan(direction).any():
        return camera
    return moved(camera, (1 - 1 / factor) * parameter * direction)


def zoomed_viewport(camera: Camera, at: Point, factor: float) -> Camera:
    """Return the camera with its viewport shrunk by `factor` about a point of the image plane."""
    edges = zip((at[0], at[0], at[1], at[1]), camera.viewport, strict=True)
    left, right, bottom, top = (fixed + (edge - fixed) / factor for fixed, edge in edges)
    return replace(camera, viewport=(left, right, bottom, top))


def dollied(camera: Camera, focus: ArrayLike, distance: float) -> Camera:
    """Return the dolly zoom: another distance, and the eye moved along w so that things at the
    depth of `focus` keep their size and place in the image.

    A point seen at d x / z keeps its place if z grows as d does. This applies only in perspective,
    with the focus in front of the eye; otherwise only the distance changes.
    """
    changed = replace(camera, distance=distance)
    z = depth_of(camera, focus)
    if camera.is_parallel or not z > 1e-9:
        return changed
    return moved(changed, z * (distance / camera.distance - 1) * np.asarray(camera.w))


def distance_for(camera: Camera, fov_y_deg: float) -> float:
    """Return the distance at which the present viewport has a vertical field of view; any basis.

    The angle between bottom v - d w and top v - d w, tan = |cross| / dot, is a quadratic equation
    in d. If there are two distances, the larger one is returned. Raises LucidaError if no distance
    has that angle (a viewport that is all above, or all below, the eye's axis).
    """
    most = 180 if camera.lens is None else 360
    if not 0 < fov_y_deg < most:
        problem = f"{fov_y_deg:g} is not between 0 and {most}"
        raise LucidaError("field of view", problem, "give e.g. 40")
    if camera.lens is not None:
        return _distance_through_lens(camera, fov_y_deg)
    bottom, top = camera.viewport[2:]
    v, w = np.asarray(camera.v), np.asarray(camera.w)
    sine, cosine = math.sin(math.radians(fov_y_deg)), math.cos(math.radians(fov_y_deg))
    a = sine * float(w @ w)
    b = -sine * (bottom + top) * float(v @ w) - cosine * (top - bottom) * float(
        np.linalg.norm(np.cross(v, w))
    )
    c = sine * bottom * top * float(v @ v)
    root = b * b - 4 * a * c
    distance = (-b + math.sqrt(root)) / (2 * a) if root >= 0 else 0.0
    if not distance > 0:
        raise LucidaError(
            "field of view",
            f"{fov_y_deg:.12g} is more than this off-axis viewport has at any distance",
            "give less",
        )
    if distance > LARGEST:
        problem = f"{fov_y_deg:g} needs a viewport farther away than {LARGEST:g}"
        raise LucidaError("field of view", problem, "give more")
    return distance


def _distance_through_lens(camera: Camera, fov_y_deg: float) -> float:
    """Return the largest distance with that field of view, by bisection: the angle shrinks with
    distance.
    """

    def seen(exponent: float) -> float:
        return replace(camera, distance=2.0**exponent).fov_y_deg

    low, high = (round(math.log2(camera.distance)) + step for step in (-8.0, 16.0))
    if not seen(high) < fov_y_deg <= seen(low):
        problem = f"{fov_y_deg:g} is more than this viewport has through the lens"
        raise LucidaError("field of view", problem, "give another angle")
    while high - low > 1e-7:
        middle = (low + high) / 2
        low, high = (middle, high) if seen(middle) >= fov_y_deg else (low, middle)
    return 2.0**low


def with_shift(camera: Camera, axis: int, value: float) -> Camera:
    """Return the camera with the middle of its viewport at `value` along u (axis 0) or v (1), and
    its size unchanged.
    """
    left, right, bottom, top = camera.viewport
    low, high = ((left, right), (bottom, top))[axis]
    half = (high - low) / 2
    moved_edges = (value - half, value + half)
    return replace(
        camera,
        viewport=(*moved_edges, bottom, top) if axis == 0 else (left, right, *moved_edges),
    )


def may_zoom(
    before: Camera, after: Camera, target: ArrayLike, center: ArrayLike, reach: float
) -> bool:
    """Return True if a zoom goes neither too near nor too far. From outside the range, zooming back
    is always allowed.

    target: the point of the zoom (perspective).
    center, reach: the scene's; world units.
    """
    if before.is_parallel:
        was, width = (
            (c.viewport[1] - c.viewport[0]) * float(np.linalg.norm(c.u)) for c in (before, after)
        )
        near_was, near, far_was, far = was, width, was / 2, width / 2
    else:
        near_was, near, far_was, far = (
            float(np.linalg.norm(np.subtract(c.eye, point)))
            for point in (target, center)
            for c in (before, after)
        )
    return (near >= near_was or near > NEAREST * reach) and (
        far <= far_was or far < FARTHEST * reach
    )


def aim(shown: Camera, direction: Floats, center: Vector, reach: float) -> float:
    """Return the ray parameter that the wheel zooms at if nothing is hit: the depth of the scene's
    center, but never less than SLOWEST, so that the wheel can move past it.
    """
    slowest = SLOWEST * reach / max(float(np.linalg.norm(direction)), 1e-30)
    return max(parameter_of(shown, center, slowest), slowest)


def zoomed_by_wheel(
    camera: Camera,
    at: Point,
    steps: float,
    parameter: float,
    target: Vector,
    scope: tuple[Vector, float],
) -> Camera | None:
    """Return the camera after turns of the wheel, or None if it would be too near or too far.

    at: on the image plane under the mouse. target: the point there, at the parameter. scope: the
    scene's center and reach.
    """
    try:
        found = zoomed(camera, at, WHEEL_STEP**steps, parameter)
    except (LucidaError, OverflowError):
        return None
    return found if may_zoom(camera, found, target, *scope) else None


def switched_projection(camera: Camera, focus: ArrayLike) -> Camera:
    """Return the camera with the other projection, in which things at the depth of `focus` keep
    their size.

    At ray parameter t, a perspective viewport sees t times its own width, so a parallel one needs
    that width (and vice versa). If the focus is not in front of the eye, the viewport is kept. The
    lens is removed, because parallel rays pass through none.
    """
    camera = camera.pinhole
    parameter = depth_of(camera, focus) / camera.distance
    scale = parameter if parameter > 1e-6 else 1.0
    if camera.is_parallel:
        scale = 1 / scale
    projection = "perspective" if camera.is_parallel else "parallel"
    left, right, bottom, top = (edge * scale for edge in camera.viewport)
    return replace(camera, viewport=(left, right, bottom, top), projection=projection)


def parameter_of(camera: Camera, point: ArrayLike, behind: float = 1.0) -> float:
    """Return the ray parameter at the depth of a world point (through most lenses: at its distance
    from the eye); `behind` if it is behind the eye.
    """
    if camera.lens is not None:
        parameter = float(camera.project(point, (1, 1)).parameter)
        return parameter if parameter > 1e-9 else behind
    depth = depth_of(camera, point)
    parameter = depth if camera.is_parallel else depth / camera.distance
    return parameter if parameter > 1e-9 else behind


def depth_of(camera: Camera, point: ArrayLike) -> float:
    """Return how far a world point is in front of the eye, along -w, in units of w."""
    return -float((camera.camera_from_world @ [*np.asarray(point, float), 1.0])[2])


def _horizontal_right(camera: Camera) -> Floats:
    """Return the level direction to the right of the view direction, for a right-handed basis; of
    any length.
    """
    back = np.asarray(camera.w) / np.linalg.norm(camera.w)
    right = np.cross(WORLD_UP, back)
    if np.linalg.norm(right) < 1e-6:  # straight up or down: use v
        right = np.cross(camera.v, back)
        right[1] = 0.0
    return right
