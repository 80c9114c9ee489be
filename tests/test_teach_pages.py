"""The laboratory's pages: how they divide their room, and what their pictures are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from imgui_bundle import ImVec2

from app.laboratory.pages import (
    LARGEST_APART,
    PAGES,
    Plan,
    display_part,
    panels,
    plan,
)
from app.laboratory.vector_view import PAGE_PX, PIXEL_PX, panes_in
from app.state.options import LaboratoryOptions
from renderer.images import to_srgb8

ROOMS = [(1200, 900), (600, 900), (400, 300), (1900, 500)]


def image(divided: Plan) -> np.ndarray:
    width, height = divided.image
    i, j = np.mgrid[0:height, 0:width]
    return np.stack([i / height, j / width, (i + j) % 2], axis=2).astype(np.float32)


@pytest.mark.parametrize("room", ROOMS)
@pytest.mark.parametrize("resolution", [None, (64, 48), (1000, 700), (3, 2)])
@pytest.mark.parametrize("page", PAGES)
def test_every_picture_fits_its_cell(page, room, resolution):
    divided = plan(page, room, 40, 10, resolution)
    assert divided.image == (resolution or divided.image)
    used = (
        divided.columns * divided.cell[0] + (divided.columns - 1) * 10,
        divided.rows * (divided.cell[1] + 40) + (divided.rows - 1) * 10,
    )
    assert used[0] <= room[0] and used[1] <= room[1]
    options = LaboratoryOptions(page=page, apart=LARGEST_APART, after_ev=1.0)
    made = panels(page, image(divided), divided, options, 0.0, (0, 0))
    assert 1 <= len(made) <= divided.columns * divided.rows
    test = replace(options, content="test")
    for panel in (*made, *panels(page, image(divided), divided, test, 0.0, (0, 0))):
        height, width = panel.picture.shape[:2]
        assert panel.picture.dtype == np.uint8 and panel.title and panel.caption
        assert 0 < width <= divided.cell[0] and 0 < height <= divided.cell[1], (page, panel.title)


def test_pages_say_what_they_show():
    divided = plan("subpixels", (1200, 600), 40, 10, (40, 30))
    options = LaboratoryOptions(page="subpixels", side_px=60)
    whole, stripes = panels("subpixels", image(divided), divided, options, 0.0, (29, 39))
    first, left, rows, columns = whole.region
    assert (first + rows, left + columns) == (30, 40)  # about the corner, moved inside
    assert stripes.picture.shape == (rows * 60, columns * 60, 3)
    divided = plan("bitmaps", (900, 900), 40, 10, None)
    assert divided.magnification == 2
    made = panels("bitmaps", image(divided), divided, LaboratoryOptions(), 0.0, (0, 0))
    assert [panel.title for panel in made[:2]] == ["Grayscale", "Threshold"]
    assert set(np.unique(made[1].picture)) == {0, 255}
    share = float((made[3].picture[..., 0] == 255).mean())
    assert made[3].caption == f"{100 * share:.1f} % white"


def test_a_display_is_seen_at_a_moment_beside_its_mean():
    divided = plan("displays", (1200, 600), 40, 10, (40, 30))
    options = LaboratoryOptions(page="displays", display="dlp", side_px=60, phase=0.5)
    color = image(divided)
    now, mean = panels("displays", color, divided, options, 1.0, (3, 5))
    part, first, side, place = display_part(color, divided, options, 1.0, (3, 5))
    assert (first[0] + place[0], first[1] + place[1]) == (3, 5)
    rows, columns = part.shape[:2]
    seen = to_srgb8(color[first[0] : first[0] + rows, first[1] : first[1] + columns], 1.0)
    np.testing.assert_array_equal(mean.picture[::side, ::side], seen)
    assert now.region == mean.region == (3, 5, 1, 1)
    assert now.picture.shape == mean.picture.shape
    middles = now.picture[side // 2 :: side, side // 2 :: side]
    np.testing.assert_array_equal(middles[..., 1] == 255, part[..., 1] > 0.5)  # half of its third
    assert middles[..., 0].max() < 50 and middles[..., 2].max() < 50


def test_a_test_picture_has_every_mixture_of_light():
    divided = plan("subpixels", (1200, 600), 40, 10, (40, 30))
    options = LaboratoryOptions(page="subpixels", content="test")
    bars, stripes = panels("subpixels", image(divided), divided, options, 5.0, (0, 0))
    side = bars.picture.shape[1] // 8
    shown = [tuple(bars.picture[0, column * side]) for column in range(8)]
    assert shown[1:4] == [(255, 255, 0), (0, 255, 255), (0, 255, 0)]  # yellow, cyan, green
    assert shown[4] == (255, 0, 255) and shown[0] == (255, 255, 255)
    yellow = stripes.picture[0, side : 2 * side]
    assert yellow.max(axis=0).tolist() == [255, 255, 0]
    divided = plan("projectors", (900, 700), 40, 10, None)
    options = LaboratoryOptions(page="projectors", content="test", apart=0.22)
    (wall,) = panels("projectors", image(divided), divided, options, 3.0, (0, 0))
    seen, count = np.unique(wall.picture.reshape(-1, 3), axis=0, return_counts=True)
    mixtures = {tuple(color) for color in seen.tolist()}
    assert mixtures == {(r, g, b) for r in (0, 255) for g in (0, 255) for b in (0, 255)}
    assert count.min() > 0.01 * count.sum()  # each is to be seen


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
