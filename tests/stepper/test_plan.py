"""The division of the stepper's room between code, canvases and numbers."""

from __future__ import annotations

import itertools

import pytest

from app.stepper.plan import Place, Size, canvases_in, plan

# The room of the main view next to a lecture's column in a hall, and its type: in windows of
# 1920 x 1080, 1280 x 720 and 1024 x 768; alone at a desk; two side by side; upright; low.
ROOMS = [
    ((1160.0, 740.0), 36.0),
    ((760.0, 480.0), 24.0),
    ((530.0, 450.0), 26.0),
    ((1200.0, 560.0), 16.0),
    ((434.0, 495.0), 16.0),
    ((450.0, 900.0), 16.0),
    ((760.0, 235.0), 24.0),
]


def apart(one: Place, other: Place) -> bool:
    beside = one.left + one.width <= other.left or other.left + other.width <= one.left
    below = one.top + one.height <= other.top or other.top + other.height <= one.top
    return beside or below


@pytest.mark.parametrize(("room", "em_px"), ROOMS)
@pytest.mark.parametrize("code_em", [4.0, 25.0])
def test_each_part_has_room_and_covers_no_other(code_em: float, room: Size, em_px: float) -> None:
    made = plan(room, code_em * em_px, em_px)
    parts = made.code, made.canvases, made.numbers
    for part in parts:
        assert min(part.left, part.top) >= 0
        assert part.left + part.width <= room[0] + 1
        assert part.top + part.height <= room[1] + 1
    assert all(apart(one, other) for one, other in itertools.combinations(parts, 2))
    assert made.code.height >= 4 * em_px
    assert made.numbers.height >= 2 * em_px
    assert 1 <= made.columns <= 3
    place = made.canvases.width, made.canvases.height
    each, _ = canvases_in(place, (16, 12), True, 1.3 * em_px, (0.4 * em_px, 0.3 * em_px))
    assert min(each[1], 0.75 * each[0]) >= 0.12 * room[1]
