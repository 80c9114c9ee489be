"""Sizes of type in a lecture hall: what the stepper and the probe make of the room they have."""

from __future__ import annotations

import itertools

import pytest
from imgui_bundle import imgui

from app.lecture.slide import sizes_of
from app.pair.pixelgrid import ADVANCE, DIGITS_HIGH, LEADING, VALUES_FROM, text_size
from app.probe.panel import HIGH_EM, WIDE_EM, type_px
from app.state.options import Preferences
from app.stepper.numbers import TEXTS
from app.stepper.panel import LEAST_PX, WANTED_EM, names_of
from app.stepper.plan import SHORT, Need, StepperPlan, canvases_in, plan, plan_of_two
from app.stepper.recording import Order
from app.stepper.source import source_of
from app.stepper.view import LEGIBLE
from app.widgets.code import LINE, narrowed
from app.widgets.sliders import part_of
from app.widgets.theme import PRESENTED, look_of

HALL_PX = 1080.0  # the height of a projector's picture
HALL_ROOM = (1160.0, 740.0)  # of the main view beside a lecture's column there
HALL_EM = 26.0
LEGIBLE_PX = LEGIBLE * HALL_PX
# The main view beside a lecture's column in windows of a height, with the type round the code, at
# 100 and at 200 %; and the least part of its height that the canvas has.
ROOMS = [
    ((779.0, 514.0), 700.0, 15.0, 1.0, 0.4),
    ((771.0, 490.0), 700.0, 15.0, 2.0, 0.19),
    ((616.0, 450.0), 620.0, 14.0, 1.0, 0.24),
    ((606.0, 420.0), 620.0, 13.0, 2.0, 0.2),
    ((1160.0, 800.0), 1060.0, 22.0, 1.0, 0.28),
    ((1150.0, 780.0), 1060.0, 22.0, 2.0, 0.2),
]


@pytest.mark.parametrize(("room", "height", "em_px", "scale", "canvas"), ROOMS)
@pytest.mark.parametrize("order", Order)
def test_code_and_numbers_beside_a_lecture_are_read_from_afar(
    order: Order,
    room: tuple[float, float],
    height: float,
    em_px: float,
    scale: float,
    canvas: float,
) -> None:
    """12 of a slide's 540 points, but for less than what a font's sizes differ by; whole, and with
    a canvas that shows something."""
    lines = narrowed(source_of(order.renderer).lines)
    names = names_of(order)
    wanted_px = WANTED_EM * PRESENTED * height * scale
    short = 3 + sum(name not in TEXTS for name in names)
    need = Need(
        max(map(len, lines)), len(lines), (16, 12), order.has_depth, em_px, wanted_px,
        LEGIBLE * height, LEAST_PX, max(SHORT, short), 5,
    )  # fmt: skip
    made = plan(room, need)
    assert min(made.code_px, made.numbers_px) >= 0.965 * height / 45
    assert made.code_px >= made.numbers_px  # the code is read first
    assert len(lines) * LINE * made.code_px <= made.code.height + 0.01
    assert need.longest * 0.5 * made.code_px <= made.code.width
    together = order.has_depth and made.depth is None
    first, _, _ = canvases_in(
        made.canvases.size, (16, 12), together, 1.3 * em_px, (0.4 * em_px, 0.3 * em_px)
    )
    assert min(first[1], 0.75 * first[0]) >= canvas * room[1]
    assert_apart(made, room)


@pytest.mark.parametrize("room", [(774, 490), (600, 400), (1170, 790), (450, 600), (400, 430)])
@pytest.mark.parametrize("has_depth", [False, True])
@pytest.mark.parametrize("lines", [17, 26])
def test_nothing_in_the_stepper_covers_anything_else(room, has_depth, lines):
    for wanted_px in (20.0, 30.0, 40.0):
        need = Need(50, lines, (16, 12), has_depth, 15.0, wanted_px, 16.0, LEAST_PX)
        assert_apart(plan(room, need), room)


