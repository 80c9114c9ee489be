"""The laboratory's pages: how they divide their room, and what their pictures are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from imgui_bundle import ImVec2

from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import (
    PAGES,
    PageInput,
    PagePlan,
    display_part,
    panels,
    plan,
)
from app.laboratory.vector_view import PAGE_PX, PIXEL_PX, panes_in
from app.state.bounds import range_of
from renderer.images import to_srgb8

ROOMS = [(1200, 900), (600, 900), (400, 300), (1900, 500)]


def image(divided: PagePlan) -> np.ndarray:
    width, height = divided.image
    i, j = np.mgrid[0:height, 0:width]
    return np.stack([i / height, j / width, (i + j) % 2], axis=2).astype(np.float32)


@pytest.mark.parametrize("room", ROOMS)
@pytest.mark.parametrize("resolution", [None, (64, 48), (1000, 700), (3, 2)])
@pytest.mark.parametrize("page", PAGES)
def test_every_picture_fits_its_cell(page, room, resolution):
    _, apart = range_of(LaboratoryOptions, "apart")
    divided = plan(page, room, 40, 10, resolution, apart)
    assert divided.image == (resolution or divided.image)
    used = (
        divided.columns * divided.cell[0] + (divided.columns - 1) * 10,
        divided.rows * (divided.cell[1] + 40) + (divided.rows - 1) * 10,
    )
    assert used[0] <= room[0] and used[1] <= room[1]
    options = LaboratoryOptions(page=page, apart=apart, after_ev=1.0)
    made = panels(page, image(divided), divided, options, 0.0, (0, 0))
    assert 1 <= len(made) <= divided.columns * divided.rows
    test = replace(options, content="test")
    for panel in (*made, *panels(page, image(divided), divided, test, 0.0, (0, 0))):
        height, width = panel.picture.shape[:2]
        assert panel.picture.dtype == np.uint8 and panel.title and panel.caption
        assert 0 < width <= divided.cell[0] and 0 < height <= divided.cell[1], (page, panel.title)


@pytest.mark.parametrize(
    ("page", "room", "columns", "rows", "cell"),
    [
        # 10 between cells, a heading of 40 in each; a room is wide above 1.15 times its height.
        ("kinds", (1151, 1000), 3, 2, (377, 455)),
        ("kinds", (1150, 1000), 2, 3, (570, 286)),
        ("bitmaps", (1151, 1000), 2, 2, (570, 455)),
        ("projectors", (1150, 1000), 1, 1, (1150, 960)),
        ("array", (1151, 1000), 2, 2, (570, 455)),
        ("array", (1150, 1000), 1, 4, (1150, 202)),
        ("exposure", (1151, 1000), 2, 1, (570, 960)),
        ("exposure", (1150, 1000), 1, 2, (1150, 455)),
        ("exposure", (9, 9), 1, 2, (9, 8)),  # there is no room at all
        ("exposure", (20, 9), 2, 1, (8, 8)),
    ],
)
def test_how_a_page_is_divided(page, room, columns, rows, cell):
    divided = plan(page, room, 40, 10, None)
    assert (divided.columns, divided.rows, divided.cell) == (columns, rows, cell)


def test_the_size_that_an_image_should_have():
    def size(page, room, resolution=None, apart=0.4):
        divided = plan(page, room, 40, 10, resolution, apart)
        return divided.image, divided.magnification

    assert size("kinds", (1151, 1000)) == ((377, 455), 1)
    # A bitmap's pixels are made larger, where there is room: for cells of more than 200.
    assert size("bitmaps", (412, 1000)) == ((100, 227), 2)
    assert size("bitmaps", (410, 1000)) == ((200, 455), 1)
    assert size("bitmaps", (1000, 412)) == ((495, 161), 1)
    # Projectors 0.4 of the height apart: 0.4 more above, 0.2 below, 0.4 sqrt(3) / 2 on each side.
    assert size("projectors", (1150, 1000)) == ((1150 - 417, 600), 1)
    assert size("projectors", (300, 1000)) == ((8, 600), 1)
    assert size("projectors", (1150, 1000), apart=0.0) == ((1150, 960), 1)
    # As large as both of its sides have room for.
    assert size("kinds", (1151, 1000), (64, 48)) == ((64, 48), 5)
    assert size("kinds", (1151, 1000), (48, 64)) == ((48, 64), 7)
    assert size("kinds", (1151, 1000), (10, 91)) == ((10, 91), 5)
    assert size("kinds", (1151, 1000), (1000, 700)) == ((1000, 700), 1)
    assert size("projectors", (1150, 1000), (64, 48)) == ((64, 48), 11)


def test_pages_say_it_in_numbers():
    color = np.zeros((3, 5, 3), np.float32)
    color[:, 0], color[0, 1], color[2, 4] = 2.0, 0.5, 0.25  # the first column is above white
    divided = PagePlan(2, 2, (48, 30), (5, 3), 7)

    def told(page, **options):
        made = panels(page, color, divided, LaboratoryOptions(page=page, **options), 0.0, (2, 4))
        return [(panel.title, panel.caption) for panel in made]

    assert told("kinds") == [
        ("Bitmap", "1 bit per pixel, 3 bytes"),
        ("Grayscale", "8 bits per pixel, 15 bytes"),
        ("Colour", "24 bits per pixel, 45 bytes"),
        ("Half float", "48 bits per pixel, 90 bytes"),
        ("Single float", "96 bits per pixel, 180 bytes"),
    ]
    assert told("bitmaps")[:2] == [
        ("Grayscale", "8 bits per pixel"),
        ("Threshold", "33.3 % white"),
    ]
    assert told("exposure") == [
        ("Colour, 24 bits", "4 of 256 levels; 20.0 % of the pixels are clipped"),
        ("Single float, 96 bits", "without steps; nothing is clipped; seen in 4 levels"),
    ]
    assert "seen in 3 levels" in told("exposure", after_ev=1.0)[1][1]  # 0.5 is white too
    (aligned,), (moved,) = told("projectors"), told("projectors", apart=0.4)
    assert aligned[1].startswith("aligned; ") and moved[1].startswith("apart; ")
    assert told("array") == [("canvas", "3 rows of 5 pixels, 180 bytes")]
    assert told("displays")[0] == (
        "Tube: this moment",
        "three beams, line by line; dots fade; framed: the beams",
    )


def test_a_picture_is_made_as_large_as_its_cell_and_shows_the_middle():
    color = np.arange(35, dtype=np.float32).reshape(5, 7, 1).repeat(3, axis=2) / 64
    options = LaboratoryOptions()
    (whole,) = panels("array", color, PagePlan(1, 1, (9, 6), (7, 5), 2), options, 1.0, (0, 0))
    assert (whole.first, whole.magnification) == ((1, 1), 2)  # 3 of 5 rows, 4 of 7 columns
    seen = to_srgb8(color[1:4, 1:5], 1.0)
    np.testing.assert_array_equal(whole.picture, seen.repeat(2, axis=0).repeat(2, axis=1))


def test_projectors_stand_as_far_apart_as_is_said_in_parts_of_the_height():
    color = np.ones((20, 30, 3), np.float32)
    divided = plan("projectors", (900, 700), 40, 10, (30, 20), 0.25)
    options = LaboratoryOptions(page="projectors", apart=0.25)  # 5 pixels
    (wall,) = panels("projectors", color, divided, options, 0.0, (0, 0))
    side = divided.magnification
    # Green and blue go down by half of it and apart by cos 30 degrees of it, to each side.
    assert wall.picture.shape == ((20 + 5 + 2) * side, (30 + 4 + 4) * side, 3)
    (test,) = panels("projectors", color, divided, replace(options, content="test"), -3.0, (0, 0))
    assert test.picture.max() == 255  # which is as bright, whatever the exposure is


@pytest.mark.parametrize("display", ["tube", "lcd"])
def test_what_is_at_work_is_framed_in_the_part_that_is_seen(display):
    """The pixel (20, 25) in the middle of 9 x 9; half of the cycle is over."""
    divided = plan("displays", (1200, 600), 40, 10, (40, 30))
    options = LaboratoryOptions(page="displays", display=display, side_px=60, phase=0.5)
    now, mean = panels("displays", image(divided), divided, options, 0.0, (20, 25))
    assert now.first == mean.first == (16, 21) and now.picture.shape[:2] == (540, 540)
    assert now.region == mean.region == (20, 25, 1, 1)
    assert now.at_work == {"tube": (20, 25, 1, 1), "lcd": (20, 21, 1, 9)}[display]
    assert mean.at_work is None


def test_a_display_is_seen_at_a_moment_beside_its_mean():
    divided = plan("displays", (1200, 600), 40, 10, (40, 30))
    options = LaboratoryOptions(page="displays", display="dlp", side_px=60, phase=0.5)
    color = image(divided)
    now, mean = panels("displays", color, divided, options, 1.0, (3, 5))
    part, first, side, place = display_part(PageInput(color, divided, options, 1.0, (3, 5)))
    assert (first[0] + place[0], first[1] + place[1]) == (3, 5)
    rows, columns = part.shape[:2]
    seen = to_srgb8(color[first[0] : first[0] + rows, first[1] : first[1] + columns], 1.0)
    np.testing.assert_array_equal(mean.picture[::side, ::side], seen)
    assert now.region == mean.region == (3, 5, 1, 1)
    assert now.picture.shape == mean.picture.shape
    middles = now.picture[side // 2 :: side, side // 2 :: side]
    np.testing.assert_array_equal(middles[..., 1] == 255, part[..., 1] > 0.5)  # half of its third
    assert middles[..., 0].max() < 50 and middles[..., 2].max() < 50


@pytest.mark.parametrize("room", [(780, 470), (1180, 740), (760, 330), (400, 800), (1900, 900)])
def test_the_vector_page_fills_its_room(room: tuple[int, int]) -> None:
    """Both panes are in it, apart, in the drawing's proportions, and leave no third empty."""
    (one, other), page = panes_in(ImVec2(7.0, 9.0), ImVec2(*room), 15.0)
    for pane in (one, other):
        assert pane.low.x >= 7 and pane.high.x <= 7 + room[0] + 1
        assert pane.low.y >= 9 and pane.high.y <= 9 + room[1] + 1
        width, height = pane.high.x - pane.low.x, pane.high.y - pane.low.y
        assert abs(height / width - page[1] / page[0]) < 0.01
    assert other.low.x >= one.high.x or other.low.y >= one.high.y
    used = 2 * (one.high.x - one.low.x) * (one.high.y - one.low.y)
    assert used >= 0.66 * room[0] * room[1]
    assert page[1] % PIXEL_PX == 0 and page[0] == PAGE_PX
