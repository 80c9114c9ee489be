"""The edges of empty boxes can be seen in every look; high contrast is high."""

import pytest
from imgui_bundle import ImVec4

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
def test_an_empty_box_stands_out_from_its_panel(palette):
    edge, *behind = (
        (color.x, color.y, color.z) for color in (palette.PLAIN, palette.PANEL, palette.POPUP)
    )
    assert all(contrast.contrast(edge, ground) >= 3 for ground in behind)


def test_text_of_the_high_contrast_theme_has_7_to_1_with_every_ground():
    palette = palettes.CONTRAST
    grounds = palette.PANEL, palette.FRAME, palette.FRAME_HOVERED, palette.FRAME_ACTIVE
    assert all(ratio(palette.TEXT, ground) >= 7 for ground in (*grounds, palette.FILL))
    others = palette.DIM, palette.ERROR, palette.GOOD, palette.MARK, *palette.BASIS.values()
    assert all(ratio(color, palette.PANEL) >= 7 for color in others)


def ratio(one: ImVec4, other: ImVec4) -> float:
    return contrast.contrast((one.x, one.y, one.z), (other.x, other.y, other.z))
