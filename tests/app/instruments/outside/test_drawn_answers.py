"""A wrong answer next to the correct one."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Arrow, Label, Segments
from lucida.app.instruments.outside.second_camera import ROLE, GivenRay

CORRECT = GivenRay(np.array([1.0, 0.0, 3.0]), np.array([0.2, 0.1, -1.0]))


def test_a_students_answer_is_dashed_and_named_in_its_own_colour() -> None:
    given_ray = GivenRay(np.zeros(3), np.array([0.2, -0.1, -2.0]))
    for items in (
        answers.ray(given_ray, CORRECT, 6.0),
        answers.vector("w", "w", (1, 2, 3), np.array([0, 1, 0.0]), np.array([1, 0, 0.0])),
        answers.point("vec(e)", (1, 2, 3), np.zeros(3), np.array([1, 2, 3.0])),
    ):
        lines = [item for item in items if isinstance(item, Segments | Arrow)]
        assert {item.dashed for item in lines} == {True, False}
        assert all(item.dashed == (item.role == ROLE) for item in lines)
        labels = [item for item in items if isinstance(item, Label)]
        assert all(label.text.startswith("your ") == (label.role == ROLE) for label in labels)
        assert {label.role == ROLE for label in labels} == {True, False}


def test_the_correct_ray_points_forwards_and_has_the_given_length() -> None:
    [ray] = (item for item in answers.ray(CORRECT, CORRECT, 6.0) if item.name == "correct ray")
    assert isinstance(ray, Segments)
    forwards = CORRECT.direction / np.linalg.norm(CORRECT.direction)
    ends = [CORRECT.origin, CORRECT.origin + 6.0 * forwards]
    np.testing.assert_allclose(ray.segments, [ends])


def test_arrows_lead_from_the_point_along_both_vectors() -> None:
    items = answers.vector("w", "w", (1, 2, 3), np.array([0, 1, 0.0]), np.array([1, 0, 0.0]))
    ends = [(item.start, item.end) for item in items if isinstance(item, Arrow)]
    np.testing.assert_allclose(ends, [[(1, 2, 3), (2, 2, 3)], [(1, 2, 3), (1, 3, 3)]])


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e300])
def test_an_answer_that_cannot_be_drawn_leaves_the_correct_one(bad) -> None:
    wrong = np.full(3, bad)
    for items in (
        answers.ray(GivenRay(wrong, wrong), CORRECT, 6.0),
        answers.vector("u", "u", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
        answers.point("vec(e)", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
    ):
        assert items and all(item.role != ROLE for item in items)
