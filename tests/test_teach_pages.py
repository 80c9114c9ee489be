"""The laboratory's pages: how they divide their room, and what their pictures are."""

from __future__ import annotations

import numpy as np
import pytest

from app.options import LaboratoryOptions
from app.teach.imagelab.pages import LARGEST_APART, PAGES, Plan, panels, plan

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
    for panel in made:
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
