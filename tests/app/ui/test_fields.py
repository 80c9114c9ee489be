"""The notation of the panel's numbers."""

from __future__ import annotations

import pytest

from lucida.app.ui.explaining.notation import number, results
from lucida.app.ui.fields import shown_number


@pytest.mark.parametrize(
    ("value", "characters", "shown"),
    [
        (0.0, 8, "0.0000"),
        (-0.0, 8, "0.0000"),
        (0.5, 8, "0.5000"),
        (-0.5, 7, "-0.5000"),
        (1 / 3, 8, "0.3333"),
        (-0.15625, 8, "-0.15625"),  # a fraction of pixels is complete
        (0.00625, 8, "0.00625"),
        (-12.1875, 8, "-12.1875"),
        (-12.1875, 6, "-12.19"),
        (-12.5, 7, "-12.5"),
        (0.125, 3, "0.1"),
        (1234.5678, 8, "1234.57"),
        (-5.4e6, 8, "-5.4e+06"),
        (-5.4e6, 7, "-5.4e6"),
        (123456.0, 4, "1e5"),
        (1e-5, 8, "0.0000"),
        (1e7, 8, "1e+07"),
        (float("inf"), 8, "inf"),
        (float("nan"), 8, "none"),
    ],
)
def test_a_number_has_as_many_digits_as_fit(value: float, characters: int, shown: str) -> None:
    text = shown_number(value, characters)
    assert text == shown.rjust(characters)


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
    assert results([value]) == shown
    assert results([value, 1 / 3]).startswith(f"({value:.4f},")  # nothing jumps in a vector


def test_a_number_of_parts_has_no_decimals() -> None:
    for value, room, shown in ((96.0, 20, "96"), (1000.0, 6, "1000"), (48.0, 2, "48")):
        assert shown_number(value, room, 0).strip() == shown
    assert shown_number(2.5, 20, 0).strip() == "2.5"


def test_a_small_scene_s_numbers_keep_their_digits() -> None:
    assert shown_number(0.000757835, 8).strip() == "0.0008"
    assert shown_number(0.000757835, 8, is_fine=True) == "7.578e-4"
    assert shown_number(-0.00025, 8, is_fine=True) == "-0.00025"
