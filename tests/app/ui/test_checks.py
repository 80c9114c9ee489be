"""The edges of empty boxes can be seen in every look."""

import pytest

from lucida.app.ui import contrast, palettes


@pytest.mark.parametrize(
    "palette",
    [
        palettes.DARK,
        palettes.LIGHT,
        palettes.PRESENTED_DARK,
        palettes.PRESENTED_LIGHT,
    ],
)
def test_an_empty_box_stands_out_from_its_panel(palette):
    edge, *behind = (
        (color.x, color.y, color.z) for color in (palette.PLAIN, palette.PANEL, palette.POPUP)
    )
    assert all(contrast.contrast(edge, ground) >= 3 for ground in behind)
