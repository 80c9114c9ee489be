"""Displays over time: the mean of a cycle is the pixel's linear colour."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.laboratory.displays import DISPLAYS, FADING

MOMENTS = 3000
TUBE, DLP, LCD, LED = DISPLAYS


@pytest.fixture
def color() -> np.ndarray:
    """Return 5 x 7 pixels, including black and white."""
    part = np.random.default_rng(3).uniform(0, 1, (5, 7, 3)).astype(np.float32)
    part[0, 0], part[4, 6], part[2, 3] = 0, 1, (1, 0, 0.5)
    return part


def cycle(kind, color: np.ndarray, moments: int = MOMENTS) -> np.ndarray:
    phases = (np.arange(moments) + 0.5) / moments
    return np.array([kind.light(color, float(phase)) for phase in phases])


@pytest.mark.parametrize("kind", DISPLAYS, ids=lambda kind: kind.title)
def test_the_mean_of_a_cycle_is_the_color_relative_to_white(kind, color):
    light, white = cycle(kind, color), cycle(kind, np.ones_like(color))
    share = light.mean(axis=0) / white.mean(axis=0)
    np.testing.assert_allclose(share, color, atol=4 / MOMENTS / white.mean())
    assert light.min() >= 0 and light.max() <= 1
    assert not light[:, 0, 0].any()  # black stays dark


def test_a_tube_is_scanned_line_by_line_and_fades():
    white = np.ones((4, 6, 3), np.float32)
    for number in range(24):
        light = TUBE.light(white, number / 24)[..., 0]
        assert light[number // 6, number % 6] == pytest.approx(1) and (light > 0.999).sum() == 1
        # The longer ago the beam has passed a pixel, the dimmer it is.
        order = np.roll(light.ravel(), -number)  # from the current pixel on
        assert (np.diff(order[1:]) > 0).all()
    later = TUBE.light(white, 0.25)[0, 0] / TUBE.light(white, 0.15)[0, 0]
    np.testing.assert_allclose(later, np.exp(-0.1 / FADING), rtol=1e-5)
