"""Cameras of all kinds, made up from a seed, and all pixels of small images of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lucida.app.checking.tasks import CheckCase
from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

KINDS = ("orthonormal", "off-axis", "skewed", "left-handed")


def made_camera(random: np.random.Generator, kind: str, projection: str = "perspective") -> Camera:
    """A camera of one of KINDS whose numbers are all different, and none of them 0 or 1."""
    while True:
        eye, target = random.uniform(-5, 5, 3), random.uniform(-2, 2, 3)
        up = random.normal(size=3)
        if np.linalg.norm(np.cross(eye - target, up)) > 0.5 * np.linalg.norm(up):
            break
    distance = random.uniform(0.5, 0.9) if random.random() < 0.5 else random.uniform(1.2, 2.5)
    camera = Camera.look_at(eye, target, up, distance=distance, projection=projection)
    half, high = random.uniform(0.3, 0.9, 2)
    viewport = (-half, half, -high, high)
    if kind != "orthonormal":
        (left, low), (right, top) = random.uniform(0.15, 0.4, 2), random.uniform(0.5, 0.9, 2)
        viewport = (-left, right, -low, top)
    camera = replace(camera, viewport=viewport)
    mixed = np.eye(3)
    if kind == "left-handed":
        mixed = np.diag([-1.0, 1.0, 1.0])
    elif kind == "skewed":
        mixed = np.diag(random.uniform(0.6, 1.6, 3)) + random.uniform(-0.3, 0.3, (3, 3))
    u, v, w = (tuple(column) for column in (camera.basis @ mixed).T.tolist())
    return replace(camera, u=u, v=v, w=w)


def made_cases(
    seed: int, count: int, projection: str = "perspective", kinds: Sequence[str] = KINDS
) -> list[CheckCase]:
    """All pixels of `count` images, wider than high or higher than wide."""
    random = np.random.default_rng(seed)
    cases = []
    for number in range(count):
        camera = made_camera(random, kinds[number % len(kinds)], projection)
        width, height = random.choice(np.arange(3, 8), 2, replace=False).tolist()
        cases += whole_image(camera, (width, height))
    return cases


def whole_image(camera: Camera, size: Size) -> list[CheckCase]:
    """All pixels of an image."""
    return [made_case(camera, size, pixel) for pixel in np.ndindex(size[::-1])]


def made_case(camera: Camera, size: Size, pixel: Pixel) -> CheckCase:
    """The case of a pixel. Its tolerance is what float32 needs."""
    right = np.array(camera.ray(*pixel, size))
    back, up = np.asarray(camera.w), np.asarray(camera.v)
    target, tilted = np.asarray(camera.eye) - 2.5 * back, 1.5 * up + 0.4 * back
    vectors = (tuple(target.tolist()), tuple(tilted.tolist()))
    return CheckCase((), right, (1e-5, 1e-5), {}, camera, size, pixel, *vectors)
