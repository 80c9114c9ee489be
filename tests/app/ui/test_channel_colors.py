"""The colours of an image's channels."""

from __future__ import annotations

import pytest

from lucida.app.ui import contrast, palettes


@pytest.mark.parametrize(
    "palette",
    [
        palettes.DARK,
        palettes.LIGHT,
        palettes.PRESENTED_DARK,
        palettes.PRESENTED_LIGHT,
        palettes.CONTRAST,
    ],
)
def test_red_green_and_blue_are_legible_in_every_look(palette):
    behind = (palette.PANEL.x, palette.PANEL.y, palette.PANEL.z)
    for color in palettes.CHANNELS:
        shown = contrast.legible_on((color.x, color.y, color.z), behind)
        assert contrast.contrast(shown, behind) >= 4.5
        assert max(shown) - min(shown) > 0.25, "it is still a colour"
