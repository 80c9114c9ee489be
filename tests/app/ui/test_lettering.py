"""Sizes of type: one for all that is drawn, which a hall reads."""

from __future__ import annotations

import itertools

import pytest
from imgui_bundle import imgui

from lucida.app.images.pair.pixelgrid import ADVANCE, DIGITS_HIGH, LEADING, text_size
from lucida.app.state.bounds import range_of
from lucida.app.state.options.shared import Preferences
from lucida.app.ui.explaining.breaking import broken, narrowed
from lucida.app.ui.theme import CAPITAL, LARGEST, TEXT_PX, look_of


@pytest.mark.parametrize("height_px", [600.0, 720.0, 748.0, 1060.0, 1080.0, 2160.0])
@pytest.mark.parametrize("dpi_scale", [1.0, 2.0])
def test_capitals_in_a_hall_are_a_fiftieth_of_the_window(height_px, dpi_scale):
    """And neither F9, nor larger type, ever makes type smaller."""
    least, most = range_of(Preferences, "font_scale")
    before = 0.0
    for step in range(10):
        wanted = Preferences(font_scale=least + step / 9 * (most - least))
        hall = Preferences(font_scale=wanted.font_scale, presentation=True)
        sizes = [
            look_of(preferences, height_px, dpi_scale, in_lecture).scale * TEXT_PX * dpi_scale
            for preferences, in_lecture in ((wanted, False), (wanted, True), (hall, True))
        ]
        assert sizes == sorted(sizes) and sizes[1] == sizes[2]
        assert CAPITAL * sizes[1] >= height_px / 50 - 0.01
        assert before <= sizes[1] <= max(LARGEST * height_px, TEXT_PX * dpi_scale) + 0.01
        before = sizes[1]


@pytest.mark.parametrize("letters", [12, 20, 33])
def test_broken_code_has_all_its_words_and_its_indent(letters):
    line = "        direction = u * camera.u + v * camera.v - camera.distance * camera.w"
    rows = broken(line, letters)
    assert all(len(row) <= letters for row in rows)
    assert "".join("".join(rows).split()) == "".join(line.split())
    assert broken("short", letters) == ("short",)
    assert narrowed(("a", "    b", "        c")) == ("a", "  b", "    c")


@pytest.mark.parametrize(("letters", "lines"), [(3, 3), (4, 3), (4, 1)])
def test_values_stay_in_their_pixel(letters, lines):
    """Bytes and floats of a colour, and a depth."""
    side = 50.0
    size_px = text_size(side, side, letters, lines)
    assert letters * ADVANCE * size_px < side
    assert ((lines - 1) * LEADING + DIGITS_HIGH) * size_px < 0.9 * side
    assert LEADING > DIGITS_HIGH  # lines do not touch


@pytest.mark.parametrize("presentation", [False, True])
@pytest.mark.parametrize("height_px", [1.0, 14.0, 16.0, 100.0, 1080.0])
def test_a_window_of_any_height_has_sizes_that_imgui_takes(height_px, presentation):
    """In presentation mode text is so many parts of the height; below 1 pixel ImGui gives up."""
    for font_scale, dpi_scale in itertools.product((0.75, 1.0, 3.0), (1.0, 2.0)):
        preferences = Preferences(presentation=presentation, font_scale=font_scale)
        look, style = look_of(preferences, height_px, dpi_scale), imgui.Style()
        style.scale_all_sizes(dpi_scale * look.scale)
        assert min(style.window_min_size) >= 1
