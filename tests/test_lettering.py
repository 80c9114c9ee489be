"""Sizes of type in a lecture hall: what the stepper and the probe make of the room they have."""

from __future__ import annotations

import pytest

from app.panels.code import LINE
from app.panels.pixelgrid import ADVANCE, DIGITS_HIGH, LEADING, VALUES_FROM, text_size
from app.panels.probe import HIGH_EM, WIDE_EM, type_px
from app.panels.stepper import LEFT, UPPER, beside_px
from app.teach.recording import Order
from app.teach.source import source_of

HALL_PX = 1080.0  # the height of a projector's picture
HALL_ROOM = (1160.0, 740.0)  # of the main view beside a lecture's column there
HALL_EM = 26.0


@pytest.mark.parametrize("order", Order)
def test_the_steppers_code_is_legible_and_whole(order):
    size_px = beside_px(HALL_ROOM, HALL_EM)
    assert size_px >= 0.02 * HALL_PX
    lines = source_of(order.renderer).lines
    assert len(lines) * LINE * size_px <= UPPER * HALL_ROOM[1]
    letter_px = 0.5 * size_px
    assert max(map(len, lines)) * letter_px <= LEFT * HALL_ROOM[0]


def test_the_probes_type_leaves_the_table_in_sight():
    room = (1150.0, 760.0)
    size_px = type_px(room, HALL_EM, 34.0)
    assert 0.02 * HALL_PX < size_px <= room[0] / WIDE_EM  # names stand beside the formulas
    assert HIGH_EM * size_px <= 1.05 * room[1]
    assert type_px((2000.0, 2000.0), 16.0, 40.0) == 40.0  # where there is room for all
    assert type_px((600.0, 900.0), 16.0, 18.0) == 18.0  # a narrow column
    assert type_px((2000.0, 100.0), 16.0, 40.0) == 16.0  # never below the window's own


@pytest.mark.parametrize(("letters", "lines"), [(3, 3), (4, 3), (4, 1)])
def test_values_are_legible_from_the_magnification_at_which_they_appear(letters, lines):
    """Bytes and floats of a colour, and a depth."""
    size_px = text_size(VALUES_FROM, VALUES_FROM, letters, lines)
    assert size_px >= 12
    assert letters * ADVANCE * size_px < VALUES_FROM
    assert ((lines - 1) * LEADING + DIGITS_HIGH) * size_px < 0.9 * VALUES_FROM
    assert LEADING > DIGITS_HIGH  # lines do not touch
