"""The camera's frustum in the world, and the outside camera that frames it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from looked_at import LOOKING, SIZE, cameras, vectors

from lucida.app.instruments.outside.extent import (
    end_parameter,
    framed,
    looked_from,
    outside_camera,
)
from lucida.app.instruments.outside.frustum import (
    MOST_GRID_LINES,
    border,
    bundle_pixels,
    grid,
    grid_step,
    pixel_corners,
    pixel_seen,
    plane_corners,
    plane_parameter,
    point_at,
)
from lucida.renderer.camera.camera import Camera


class TestFrustum:
    @given(cameras(), st.floats(0.2, 20))
    def test_its_corners_are_those_of_the_image(self, camera: Camera, t: float) -> None:
        x, y = border(camera, 1).T
        row, column, parameter = camera.project(point_at(camera, x, y, np.full(4, t)), SIZE)
        assert np.allclose(row, [-0.5, -0.5, 47.5, 47.5], atol=1e-5)
        assert np.allclose(column, [-0.5, 63.5, 63.5, -0.5], atol=1e-5)
        assert np.allclose(parameter, t, rtol=1e-7)

    @given(cameras(), st.integers(0, 47), st.integers(0, 63), st.floats(0, 10))
    def test_points_lie_on_rays(self, camera: Camera, i: int, j: int, t: float) -> None:
        ray = camera.ray(i, j, SIZE)
        x, y = camera.image_point(i, j, SIZE)
        assert np.allclose(point_at(camera, x, y, t), ray.origin + t * ray.direction)
        middle = pixel_corners(camera, (i, j), SIZE).mean(axis=0)
        assert np.allclose(middle, ray.origin + plane_parameter(camera) * ray.direction)

    @given(cameras(), st.integers(0, 47), st.integers(0, 63), vectors)
    def test_a_pixel_is_found_from_anywhere(
        self, camera: Camera, i: int, j: int, origin: tuple[float, float, float]
    ) -> None:
        target = pixel_corners(camera, (i, j), SIZE).mean(axis=0)
        toward = target - np.asarray(origin)
        corners = plane_corners(camera)
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        steep = abs(normal @ toward) / (np.linalg.norm(normal) * max(np.linalg.norm(toward), 1e-9))
        assume(steep > 0.05)
        assert pixel_seen(camera, SIZE, np.asarray(origin), toward) == (i, j)
        assert pixel_seen(camera, SIZE, np.asarray(origin), -toward) is None

    def test_no_pixel_beside_the_plane_nor_along_it(self) -> None:
        camera = Camera.canonical()
        away = np.array([0.0, 0.0, -1.0])
        assert pixel_seen(camera, SIZE, np.array([0.51, 0.0, 0.0]), away) is None
        assert pixel_seen(camera, SIZE, np.array([0.0, 0.0, -1.0]), np.array([1.0, 0, 0])) is None

    @pytest.mark.parametrize(
        ("size", "step"),
        [((4, 3), 1), ((32, 32), 1), ((33, 20), 2), ((640, 480), 20), ((4096, 2160), 200)],
    )
    def test_the_grid_is_thinned_to_round_steps(self, size: tuple[int, int], step: int) -> None:
        assert grid_step(size) == step
        lines = grid(Camera.canonical(), size)
        columns, rows = math.ceil(size[0] / step) - 1, math.ceil(size[1] / step) - 1
        assert len(lines) == columns + rows
        assert max(columns, rows) <= MOST_GRID_LINES
        _, at, _ = Camera.canonical().project(lines[0], size)
        assert np.allclose(at, step - 0.5)  # the left edge of the column `step`

    def test_a_bundle_covers_the_image_evenly(self) -> None:
        assert bundle_pixels((100, 60), (2, 4)).tolist() == [
            [15, 12], [15, 37], [15, 62], [15, 87], [45, 12], [45, 37], [45, 62], [45, 87],
        ]  # fmt: skip
        assert len(bundle_pixels((3, 2), (16, 16))) == 6  # no pixel twice
        assert len(bundle_pixels((3, 2), (0, 5))) == 0


class TestOutsideCamera:
    @given(
        st.lists(vectors, min_size=1, max_size=20),
        cameras(),
        st.floats(0.3, 3),
        st.sampled_from([1e-6, 1.0, 1e6]),
    )
    def test_it_sees_all_points(
        self, points: list[Any], home: Camera, aspect: float, scale: float
    ) -> None:
        world = np.array(points) * scale
        camera = outside_camera(world, home, aspect)
        row, column, parameter = camera.project(world, (1000, 1000))
        assert (parameter > 0).all()
        assert (np.abs(row - 499.5) <= 500.5).all()
        assert (np.abs(column - 499.5) <= 500.5).all()

    @pytest.mark.parametrize(
        ("back", "level"), [((0.6, 0.5, 0.8), (0.6, 0.8)), ((0.01, 1.0, 0.0), (1.0, 0.0))]
    )
    def test_it_is_to_the_right_above_and_behind(
        self, back: tuple[float, ...], level: tuple[float, float]
    ) -> None:
        """Above a camera that looks straight down, behind is along x."""
        x, z = level
        toward = np.array([1.25 * x + 0.75 * z, 0.5, 1.25 * z - 0.75 * x])
        found = looked_from(np.array([0.0, 1.0, 0.0]), np.array(back))
        assert np.allclose(found, toward / np.linalg.norm(toward))

    def test_it_is_as_near_as_possible(self) -> None:
        points = np.array([[x, y, z] for x in (-1, 1) for y in (-2, 2) for z in (-3, 3)], float)
        for toward in ((1.0, 0, 0), (0, 1.0, 0), (0, 0, -1.0), (0.6, 0, 0.8)):
            camera = framed(points, np.array(toward), 1.5)
            assert np.allclose(camera.w, toward)
            row, column, _ = camera.project(points, (1000, 1000))
            extent = max(np.ptp(row), np.ptp(column))
            assert 850 < extent < 1000
            above = (0, 0, -1) if abs(toward[1]) == 1 else (0, 1, 0)  # y is straight on
            assert np.dot(camera.v, above) == pytest.approx(1)

    def test_it_is_finite_without_finite_points(self) -> None:
        camera = outside_camera(np.full((2, 3), np.nan), LOOKING, 1.0)
        assert np.isfinite(camera.basis).all()

    def test_the_scene_ends_behind_its_last_point(self) -> None:
        points = np.array([[0, 0, -3.0], [1, 1, -8.0], [0, 0, 5.0]])
        assert 8.0 < end_parameter(Camera.canonical(), points) < 8.5
        parallel = replace(Camera.canonical(), projection="parallel", w=(0, 0, 2.0))
        assert 4.0 < end_parameter(parallel, points) < 4.3
        assert end_parameter(Camera.canonical(), np.zeros((0, 3))) > 1
        assert end_parameter(Camera.canonical(), -points[:2]) > 1
