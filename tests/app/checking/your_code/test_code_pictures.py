"""Pictures of an answer: given, right, different."""

from __future__ import annotations

import numpy as np

from lucida.app.checking.your_code.code_pictures import SAME, SAME_COLOR, compared, image_pair
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


def test_images_are_pictures_gray_ones_too():
    gray = np.array([[0.0, 1.0], [0.5, 0.25]])
    found = image_pair(gray, gray)
    assert found.told == "none"
    assert (found.right[0, 1] == 255).all()
    colors = gray[..., None].repeat(3, axis=2)
    assert (image_pair(colors, colors).right == found.right).all()
