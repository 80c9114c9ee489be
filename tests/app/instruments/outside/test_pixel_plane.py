"""Dragging the image plane changes K, or K and t, as the lecture says; and the drawing agrees."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside.diagram import Dot, Label
from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.instruments.outside.pixel_plane import Part, dragged, pixel_items
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.intrinsics import PixelOrigin

SIZE = (8, 6)
CAMERA = Camera.look_at((3.2, 1.6, 3.8), (0.0, 0.0, 0.0), fov_y_deg=35.0, aspect=4 / 3)
START, NOW = np.array([0.3, 0.2]), np.array([0.36, 0.13])


@pytest.mark.parametrize("part", ["grid", "corner", "point"])
def test_a_drag_changes_what_it_should(part: Part) -> None:
    start = np.array(CAMERA.viewport)[[1, 3]] if part == "corner" else START
    camera = dragged(CAMERA, part, start, start + NOW - START)
    before, after = CAMERA.intrinsics(SIZE), camera.intrinsics(SIZE)
    left, right, bottom, top = CAMERA.viewport
    pixel = np.array([(right - left) / SIZE[0], -(top - bottom) / SIZE[1]])
    assert np.allclose(after.R, before.R)
    assert np.allclose(after.t, before.t) == (part != "point")
    moved = after.K[:2, 2] - before.K[:2, 2]
    if part == "corner":
        assert np.allclose(moved, 0)
        larger = np.linalg.norm(start + NOW - START) / np.linalg.norm(start)
        assert np.allclose(after.K[[0, 1], [0, 1]] * larger, before.K[[0, 1], [0, 1]])
    else:
        assert np.allclose(after.K[:2, :2], before.K[:2, :2])
        assert np.allclose(moved, (NOW - START) / pixel * (1 if part == "point" else -1))
    if part == "point":  # the plane stays in the world
        assert np.allclose(plane_corners(camera), plane_corners(CAMERA))


@pytest.mark.parametrize("origin", ["center", "corner"])
def test_whole_numbers_are_drawn_where_k_has_them(origin: PixelOrigin) -> None:
    items = pixel_items(CAMERA, SIZE, origin)
    K, R, t = CAMERA.intrinsics(SIZE, origin)
    ticks = np.array([item.point for item in items if isinstance(item, Dot) and item.name == "j"])
    seen = (ticks @ R.T + t) @ K.T
    columns = np.arange(SIZE[0] + (origin == "corner"))
    assert np.allclose(seen[:, 0] / seen[:, 2], columns)
    assert np.allclose(seen[:, 1] / seen[:, 2], 0)
    texts = {item.name: item.text for item in items if isinstance(item, Label)}
    assert texts["focal length"] == f"f = {K[0, 0]:.4g}"
    assert texts["principal point"] == f"c = ({K[0, 2]:.4g}, {K[1, 2]:.4g})"