@pytest.mark.parametrize("room", [(774, 490), (600, 400), (450, 600), (1170, 500)])
def test_nor_with_the_same_code_in_julia(room):
    for set_px in (15.0, 26.0):
        need = Need(50, 18, (16, 12), True, 15.0, WANTED_EM * set_px, 16.0, LEAST_PX, 13, 4)
        made = plan_of_two(room, need, set_px)
        assert_apart(made, room)
        assert made.code_px >= LEAST_PX and need.longest * 0.5 * made.code_px <= made.code.width


def assert_apart(made: StepperPlan, room: tuple[float, float]) -> None:
    places = [made.code, made.canvases, made.numbers, *([made.depth] if made.depth else [])]
    for place in places:
        assert place.left >= 0 and place.left + place.width <= room[0] + 1
        assert place.top >= 0 and place.top + place.height <= room[1] + 1
    for one, two in itertools.combinations(places, 2):
        beside = one.left + one.width <= two.left or two.left + two.width <= one.left
        below = one.top + one.height <= two.top or two.top + two.height <= one.top
        assert beside or below


@pytest.mark.parametrize("room", [(774, 490), (600, 400), (1170, 790)])
@pytest.mark.parametrize("has_depth", [False, True])
def test_code_grows_with_the_type_before_what_stands_round_it(room, has_depth):
    height = 1.4 * room[1]  # of the window round it
    em_px, legible_px = max(15.0, PRESENTED * height), LEGIBLE * height
    sizes = [
        plan(
            room,
            Need(
                50, 17, (16, 12), has_depth, 15.0, WANTED_EM * scale * em_px, legible_px, LEAST_PX
            ),
        ).code_px
        for scale in (1.0, 1.3, 1.6, 2.0)
    ]
    assert sizes == sorted(sizes)
    assert sizes[-1] >= (1.0 if has_depth else 1.05) * sizes[0]  # two canvases leave little


@pytest.mark.parametrize("window", [(1024, 640), (1280, 720), (1920, 1080)])
def test_a_lectures_type_is_that_of_a_slide(window):
    """In points of a slide that is 540 high; the font's letters are 0.85 of its lines."""
    column, height = 0.36 * window[0] - 36, float(window[1])
    points = 0.85 * 540 / height
    usual = sizes_of(column, height, 1.0, 1.0)
    assert usual.text[1] * points >= 21
    assert usual.label * points >= 12
    assert usual.exercise * points >= 14
    assert 2 * column / usual.text[1] >= 18  # letters a line
    larger = sizes_of(column, height, 1.5, 1.0)
    assert larger.as_asked(larger.exercise) > usual.as_asked(usual.exercise) == usual.exercise
    assert larger.enlarged == 1.5
    assert (larger.label, larger.title) == (usual.label, usual.title)  # what is read grows


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


def test_a_slider_shows_where_its_value_stands():
    assert part_of(5, 0, 10, False) == 0.5
    assert part_of(10, 1, 100, True) == pytest.approx(0.5)
    assert part_of(-3, 0, 10, False) == 0.0 and part_of(99, 0, 10, False) == 1.0
    assert part_of(1, 1, 1, False) == 0.0


@pytest.mark.parametrize("presentation", [False, True])
@pytest.mark.parametrize("height_px", [1.0, 14.0, 16.0, 100.0, 1080.0])
def test_a_window_of_any_height_has_sizes_that_imgui_takes(height_px, presentation):
    """In presentation mode text is so many parts of the height; below 1 pixel ImGui gives up."""
    for font_scale, dpi_scale in itertools.product((0.75, 1.0, 3.0), (1.0, 2.0)):
        preferences = Preferences(presentation=presentation, font_scale=font_scale)
        look, style = look_of(preferences, height_px, dpi_scale), imgui.Style()
        style.scale_all_sizes(dpi_scale * look.scale)
        assert min(style.window_min_size) >= 1
