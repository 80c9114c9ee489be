"""How the panel's numbers are written."""

from __future__ import annotations

import pytest

from app.panels.fields import WIDTH, Scale, fitting_format, short_number
from app.teach.notation import number, results

SCALE = Scale(-1.0, 1.0)


@pytest.mark.parametrize("value", [0.0, 0.5, -0.5, 12.25, -12.25, 999.0, -999.5, 1e5, -1e-3])
def test_the_usual_width_is_always_the_same(value: float) -> None:
    text = fitting_format(value, SCALE, 20) % value
    assert len(text) == WIDTH + (value < 0 and abs(value) >= 1000)
    assert len(short_number(value)) == 7


@pytest.mark.parametrize("characters", range(3, WIDTH))
@pytest.mark.parametrize("value", [0.0, 0.125, -0.125, 12.5, -12.5])
def test_in_less_room_the_whole_number_is_still_seen(value: float, characters: int) -> None:
    text = fitting_format(value, SCALE, characters) % value
    assert len(text) == characters
    assert float(text) == pytest.approx(value, abs=0.5)


def test_a_number_without_room_is_told_in_powers_of_ten() -> None:
    assert fitting_format(123456.0, SCALE, 4) % 123456.0 == "1e+05"


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
