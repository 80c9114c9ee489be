"""How code, canvases and numbers share the stepper's room."""

from __future__ import annotations

import pytest

from app.stepper.plan import Need, Size, canvases_in, plan
from app.widgets.code import LINE


def need(em_px: float, wanted_px: float, legible_px: float) -> Need:
    """Of rasterization."""
    return Need(54, 18, (16, 12), True, em_px, wanted_px, legible_px, 11.0, 13, 5)


BY_RAYS = Need(45, 16, (16, 12), False, 15.0, 21.0, 15.9, 11.0)  # alone, on a slide


@pytest.mark.parametrize(
    ("room", "asked", "least"),
    [  # two beside one another in windows 720, 900 and 1080 pixels high
        ((434, 495), need(16.0, 20.0, 12.0), 0.19),
        ((560, 700), need(16.0, 20.0, 15.0), 0.23),
        ((667, 909), need(16.0, 20.0, 18.0), 0.23),
        ((779, 516), BY_RAYS, 0.45),
    ],
)
def test_the_canvas_has_what_legible_code_does_not_take(
    room: Size, asked: Need, least: float
) -> None:
    made = plan(room, asked)
    assert min(made.code_px, made.numbers_px) > 0.96 * asked.legible_px
    assert made.code.height >= asked.lines * LINE * made.code_px  # all of it
    together, em_px = asked.has_depth and made.depth is None, asked.em_px
    label, gap = 1.3 * em_px, (0.4 * em_px, 0.3 * em_px)
    first, _, _ = canvases_in(made.canvases.size, (16, 12), together, label, gap)
    assert min(first[1], 0.75 * first[0]) > least * room[1]


def test_what_larger_type_leaves_is_the_code_s_first() -> None:
    before, after = need(16.0, 20.0, 12.0), need(13.0, 40.0, 12.6)
    assert plan((427, 444), after).code_px > plan((434, 495), before).code_px


def test_parts_do_not_cover_one_another() -> None:
    for room in ((434, 495), (667, 909), (779, 516)):
        made = plan(room, need(16.0, 20.0, 14.0))
        parts = [made.code, made.canvases, made.numbers, *([made.depth] if made.depth else [])]
        for n, one in enumerate(parts):
            assert min(one.left, one.top) >= 0
            assert one.left + one.width <= room[0] + 1
            assert one.top + one.height <= room[1] + 1
            for other in parts[:n]:
                apart = (
                    one.left >= other.left + other.width
                    or other.left >= one.left + one.width
                    or one.top >= other.top + other.height
                    or other.top >= one.top + one.height
                )
                assert apart, (room, one, other)
