"""Straight lines through a lens, and the hatching outside of it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.images.placement import Placement
from app.pair.hatching import hatching
from app.pair.straight_lines import grid
from renderer.camera import Camera
from renderer.lenses import Lens

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


@pytest.mark.parametrize(
    "lens",
    [
        Lens("brown", {"k1": -0.5}),
        Lens("brown", {"k1": -0.4, "p1": 0.05, "p2": -0.02}),
        Lens("fisheye", {"k1": -0.3}),
        Lens("fov", {"omega": 1.9}),
        Lens("thin_prism_fisheye", {"k1": -0.3, "p1": 0.05}),
        Lens("orthographic"),
    ],
    ids=lambda lens: "-".join((lens.model, *lens.coefficients)),
)
def test_hatched_is_what_no_ray_reaches(lens):
    placement = Placement(SIZE, (700, 500), 2.0, (30, 20), (640, 400))
    lines = hatching(lens, WIDE, 1.0, placement, 7.0)
    camera = Camera(viewport=WIDE, lens=lens)
    shown = np.zeros((400, 640), bool)
    for x1, y1, x2, y2 in lines:
        share = np.linspace(0, 1, 2 * max(2, math.ceil(abs(x2 - x1))))
        x, y = x1 + share * (x2 - x1) - 30, y1 + share * (y2 - y1) - 20
        shown[np.clip(y.astype(int), 0, 399), np.clip(x.astype(int), 0, 639)] = True
    outside = np.isnan(camera.lens_directions((640, 400))[..., 0])
    assert 0.05 < outside.mean() < 0.95
    rows, columns = np.nonzero(shown)
    assert outside[rows, columns].mean() > 0.97  # but at the border itself
    share = shown[outside].mean()
    assert share == pytest.approx(1 / 7, abs=0.05)


@pytest.mark.parametrize("lens", [Lens("brown", {"k1": 0.2}), Lens("stereographic")])
def test_a_lens_that_sees_everything_is_not_hatched(lens):
    assert hatching(lens, WIDE, 1.0, Placement(SIZE, SIZE, 1.0, (0, 0), SIZE), 7.0) == []


def test_a_wider_viewport_than_the_panorama_is_hatched_above_and_below():
    placement = Placement(SIZE, SIZE, 1.0, (0, 0), SIZE)
    lines = hatching(Lens("equirectangular"), PANORAMA.viewport, 1.0, placement, 7.0)
    edge = 100 * (1 - math.pi / 4)  # pi / 2 of 2
    assert lines
    assert all(
        max(y1, y2) <= edge + 1e-6 or min(y1, y2) >= 200 - edge - 1e-6 for _, y1, _, y2 in lines
    )
