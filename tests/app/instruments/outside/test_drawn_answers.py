"""A wrong answer next to the correct one."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Arrow, Label, Segments
from lucida.app.instruments.outside.second_camera import ROLE, GivenRay

CORRECT = GivenRay(np.array([1.0, 0.0, 3.0]), np.array([0.2, 0.1, -1.0]))


def test_what_was_given_is_dashed_named_and_of_another_colour() -> None:
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
    [ray] = (one for one in answers.ray(CORRECT, CORRECT, 6.0) if one.name == "correct ray")
    assert isinstance(ray, Segments)
    forwards = CORRECT.direction / np.linalg.norm(CORRECT.direction)
    ends = [CORRECT.origin, CORRECT.origin + 6.0 * forwards]
    np.testing.assert_allclose(ray.segments, [ends])


def test_arrows_lead_from_the_point_along_both_vectors() -> None:
    given, correct, at = np.array([0, 1, 0.0]), np.array([1, 0, 0.0]), np.array([1, 2, 3.0])
    items = answers.vector("w", "w", at, given, correct)
    for arrow in (item for item in items if isinstance(item, Arrow)):
        way = given if arrow.role == ROLE else correct
        np.testing.assert_allclose((arrow.start, arrow.end), (at, at + way))


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e300])
def test_what_cannot_be_drawn_leaves_the_correct_one(bad) -> None:
    wrong = np.full(3, bad)
    for items in (
        answers.ray(GivenRay(wrong, wrong), CORRECT, 6.0),
        answers.vector("u", "u", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
        answers.point("vec(e)", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
    ):
        assert items and all(item.role != ROLE for item in items)
