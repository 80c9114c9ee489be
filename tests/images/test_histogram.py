"""The histogram of an image as it is shown, and the colours of its channels."""

from __future__ import annotations

import numpy as np
import pytest

from app.images import histogram as module
from app.images.histogram import histogram
from app.state.options import ImageOptions
from app.widgets import contrast, theme
from renderer.images.display import to_srgb8


def test_each_channel_is_counted_as_it_is_shown():
    color = np.random.default_rng(1).random((40, 60, 3)).astype(np.float32) ** 2
    found = histogram(color, ImageOptions(exposure_ev=0.5))
    shown = to_srgb8(color, 0.5)
    assert found.every == 1
    for k in range(3):
        assert found.counts[k].sum() == 40 * 60
        assert (found.counts[k] == np.bincount(shown[..., k].ravel(), minlength=256)).all()
    linear = histogram(color, ImageOptions(transfer="linear"))
    assert (linear.counts != found.counts).any()


def test_a_plain_background_does_not_make_all_else_too_low_to_see():
    color = np.zeros((100, 100, 3), np.float32)
    color[:10] = np.linspace(0, 1, 100)[None, :, None]
    found = histogram(color, ImageOptions())
    assert found.counts.max() >= 9000
    assert found.top < 100
    everywhere = histogram(np.zeros((4, 4, 3), np.float32), ImageOptions())
    assert everywhere.top >= 16, "one value everywhere is a bar of its full height"


def test_of_a_large_image_every_nth_row_and_column_is_counted(monkeypatch):
    monkeypatch.setattr(module, "MOST_PIXELS", 100)
    found = histogram(np.zeros((30, 30, 3), np.float32), ImageOptions())
    assert found.every == 3
    assert found.counts.sum() == 3 * 100
    for shape in ((90, 10, 3), (10, 90, 3)):
        assert histogram(np.zeros(shape, np.float32), ImageOptions()).every == 3


def test_where_there_are_few_bars_the_highest_has_the_height():
    one = np.zeros((1, 1, 3), np.float32)
    assert histogram(one, ImageOptions()).top == pytest.approx(1.3)
    four = np.zeros((2, 2, 3), np.float32)
    four[0, 0, 1:] = four[0, 1, 1] = 1.0  # bars of 4; 2 and 2; 3 and 1
    assert histogram(four, ImageOptions()).top == pytest.approx(4 * 1.3)


@pytest.mark.parametrize(
    "palette",
    [theme.DARK, theme.LIGHT, theme.PRESENTED_DARK, theme.PRESENTED_LIGHT, theme.CONTRAST],
)
def test_red_green_and_blue_are_legible_in_every_look(palette):
    behind = (palette.PANEL.x, palette.PANEL.y, palette.PANEL.z)
    for color in theme.CHANNELS:
        shown = contrast.legible_on((color.x, color.y, color.z), behind)
        assert contrast.contrast(shown, behind) >= 4.5
        assert max(shown) - min(shown) > 0.25, "it is still a colour"
