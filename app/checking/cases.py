"""Cameras generated from a seed, from the simplest to the most general that the formula allows.

All are well conditioned, so that a correct float32 answer is close to the exact one: their angles,
distances and basis avoid values at which numbers cancel.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size

from .conventions import Conventions, Shot
from .tasks import CAMERA_KINDS, RIGID_KINDS, CheckTask

if TYPE_CHECKING:
    from numpy.random import Generator as Random

SIDES = (3, 9)  # of generated images: enough for a fit, with few calls


def generator(task: CheckTask) -> Random:
    """Return the task's random number generator. Tasks with the same seed have different
    generators.
    """
    return np.random.default_rng([task.seed, zlib.crc32(task.name.encode())])


def rounded(value: float, digits: int = 2) -> float:
    return round(float(value), digits)


def point(random: Random, reach: float = 5.0) -> Vector:
    """Return a point whose coordinates have few digits."""
    x, y, z = (rounded(value) for value in random.uniform(-reach, reach, 3))
    return x, y, z


def camera_kinds(conventions: Conventions) -> tuple[str, ...]:
    """Return the kinds of cameras that these conventions can describe."""
    if conventions.needs_rigid:
        return RIGID_KINDS
    if conventions.space == "camera":  # lengths and angles must be the world's
        return tuple(kind for kind in CAMERA_KINDS if kind != "skewed")
    return CAMERA_KINDS


def shots(task: CheckTask) -> Iterator[Shot]:
    """Yield the task's cameras by kind, the simplest first."""
    random = generator(task)
    kinds, conventions = task.cameras, task.conventions
    for number in range(task.count):
        size = task.size or _size(random)
        kind = kinds[number * len(kinds) // max(task.count, len(kinds))]
        made, target, up = _KINDS[kind](random, size)
        camera = replace(made, projection=task.projection)
        if conventions.needs_rigid and kind != "turned":
            camera = camera.fitted(size)
        if conventions.mirrored:
            x, y, z = camera.u
            camera = replace(camera, u=(-x, -y, -z))
        yield Shot(camera, size, target, up)


def _size(random: Random) -> Size:
    """Return a size that is never square, to expose exchanged width and height."""
    width, height = random.choice(np.arange(SIDES[0], SIDES[1] + 1), 2, replace=False).tolist()
    return width, height


def _vector(values: np.ndarray) -> Vector:
    x, y, z = np.asarray(values, float).tolist()
    return x, y, z


Made = tuple[Camera, Vector, Vector]


def _canonical(random: Random, size: Size) -> Made:
    return Camera.canonical(), (0.0, 0.0, -rounded(random.uniform(1.5, 4.0))), (0.0, 2.0, 0.0)


def _moved(random: Random, size: Size) -> Made:
    """Return a camera with the world's basis, another eye and another distance."""
    eye = point(random)
    distance = rounded(random.uniform(0.6, 2.5))
    distance += 0.25 * (abs(distance - 1.0) < 0.1)
    x, y, z = eye
    away = rounded(random.uniform(1.5, 4.0))
    return Camera(eye=eye, distance=distance), (x, y, z - away), (0.0, 2.0, 0.0)


def look(random: Random) -> tuple[Vector, Vector, Vector]:
    """Return an eye, a target and an up vector. Up is neither of length 1 nor perpendicular to the
    view direction.
    """
    while True:
        eye, target = point(random), point(random, 2.0)
        upwards = np.array([0.0, 1.0, 0.0]) + random.uniform(-0.5, 0.5, 3)
        up = _vector(np.round(upwards * random.uniform(0.5, 2.0), 2))
        back = np.subtract(eye, target)
        sine = np.linalg.norm(np.cross(up, back)) / np.linalg.norm(up) / np.linalg.norm(back)
        if np.linalg.norm(back) > 1.0 and sine > 0.3:
            return eye, target, up


def _turned(random: Random, size: Size) -> Made:
    """Return a camera that looks at a target, with the image's aspect ratio."""
    eye, target, up = look(random)
    distance = rounded(random.uniform(0.6, 2.5))
    height = rounded(random.uniform(0.6, 2.0))
    camera = Camera.look_at(eye, target, up, distance=distance)
    half = height / 2 * size[0] / size[1]
    return replace(camera, viewport=(-half, half, -height / 2, height / 2)), target, up


def _off_axis(random: Random, size: Size) -> Made:
    """Return a camera with an asymmetric viewport of any aspect ratio."""
    camera, target, up = _turned(random, size)
    width, height = (rounded(value) for value in random.uniform(0.6, 2.0, 2))
    left, bottom = (rounded(-value) for value in random.uniform(0.2, 0.8, 2) * (width, height))
    return replace(camera, viewport=(left, left + width, bottom, bottom + height)), target, up


def _skewed(random: Random, size: Size) -> Made:
    """Return a camera whose basis vectors are neither of unit length nor at right angles."""
    camera, target, up = _off_axis(random, size)
    mixed = np.diag(random.uniform(0.6, 1.6, 3)) + random.uniform(-0.25, 0.25, (3, 3))
    u, v, w = (_vector(column) for column in (camera.basis @ mixed).T)
    return replace(camera, u=u, v=v, w=w), target, up


_KINDS: dict[str, Callable[[Random, Size], Made]] = {
    "canonical": _canonical,
    "moved": _moved,
    "turned": _turned,
    "off-axis": _off_axis,
    "skewed": _skewed,
}
