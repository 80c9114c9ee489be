"""The place of images in their windows: fitting, magnifying at a point, panning, thinning."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from lucida.app.images import placement
from lucida.app.images.pair.rulers import numbered, thinning
from lucida.app.images.placement import (
    magnification_text,
    place,
    shown_pixel,
    stepped,
    zoomed_at,
)
from lucida.app.images.shown import section_of, whole
from lucida.app.state.options.shared import MAGNIFICATIONS, ImageOptions

SIZES = st.tuples(st.integers(1, 4096), st.integers(1, 4096))
PANES = st.tuples(st.integers(1, 2500), st.integers(1, 2500))
CENTERS = st.tuples(st.floats(0, 1), st.floats(0, 1))
FIXED = ImageOptions(resolution=(64, 36))


RULERS = st.tuples(st.integers(0, 80), st.integers(0, 40))


def placed(size, pane, rulers=(0, 0), **options):
    return place(ImageOptions(resolution=size, **options), size, pane, rulers)


@given(SIZES, PANES, RULERS)
def test_fitted_images_are_seen_whole_beside_their_rulers(size, pane, rulers):
    at = placed(size, pane, rulers)
    assume(at.magnification > placement.LEAST)
    assert at.visible_parts == (0, 0, 1, 1)
    assert at.visible_pixels == (0, 0, size[1], size[0])
    if at.magnification < placement.RULED_FROM:
        assert at.margin == (0, 0)
    elif min(rulers) > 0:
        assert at.margin in (rulers, (0, 0))
        assert (at.margin == rulers) == all(
            p >= placement.LEAST_RULED * r for p, r in zip(pane, rulers, strict=True)
        )


@pytest.mark.parametrize(("pane", "wanted"), [((120, 60), 1), ((80, 120), 0.8), ((120, 40), 0.8)])
def test_images_of_the_windows_size_are_shown_one_to_one_where_they_have_room(pane, wanted):
    assert place(ImageOptions(), (100, 50), pane).magnification == wanted


def test_rulers_stand_where_pixels_have_lines_between_them():
    """By hand: an image of 16 x 9 in 480 x 400, with rulers of 30 and 20."""
    at = placed((16, 9), (480, 400), (30, 20))
    assert at.magnification == 28, "450 / 16"
    assert at.margin == (30, 20)
    assert at.origin == (30 + (450 - 448) // 2, 20 + (380 - 252) // 2)
    without = placed((16, 9), (480, 400), (30, 20), grid=False)
    assert (without.extent, without.rulers) == ((480, 270), (0, 0))
    assert placed((64, 36), (520, 400), (30, 20)).magnification == 7, "8 leave no room for them"
    assert placed((64, 36), (520, 400), (30, 20)).margin == (0, 0)


def test_rulers_number_the_first_pixel_and_round_numbers():
    def texts(first, last, base, step):
        return [pixel + base for pixel in numbered(first, last, base, step)]

    assert texts(0, 5, 1, 1) == [1, 2, 3, 4, 5]
    assert texts(0, 7, 1, 2) == [1, 3, 5, 7]
    assert texts(0, 7, 0, 2) == [0, 2, 4, 6]
    assert texts(0, 17, 1, 5) == [1, 5, 10, 15]
    assert texts(0, 21, 0, 10) == [0, 10, 20]
    assert texts(3, 21, 1, 10) == [10, 20], "the first pixel is not seen"


@given(SIZES, PANES, RULERS, CENTERS, st.sampled_from(MAGNIFICATIONS))
def test_nothing_of_the_window_is_left_empty(size, pane, rulers, center, magnification):
    at = placed(size, pane, rulers, magnification=magnification, center=center)
    left, top, right, bottom = at.visible
    for k, (low, high) in enumerate(((left, right), (top, bottom))):
        assert high - low == min(at.extent[k], pane[k] - at.margin[k])
        assert at.margin[k] <= low, "an image does not reach under its ruler"
        assert high <= pane[k]
    first_row, first_column, last_row, last_column = at.visible_pixels
    assert 0 <= first_row < last_row <= size[1]
    assert 0 <= first_column < last_column <= size[0]
    assert at.whole


@given(SIZES, PANES, RULERS, CENTERS, st.sampled_from(MAGNIFICATIONS), st.data())
def test_a_pixel_is_found_where_it_is_drawn(size, pane, rulers, center, magnification, data):
    at = placed(size, pane, rulers, magnification=magnification, center=center)
    top, left, bottom, right = at.visible_pixels
    row = data.draw(st.integers(top, bottom - 1))
    column = data.draw(st.integers(left, right - 1))
    x, y = at.corner_of(row, column)
    inside = 0.5 if magnification == 1 else magnification / 2
    assert at.pixel_at(x + inside, y + inside) == (row, column)
    assert at.image_position(x + magnification / 2, y + magnification / 2) == pytest.approx(
        (row, column), abs=1e-6
    )


@given(SIZES, PANES, RULERS, CENTERS, st.sampled_from(MAGNIFICATIONS[:-1]), st.data())
def test_magnifying_keeps_what_is_under_the_pointer(size, pane, rulers, center, factor, data):
    at = placed(size, pane, rulers, magnification=factor, center=center)
    left, top, right, bottom = at.visible
    x, y = (
        data.draw(st.integers(left, right - 1)) + 0.5,
        data.draw(st.integers(top, bottom - 1)) + 0.5,
    )
    options = replace(ImageOptions(resolution=size), magnification=factor, center=center)
    closer = place(zoomed_at(options, at, at.part_at(x, y), x, y, 2.0 * factor), size, pane, rulers)
    assume(all(e > p for e, p in zip(at.extent, pane, strict=True)))
    # What a new ruler covers cannot stay where it was.
    assume(x >= closer.margin[0])
    assume(y >= closer.margin[1])
    assert closer.part_at(x, y) == pytest.approx(at.part_at(x, y), abs=2 / (factor * min(size)))


@pytest.mark.parametrize(
    ("magnification", "text"),
    [(1, "1:1"), (8, "8x"), (0.25, "1/4"), (1.5625, "1.56x"), (0.3, "0.3x"), (128, "128x")],
)
def test_a_magnification_is_told_in_words(magnification, text):
    assert magnification_text(magnification) == text


def test_sections_are_nearest_where_pixels_are_whole_and_means_elsewhere():
    at = placed((64, 36), (480, 400))
    assert not section_of(at, (64, 36)).averaged
    assert section_of(at, (64, 36)).texels_per_pixel == (1 / 7, 1 / 7)
    assert not section_of(at, (16, 9)).averaged, "a coarse image is made of larger squares"
    assert section_of(placed((640, 360), (1000, 800)), (640, 360)).averaged
    assert section_of(placed((4096, 2160), (512, 512)), (4096, 2160)).averaged
    assert not section_of(whole((640, 360)), (640, 360)).averaged
    cut = placed((640, 360), (400, 300), magnification=8.0, center=(0.5, 0.5))
    assert section_of(cut, (640, 360)).origin == cut.origin


@given(st.floats(1, 200), st.floats(1, 400))
def test_texts_are_thinned_out_until_they_have_room(cell, needed):
    step = thinning(cell, needed)
    assert step * cell >= needed
    assert step == 1 or step * cell < 2.6 * needed


def test_the_images_follow_the_largest_window_and_those_that_are_nearly_as_large():
    assert placement.common_pane([(320, 300), (640, 500), (320, 300)]) == (640, 500)
    assert placement.common_pane([(501, 400), (500, 402)]) == (500, 400)
    assert placement.common_pane([(480, 170), (480, 310)]) == (480, 310)
    assert placement.common_pane([(200, 400), (640, 300)]) == (640, 300)
    assert placement.common_pane([(400, 200), (300, 640)]) == (300, 640)


def test_what_is_seen_of_an_image_by_hand():
    at = placement.Placement((10, 20), (100, 100), 8.0, (-12, 10), (80, 160))
    assert at.visible == (0, 10, 68, 100)
    assert at.visible_parts == (12 / 80, 0, 1, 90 / 160)
    assert at.visible_pixels == (0, 1, 12, 10)
    assert at.unit == (8, 8)
    assert at.corner_of(3, 5) == (28, 34)
    assert at.image_position(28, 34) == (2.5, 4.5)
    assert at.pixel_at(-500, -500) == (0, 0)
    assert at.pixel_at(500, 500) == (19, 9)
    assert at.part_at(28, 34) == (0.5, 0.15)
    assert at.margin == (0, 0)
    assert at.visible_parts != (0, 0, 1, 1)
    assert not replace(at, extent=(81, 160)).whole


def test_every_pixel_can_be_brought_into_sight():
    """Along an axis on which it is in sight already, nothing moves; else it comes to the middle."""
    size, pane = (40, 30), (320, 240)
    options = ImageOptions(resolution=size, magnification=16.0, center=(0.3, 0.6))
    at = place(options, size, pane)
    top, left, bottom, right = at.visible_pixels
    for row in range(30):
        for column in range(40):
            seen = left <= column < right, top <= row < bottom
            changed = shown_pixel(options, at, (row, column))
            assert (changed is options) == all(seen)
            moved = place(changed, size, pane)
            for k, number in enumerate((column, row)):
                middle = pane[k] / 2 - (number + 0.5) * 16
                centered = min(max(middle, pane[k] - 16 * size[k]), 0)
                wanted = at.origin[k] if seen[k] else centered
                assert abs(moved.origin[k] - wanted) <= 1


def test_windows_are_nearly_as_large_from_85_percent_on_both_ways():
    large = (100, 200)
    assert placement.common_pane([large, (85, 170)]) == (85, 170)
    for other in ((84, 200), (100, 169), (84, 169)):
        assert placement.common_pane([large, other]) == large


def test_every_step_of_the_wheel():
    for k, magnification in enumerate(placement.STEPS[1:-1], start=1):
        fit = placement.LEAST / 2
        assert stepped(magnification, 1, fit) == placement.STEPS[k + 1]
        assert stepped(magnification, 0.3, fit) == placement.STEPS[k + 1]
        assert stepped(magnification, -1, fit) == placement.STEPS[k - 1]
    assert stepped(placement.LEAST, -1, fit) == placement.LEAST
    assert stepped(7.5, 1, 1) == 8
    assert stepped(7.5, -1, 1) == 6
    assert stepped(2, 1, 7) == stepped(2, 0.3, 7) == 3, "onwards from below the fit"
    assert stepped(7, -1, 7) is None
    assert stepped(4, -1, 2.5) == 3
    assert stepped(3, -1, 2) is None, "which is the fit"


def test_an_image_is_reduced_by_the_factors_by_which_it_is_magnified():
    reduced = [step for step in placement.STEPS if step < 1]
    assert len(reduced) > 5
    assert {1 / step for step in reduced} <= set(placement.STEPS)
    assert list(placement.STEPS) == sorted(set(placement.STEPS))


@pytest.mark.parametrize(
    ("center", "wanted"),
    [((1.0, 0.0), (0.75, 0.125)), ((0.0, 1.0), (0.25, 0.875)), ((0.6, 0.5), (0.6, 0.5))],
)
def test_the_middle_stays_half_a_window_away_from_the_images_border(center, wanted):
    """A window of 100 x 50 shows half the width and a quarter of the height of 200 x 200."""
    drawn = placement.Placement((100, 100), (100, 50), 2.0, (0, 0), (200, 200))
    assert placement.clamped(center, drawn, 2.0) == wanted
    assert placement.clamped(center, drawn, 0.25) == (0.5, 0.5)
