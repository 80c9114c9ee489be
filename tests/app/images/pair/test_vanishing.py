"""Parallel lines over an image, and the square of one pixel."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.images.pair.footprint import square
from lucida.app.images.pair.vanishing import ends, vanishing_point
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.samples import offsets

SIZE = (64, 48)
POINTS = [(-2.0, 0.0, 1.0), (2.5, 3.0, 0.0), (0.1, -1.0, 9.0)]
CAMERA = Camera.look_at((0.7, 1.9, 8.0), (0.1, 1.5, -4.0), fov_y_deg=42.0, aspect=4 / 3)


@pytest.mark.parametrize("along", [(0, 0, -1), (0, 0, 1), (1, 0, -1), (0.1, 0.2, 3.0)])
def test_lines_end_in_their_vanishing_point(along):
    meets = vanishing_point(CAMERA, along)
    assert meets is not None
    row, column, _ = CAMERA.project(meets, SIZE)
    segments = ends(CAMERA, POINTS, along)
    rows, columns, parameters = CAMERA.project(segments, SIZE)
    assert (parameters > 0).all()  # in front of the eye
    assert np.allclose(rows[:, 1], row, atol=0.1)
    assert np.allclose(columns[:, 1], column, atol=0.1)
    lines = segments[:, 1] - segments[:, 0]
    assert np.allclose(np.cross(lines, along) / np.linalg.norm(lines, axis=1)[:, None], 0)


def test_lines_along_the_image_plane_and_parallel_views_have_no_vanishing_point():
    assert vanishing_point(CAMERA, CAMERA.u) is None
    parallel = Camera(eye=(0, 0, 4), projection="parallel")
    assert vanishing_point(parallel, (0.3, 0.1, -1)) is None
    first, last = ends(parallel, [(0, 0, 0)], (1, 0, 0))[0]
    assert last[0] > 1000 and np.allclose(first, (-last[0], 0, 0))


@pytest.mark.parametrize("pixel", [(0, 0), (17, 40), (47, 63)])
def test_the_samples_of_a_pixel_are_the_pixels_of_its_square(pixel):
    rays = square(CAMERA, SIZE, pixel).rays((4, 4)).direction.reshape(-1, 3)
    samples = [CAMERA.shifted(*at, SIZE).ray(*pixel, SIZE).direction for at in offsets(16)]
    assert np.allclose(rays, samples)
