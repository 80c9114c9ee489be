"""The recorded costs, and the titles of their lines."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from lucida.app.instruments.costs.plots import apart
from lucida.app.instruments.costs.recorded import COSTS


@pytest.mark.parametrize("unit", COSTS)
def test_the_recorded_costs_grow_as_the_text_says(unit):
    triangles, pixels, tested, nodes = np.array(COSTS[unit], float).T
    grows, stays = (triangles, pixels) if unit == "triangles" else (pixels, triangles)
    assert (np.diff(grows) > 0).all() and (stays == stays[0]).all()
    if unit == "pixels":
        for steps in (tested, nodes):
            assert np.ptp(steps / pixels) < 0.1 * steps[0] / pixels[0]
        return
    assert tested.max() < 1.25 * tested.min()
    each, first = np.polyfit(np.log2(triangles), nodes / pixels, 1)
    assert round(each, 1) == 0.7
    line = each * np.log2(triangles) + first
    np.testing.assert_allclose(line, nodes / pixels, rtol=0.15)


@pytest.mark.parametrize("wanted", [[5.0], [1, 2, 3, 4], [30, 30, 30, 30], [-9, 0, 90, 99]])
def test_titles_of_lines_do_not_overlap_and_stay_inside(wanted):
    places = apart(wanted, 8.0, 0.0, 32.0)
    assert len(places) == len(wanted)
    assert all(0 <= place <= 32 for place in places)
    assert all(b - a >= 8 for a, b in pairwise(places))
