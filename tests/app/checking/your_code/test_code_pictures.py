"""Pictures of an answer: given, right, different."""

from __future__ import annotations

import numpy as np

from lucida.app.checking.your_code.code_pictures import SAME, SAME_COLOR, compared
from lucida.app.images.changed_pixels import MARK

YES = np.ones((2, 3), bool)
NO = np.zeros((2, 3), bool)
LIGHT = np.full((2, 3, 3), 0.5, np.float32)


def test_what_is_right_differs_nowhere():
    found = compared(LIGHT, LIGHT, YES, NO)
    assert found.size == (3, 2)
    assert found.told == "none"
    assert (found.given == found.right).all()
    assert (found.difference == found.difference[0, 0]).all()


def test_colours_and_rays_that_differ_are_marked_apart():
    given = LIGHT.copy()
    given[0, 0] = 0.9
    wrong = NO.copy()
    wrong[0, :2] = True
    found = compared(given, LIGHT, YES, wrong)
    assert tuple(found.difference[0, 0]) == MARK
    assert tuple(found.difference[0, 1]) == SAME_COLOR
    assert tuple(found.difference[1, 2]) not in (MARK, SAME_COLOR)
    assert found.told == "17 % of the pixels"
    assert compared(LIGHT, LIGHT, YES, wrong).told == SAME
