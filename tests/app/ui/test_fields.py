"""The notation of the panel's numbers."""

from __future__ import annotations

import pytest

from lucida.app.ui.explaining.notation import number, results
from lucida.app.ui.fields import WIDTH, Scale, fitting_format

SCALE = Scale(-1.0, 1.0)


@pytest.mark.parametrize("value", [0.0, 0.5, -0.5, 12.25, -12.25, 999.0, -999.5, 1e5, -1e-3])
def test_the_usual_width_is_always_the_same(value: float) -> None:
    form = fitting_format(value, SCALE, 20)
    text = form % value if "%" in form else form
    assert len(text) == WIDTH + (value < 0 and abs(value) >= 1000)


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (-0.15625, "-0.15625"),
        (0.00625, "0.00625"),
        (2.1875, "2.1875"),
        (-12.1875, "-12.1875"),
        (0.5, "0.500"),
        (0.1234567, "0.123"),  # as it comes of a drag
        (1 / 3, "0.333"),
        (-100.15625, "-100.156"),  # no room for more
    ],
)
def test_a_fraction_of_pixels_is_shown_whole(value: float, shown: str) -> None:
    form = fitting_format(value, Scale(-2.0, 2.0), 20)
    assert (form % value).strip() == shown
    assert len(form % value) == WIDTH


def test_a_fraction_of_pixels_may_fill_its_field() -> None:
    scale = Scale(-2.0, 2.0)
    assert fitting_format(-0.15625, scale, 7, 8) % -0.15625 == "-0.15625"
    assert fitting_format(0.15625, scale, 7, 8) % 0.15625 == "0.15625"
    assert fitting_format(-0.15625, scale, 7, 7) % -0.15625 == " -0.156"
    assert fitting_format(0.1234567, scale, 7, 8) % 0.1234567 == "  0.123"


@pytest.mark.parametrize("characters", range(3, WIDTH))
@pytest.mark.parametrize("value", [0.0, 0.125, -0.125, 12.5, -12.5])
def test_in_less_room_the_whole_number_is_still_seen(value: float, characters: int) -> None:
    text = fitting_format(value, SCALE, characters) % value
    assert len(text) == characters
    assert float(text) == pytest.approx(value, abs=0.5)


def test_a_number_without_room_is_told_in_powers_of_ten() -> None:
    assert fitting_format(123456.0, SCALE, 4).strip() == "1e5"
    assert fitting_format(123456.0, SCALE, 2) == "1e5", "not even for that"


@pytest.mark.parametrize(
    ("value", "characters", "shown"),
    [
        (5.4e6, 8, " 5400000"),
        (-5.4e6, 8, "-5400000"),
        (-5.4e6, 20, "-5400000"),
        (-5.4e6, 7, "-5.40e6"),
        (-5.4e6, 6, "-5.4e6"),
        (1234.5678, 8, "1234.568"),
        (1234.5678, 6, "1234.6"),
        (-1234.5678, 8, "-1234.57"),
        (1.5e12, 8, "1.500e12"),
        (999999.96, 8, "1000000"),
    ],
)
def test_large_numbers_show_the_digits_that_a_hand_calculation_needs(value, characters, shown):
    text = fitting_format(value, SCALE, characters)
    assert text.strip() == shown.strip()
    assert len(text) <= max(characters, 3)
    assert float(text) == pytest.approx(value, rel=10.0 ** (3 - characters))


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.001234567, "0.001235"), (1e-5, "1.000e-5"), (0.00999, "0.009990")],
)
def test_small_numbers_on_a_logarithmic_scale(value, shown):
    assert fitting_format(value, Scale(0.1, 10.0, logarithmic=True), 12) == shown


@pytest.mark.parametrize("value", [float("inf"), float("-inf"), float("nan")])
def test_what_is_no_number_is_survived(value):
    assert fitting_format(value, SCALE, 8)


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (-0.15625, "-0.15625"),  # of 16 pixels
        (1 / 64, "0.015625"),
        (0.0125, "0.0125"),
        (1 / 3, "0.3333"),
        (0.123456789, "0.1235"),
        (0.5, "0.5"),
    ],
)
def test_a_pixels_fractions_are_written_whole(value: float, shown: str) -> None:
    assert number(value) == shown
    assert results([value])[1] == shown
    assert results([value, 1 / 3])[1].startswith(f"({value:.4f}, ")  # nothing jumps in a vector


def test_a_number_of_parts_has_no_decimals() -> None:
    parts = Scale(3, 256, logarithmic=True, whole=True)
    for value, room, shown in ((96.0, 20, "96"), (1000.0, 6, "1000"), (48.0, 2, "48")):
        assert (fitting_format(value, parts, room) % value).strip() == shown
    assert (fitting_format(2.5, parts, 20) % 2.5).strip() == "2.500"
