"""The view along rays: a fixed scene in front of the camera turns wrong rays into a wrong picture.

The scene is in the frustum's own coordinates. There, the correct rays of a perspective camera are
(0, 0, 0) + t (X, Y, -1), with Y from -1 to 1 over the image's height and X by its aspect ratio.
Those of a parallel camera are (4 X, 4 Y, 0) + t (0, 0, -1). The correct picture is therefore the
same for all cameras: a checkered floor, a red sphere on the left, a blue one behind on the right, a
small yellow one above. The map from the world is affine: a line stays a line, and any other ray,
wherever it starts, sees what it would see among the correct ones.

For the pictures of a wrong answer, the student's function is called once more, for a larger image
of the first wrong case's camera, because the checked images are small.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.checked import TaskResult, WrongCase
from lucida.app.checking.conventions import Shot
from lucida.app.checking.kinds.shapes import hits
from lucida.app.checking.kinds.viewing_ray import VIEWING_RAY, cases_of
from lucida.app.checking.reports.told import told
from lucida.app.checking.running.program import ProgramStudent
from lucida.app.checking.tasks import Failure
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images import to_srgb8

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

DEPTH = 4.0  # of the scene's middle, where both projections see the same
SPHERES = (  # centre, radius, colour
    ((-1.9, -0.9, -3.6), 1.3, (0.75, 0.08, 0.05)),
    ((2.2, -0.3, -5.4), 1.5, (0.05, 0.16, 0.70)),
    ((0.6, 2.0, -4.2), 0.7, (0.80, 0.55, 0.02)),
)
FLOOR, SLOPE = -2.4, 0.3  # height at the scene's middle; rises away from the eye
CELL, CELLS = 2.0, ((0.72, 0.72, 0.68), (0.24, 0.26, 0.28))
FADED = 14.0  # distance at which the cells have faded to one colour
HORIZON, ZENITH = (0.86, 0.90, 0.94), (0.28, 0.48, 0.80)
NO_RAY = (0.35, 0.0, 0.35)  # for missing numbers or directions
TOWARDS_LIGHT = np.array([-0.48, 0.72, 0.5]) / np.linalg.norm([-0.48, 0.72, 0.5])
AMBIENT = 0.25

# Of the picture of a difference.
SEEN = 2  # of 255: pixels that differ by more are marked
GRAY = 0.4  # brightness of the other pixels
MARK = (255, 176, 0)


def _in_frustum(camera: Camera, size: Size, rays: Floats) -> Floats:
    """Convert rays (..., 2, 3), origin and direction, from the world to the frustum's
    coordinates.
    """
    left, right, bottom, top = camera.viewport
    half = np.array([(right - left) / 2 * size[1] / size[0], (top - bottom) / 2])
    middle = np.array([left + right, bottom + top]) / 2
    distance = camera.distance
    to_frustum, offset = np.diag([*1 / half, 1 / distance]), np.zeros(3)
    if camera.is_parallel:
        to_frustum *= DEPTH
        offset[:2] = -DEPTH * middle / half
    else:
        to_frustum[:2, 2] = middle / half / distance
    to_frustum = to_frustum @ np.linalg.inv(camera.basis)
    with np.errstate(all="ignore"):
        inside = (rays - np.array([camera.eye, np.zeros(3)])) @ to_frustum.T
    inside[..., 0, :] += offset
    return inside


def picture(camera: Camera, size: Size, rays: Floats) -> Bytes:
    """Return the picture that rays (H, W, 2, 3) of the world see, sRGB (H, W, 3)."""
    inside = _in_frustum(camera, size, rays)
    origin, direction = inside[..., 0, :], inside[..., 1, :]
    with np.errstate(all="ignore"):
        direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
        upwards = np.clip(direction[..., 1:2] * 1.5, 0, 1)
        color = np.array(HORIZON) * (1 - upwards) + np.array(ZENITH) * upwards
        nearest, floor = _floor(origin, direction)
        color = np.where(np.isfinite(nearest)[..., None], floor, color)
        for center, radius, albedo in SPHERES:
            sphere = {"type": "sphere", "center": center, "radius": radius}
            t, _ = hits(origin, direction, sphere)
            at = origin + t[..., None] * direction
            normal = (at - center) / radius
            light = AMBIENT + (1 - AMBIENT) * np.maximum(normal @ TOWARDS_LIGHT, 0)
            shaded = light[..., None] * np.array(albedo)
            is_nearer = t < nearest
            color = np.where(is_nearer[..., None], shaded, color)
            nearest = np.where(is_nearer, t, nearest)
    is_ray = np.isfinite(origin).all(-1) & np.isfinite(direction).all(-1)
    return to_srgb8(np.where(is_ray[..., None], color, NO_RAY).astype(np.float32))


def _floor(origin: Floats, direction: Floats) -> tuple[Floats, Floats]:
    """Return t > 0 at which each ray hits the floor, inf for a miss, and the colour there."""
    across = np.array([0.0, 1.0, SLOPE])
    t = (FLOOR - SLOPE * DEPTH - origin @ across) / (direction @ across)
    t = np.where(t > 0, t, np.inf)
    at = origin + t[..., None] * direction
    cell = np.floor(at[..., 0] / CELL) + np.floor(at[..., 2] / CELL)
    first, second = map(np.array, CELLS)
    contrast = np.where(cell % 2 == 0, 0.5, -0.5) * np.clip(1 - t / FADED, 0, 1)
    return t, (first + second) / 2 + contrast[..., None] * (first - second)


def changed_pixels(right: Bytes, wrong: Bytes) -> NDArray[np.bool_]:
    """Return the pixels in which two displayed pictures differ visibly, (H, W)."""
    differs: NDArray[np.bool_] = (
        np.abs(right.astype(np.int16) - wrong.astype(np.int16)).max(axis=2) > SEEN
    )
    return differs


def difference_picture(right: Bytes, changed: NDArray[np.bool_]) -> Bytes:
    """Return the differing pixels, bright on the correct picture in dark gray."""
    gray = (GRAY * right.mean(axis=2)).astype(np.uint8)
    picture: Bytes = np.repeat(gray[..., None], 3, axis=2)
    picture[changed] = MARK
    return picture


SIDE = 96  # approximate picture size; a whole multiple of the case's size


@dataclass(frozen=True, eq=False)
class Pictured:
    """Pictures, sRGB (H, W, 3): the given answer and the correct one."""

    given: Bytes
    right: Bytes


def pictured(student: ProgramStudent, result: TaskResult) -> Pictured | None:
    """Return the pictures of a wrong answer, as far as the task's feedback allows.

    Return None for other kinds of functions, or if the student's code fails at a larger image.
    """
    first = told(result).first
    if first is None or first.case.camera is None:
        return None
    if result.task.kind == "viewing-ray":
        return _of_rays(student, result, first)
    if result.task.kind == "render":
        return _of_images(result, first)
    return None


def _of_rays(student: ProgramStudent, result: TaskResult, first: WrongCase) -> Pictured | None:
    case = first.case
    assert case.camera and case.size and case.target and case.up
    camera, (width, height) = case.camera, case.size
    times = max(1, SIDE // max(width, height))
    size = width * times, height * times
    task, kind = result.task, VIEWING_RAY
    shot = Shot(camera, size, case.target, case.up)
    cases = cases_of(task, shot)
    run = student.call(kind.calls(task, cases))
    if run.failure or any(isinstance(value, Failure) for value in run.values):
        return None
    given, problems = kind.given(task, cases, run.values)
    if problems:
        return None
    right = [one.right for one in cases]
    rays = (np.reshape(part, (size[1], size[0], 2, 3)) for part in (given, right))
    return Pictured(*(picture(camera, size, part) for part in rays))


def _of_images(result: TaskResult, first: WrongCase) -> Pictured | None:
    given, right = first.answer, np.asarray(first.case.right, float)
    upright = -1 if result.task.conventions.rows == "bottom" else 1
    return Pictured(_bytes(np.asarray(given, float)[::upright]), _bytes(right[::upright]))


def _bytes(image: NDArray[np.float64]) -> Bytes:
    """Return numbers from 0 to 1 as bytes, unconverted; black where they are missing."""
    return np.rint(255 * np.clip(np.nan_to_num(image), 0, 1)).astype(np.uint8)
