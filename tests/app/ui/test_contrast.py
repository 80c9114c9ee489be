"""Text has a contrast of 4.5:1 with its ground in every theme, and marks have 3:1 (WCAG 2.1)."""

import itertools

import pytest

from lucida.app.images.pair import overlay
from lucida.app.instruments.outside.paint import DARKER, FIXED, RIM, figure_color, label_color
from lucida.app.ui import palettes, theme
from lucida.app.ui.contrast import contrast

LOOKS = [
    theme.WindowLook(name, presented)
    for name, presented in itertools.product(("dark", "light"), (False, True))
]
GROUNDS = ("BACKGROUND", "PANEL", "POPUP", "FRAME")
ROLES = ("u", "v", "w", "ray", *(FIXED | DARKER))


@pytest.fixture(params=LOOKS, ids=str)
def look(request, monkeypatch):
    monkeypatch.setattr(theme, "_used", [request.param])  # the public way to a look is a window's
    return request.param


def rgb(color):
    return (color.x, color.y, color.z) if hasattr(color, "x") else tuple(color)[:3]


def over(color, behind):
    """Return a colour that lets a gray shine through."""
    return tuple(color.w * part + (1 - color.w) * behind for part in rgb(color))


def lines():
    return (theme.RAY, theme.MARK, theme.PLAIN, *theme.BASIS.values())


def test_text_is_legible_on_every_ground_of_the_theme(look):
    for ground in (*GROUNDS, "FRAME_HOVERED"):
        for ink in (theme.TEXT, theme.DIM, theme.ERROR, theme.GOOD):
            assert contrast(rgb(ink), rgb(getattr(theme, ground))) >= 4.5, ground
    for ground in (theme.FRAME_ACTIVE, theme.FILL, theme.LIT):
        assert contrast(rgb(theme.TEXT), rgb(ground)) >= 4.5
    for color in (*lines(), *palettes.CHANNELS, theme.ERROR, theme.GOOD):
        shown = rgb(theme.legible(color))
        assert all(contrast(shown, rgb(getattr(theme, one))) >= 4.5 for one in (*GROUNDS, "LIT"))
    for color in palettes.CHANNELS:
        assert max(shown := rgb(theme.legible(color))) - min(shown) > 0.24, "it is still a colour"


def test_marks_and_edges_are_seen_on_panels(look):
    for color in lines():
        assert contrast(rgb(theme.seen(color)), rgb(theme.PANEL)) >= 3
    for edge, ground in itertools.product((theme.PLAIN, theme.ACCENT), (theme.PANEL, theme.POPUP)):
        assert contrast(rgb(edge), rgb(ground)) >= 3


@pytest.mark.parametrize("behind", [0.0, 0.5, 1.0])
def test_text_over_images_is_legible_whatever_they_show(look, behind):
    rim = over(theme.rgb("#07080a", 0.85), behind)
    for role in ROLES:
        assert contrast(rgb(label_color(role)), rim) >= 4.5, role
        for ground in ((1.0, 1.0, 1.0), (0.1, 0.11, 0.13)):
            assert contrast(figure_color(role, 0.0, ground), ground) >= 4.5, role
    for ink in (overlay.TEXT, overlay.DIM, overlay.ERROR):
        assert contrast(rgb(ink), over(overlay.BOX, behind)) >= 4.5
    assert max(rim) <= RIM[0]
    assert contrast(rgb(theme.RAY), over(theme.rgb("#000000", 0.85), behind)) >= 4.5
