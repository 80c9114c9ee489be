"""The extent of projections on the image plane: by hand, and against points that are projected."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from app.explaining.projected import (
    EVERYTHING,
    NOTHING,
    Extent,
    pixels_of,
    sphere_extent,
    whole_within,
)
from renderer.camera import Camera

CAMERA = Camera()  # looks along -z from the origin; the image plane is z = -1
PARALLEL = replace(CAMERA, projection="parallel")
SKEWED = Camera(
    eye=(0.3, -0.2, 1.0), u=(1, 0.2, 0), v=(-0.3, 2, 0.1), w=(0.4, -0.1, 0.8), distance=1.7
)


def on_plane(camera: Camera, points: np.ndarray) -> np.ndarray:
    """(n, 2), in units of u and v."""
    x, y, z = np.linalg.inv(camera.basis) @ (points - np.asarray(camera.eye)).T
    scale = np.ones(len(z)) if camera.is_parallel else -camera.distance / z
    return np.stack([x * scale, y * scale], axis=1)


@pytest.mark.parametrize("camera", [CAMERA, SKEWED, replace(SKEWED, projection="parallel")])
def test_a_spheres_extent_is_that_of_the_points_on_it(camera):
    center, radius = np.array([0.5, -1.2, -4.0]), 0.75
    turn, height = np.meshgrid(np.linspace(0, 2 * np.pi, 200), np.linspace(-1, 1, 401))
    flat = np.sqrt(1 - height**2)
    points = np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=-1).reshape(-1, 3)
    seen = on_plane(camera, center + radius * points)
    (left, bottom), (right, top) = seen.min(axis=0), seen.max(axis=0)
    found = sphere_extent(center, radius, camera)
    assert found == pytest.approx((left, right, bottom, top), abs=2e-4 * (right - left))


@pytest.mark.parametrize("camera", [CAMERA, PARALLEL])
def test_a_sphere_around_beside_and_behind_the_eye(camera):
    def extent(z: float, radius: float, at: Camera = camera) -> Extent:
        return sphere_extent(np.array([9.0, 0, z]), radius, at)

    reaching = EVERYTHING if camera is CAMERA else (8, 10, -1, 1)
    assert extent(1.1, 1.0) == extent(1.0, 1.0) == NOTHING
    assert extent(0.9, 1.0) == extent(-1.0, 1.0) == reaching
    assert extent(-1.1, 1.0).right < math.inf
    clipped = replace(camera, near=2.0, far=5.0)
    assert extent(-1.0, 1.0, clipped) == extent(-6.0, 1.0, clipped) == NOTHING
    for z in (-1.1, -5.9):
        assert extent(z, 1.0, clipped) == extent(z, 1.0)
    deep = replace(camera, near=2.0, far=5.0, distance=10.0)
    assert extent(-1.0, 1.0, deep) == extent(-6.0, 1.0, deep) == NOTHING
    assert extent(-1.1, 1.0, deep) != NOTHING != extent(-5.9, 1.0, deep)


def test_whole_numbers_within():
    assert whole_within(1.0, 3.0, 9) == range(1, 4)
    assert whole_within(1 + 9e-7, 3 - 9e-7, 9) == range(1, 4), "but for rounding"
    assert whole_within(1 + 1.1e-6, 3 - 1.1e-6, 9) == range(2, 3)
    assert whole_within(-math.inf, math.inf, 5) == whole_within(-0.1, 4.1, 5) == range(5)
    assert whole_within(0.5, 3.5, 5) == range(1, 4)
    for low, high in ((3.2, 3.8), (-9.0, -0.5), (4.5, 9.0), (math.inf, -math.inf)):
        assert len(whole_within(low, high, 5)) == 0


def test_pixels_whose_centres_lie_within():
    """8 x 4 pixels of an image plane from 1 to 5 and from -1 to 1, half a unit a side."""
    camera = replace(CAMERA, viewport=(1.0, 5.0, -1.0, 1.0))

    def pixels(*sides: float) -> tuple[range, range]:
        return pixels_of(Extent(*sides), camera, (8, 4))

    assert pixels(1.25, 2.75, -0.25, 0.75) == (range(3), range(4))
    assert pixels(1.75, 1.75, 0.25, 0.25) == (range(1, 2), range(1, 2)), "a centre on the edge"
    assert pixels(1.3, 4.7, -0.7, 0.2) == (range(2, 3), range(1, 7))
    assert pixels(*EVERYTHING) == (range(4), range(8))
    nothing = range(0), range(0)
    assert pixels(1.3, 1.7, -1, 1) == pixels(1, 5, 0.3, 0.7) == pixels(*NOTHING) == nothing
