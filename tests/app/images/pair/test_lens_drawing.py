"""Straight lines through a lens."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lucida.app.images.pair.straight_lines import grid
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens

SIZE = (320, 200)
WIDE = (-1.6, 1.6, -1.0, 1.0)
PANORAMA = Camera(viewport=(-math.pi, math.pi, -2, 2), lens=Lens("equirectangular"))


def test_a_pinhole_s_lines_are_straight():
    lines = grid(Camera(viewport=WIDE), SIZE)
    assert len(lines) > 20
    for points in lines:
        (down, right), far = (points[-1] - points[0]).tolist(), points - points[0]
        aside = (far[:, 0] * right - far[:, 1] * down) / math.hypot(down, right)
        assert abs(aside).max() < 1e-9 * SIZE[0]


@pytest.mark.parametrize("k1", [-0.2, 0.2])
def test_barrel_bows_lines_outwards_and_pincushion_inwards(k1):
    lines = grid(Camera(viewport=WIDE, distance=1.6, lens=Lens("brown", {"k1": k1})), SIZE)
    upright = [line for line in lines if np.ptp(line[:, 0]) > 150 and line[:, 1].min() > 200]
    assert upright
    for points in upright:
        middle = points[np.argmin(abs(points[:, 0] - 99.5)), 1]
        assert (middle > points[[0, -1], 1].max()) == (k1 < 0)


def test_a_panorama_s_lines_end_at_its_seam():
    lines = grid(PANORAMA, SIZE)
    longest = max(np.hypot(*np.diff(points, axis=0).T).max() for points in lines)
    assert longest < SIZE[0] / (2 * math.pi)
    columns = np.concatenate(lines)[:, 1]
    assert columns.min() < 1 and columns.max() > SIZE[0] - 2  # all around
