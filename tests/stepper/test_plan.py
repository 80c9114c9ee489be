"""The division of the stepper's room between code, canvases and numbers."""

from __future__ import annotations

import itertools

import pytest

from app.explaining.breaking import narrowed
from app.stepper.numbers import TEXTS
from app.stepper.panel import names_of
from app.stepper.plan import Need, Place, Size, canvases_in, plan, plan_of_two
from app.stepper.recording import Order
from app.stepper.source import source_of
from app.widgets.code import LINE, letters_in, row_count

# The room of the main view next to a lecture's column in a hall, and its type: in windows of
# 1920 x 1080, 1280 x 720 and 1024 x 768; alone at a desk; two side by side; upright.
ROOMS = [
    ((1160.0, 740.0), 36.0),
    ((760.0, 480.0), 24.0),
    ((530.0, 450.0), 26.0),
    ((1200.0, 560.0), 16.0),
    ((434.0, 495.0), 16.0),
    ((450.0, 900.0), 16.0),
]


def need(order: Order, em_px: float) -> Need:
    names = names_of(order)
    texts = sum(name in TEXTS for name in names)
    lines = narrowed(source_of(order.renderer).lines)
    return Need(lines, (16, 12), order.has_depth, em_px, 3 + len(names) - texts, texts)


def apart(one: Place, other: Place) -> bool:
    beside = one.left + one.width <= other.left or other.left + other.width <= one.left
    below = one.top + one.height <= other.top or other.top + other.height <= one.top
    return beside or below


@pytest.mark.parametrize(("room", "em_px"), ROOMS)
@pytest.mark.parametrize("order", Order)
def test_each_part_has_room_and_covers_no_other(order: Order, room: Size, em_px: float) -> None:
    asked = need(order, em_px)
    for made in (plan(room, asked), plan_of_two(room, asked)):
        parts = [made.code, made.canvases, made.numbers, *([made.depth] if made.depth else [])]
        for part in parts:
            assert min(part.left, part.top) >= 0
            assert part.left + part.width <= room[0] + 1
            assert part.top + part.height <= room[1] + 1
        assert all(apart(one, other) for one, other in itertools.combinations(parts, 2))
    made = plan(room, asked)
    assert made.code.height >= 4 * LINE * em_px  # the lit line, and what is around it
    label, gap = 1.3 * em_px, (0.4 * em_px, 0.3 * em_px)
    together = asked.has_depth and made.depth is None
    first, _, _ = canvases_in(made.canvases.size, (16, 12), together, label, gap)
    assert min(first[1], 0.75 * first[0]) >= 0.12 * room[1]
    assert made.numbers.height >= 2 * em_px


def test_where_there_is_room_all_of_the_code_is_shown() -> None:
    asked = need(Order.IMAGE, 16.0)
    code = plan((1200.0, 700.0), asked).code
    rows = row_count(asked.lines, letters_in(code.width, asked.em_px))
    assert code.height >= rows * LINE * asked.em_px
