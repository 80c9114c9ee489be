"""The image plane as pixels agrees with K."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside.diagram import Dot, Label
from lucida.app.instruments.outside.pixel_plane import pixel_items
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.intrinsics import PixelOrigin

SIZE = (8, 6)
CAMERA = Camera.look_at((3.2, 1.6, 3.8), (0.0, 0.0, 0.0), fov_y_deg=35.0, aspect=4 / 3)


@pytest.mark.parametrize("origin", ["center", "corner"])
def test_ticks_are_at_the_whole_coordinates_of_k(origin: PixelOrigin) -> None:
    items = pixel_items(CAMERA, SIZE, origin)
    K, R, t = CAMERA.intrinsics(SIZE, origin)
    for axis, name in enumerate("ji"):
        ticks = [item.point for item in items if isinstance(item, Dot) and item.name == name]
        pixels = (np.array(ticks) @ R.T + t) @ K.T
        wanted = np.outer(np.arange(SIZE[axis] + (origin == "corner")), np.eye(2)[axis])
        assert np.allclose(pixels[:, :2] / pixels[:, 2:], wanted)
    texts = {item.name: item.text for item in items if isinstance(item, Label)}
    assert texts["focal length"] == f"f = {K[0, 0]:.4g}"
    assert texts["principal point"] == f"c = ({K[0, 2]:.4g}, {K[1, 2]:.4g})"
