"""A wrong answer next to the correct one, and the outside camera that sees both."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from looked_at import looking_cameras, vectors

from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Arrow, Label, Segments
from lucida.app.instruments.outside.second_camera import ROLE, GivenRay
from lucida.app.instruments.outside.widening import backed

SIZE = (200, 150)
CORRECT = GivenRay(np.array([1.0, 0.0, 3.0]), np.array([0.2, 0.1, -1.0]))


@pytest.mark.parametrize("camera", looking_cameras())
@given(points=st.lists(vectors, min_size=1, max_size=5))
def test_a_camera_that_moves_back_sees_everything_and_no_farther_than_it_must(
    camera, points
) -> None:
    points = 20.0 * np.array(points)
    moved = backed(camera, points, SIZE)
    assert backed(moved, points, SIZE).eye == pytest.approx(moved.eye)
    assert (moved.u, moved.v, moved.w) == (camera.u, camera.v, camera.w)
    matrix = moved.camera_from_world
    x, y, z = (points @ matrix[:3, :3].T + matrix[:3, 3]).T
    scale = np.ones(len(x)) if moved.is_parallel else moved.distance / -z
    left, right, bottom, top = moved.fitted(SIZE).viewport
    assert (scale > 0).all()
    assert (x * scale < right).all() and (x * scale > left).all()
    assert (y * scale < top).all() and (y * scale > bottom).all()


def test_a_camera_that_sees_everything_stays() -> None:
    for camera in looking_cameras():
        middle = np.asarray(camera.eye) - 5 * np.asarray(camera.w)
        assert backed(camera, middle[None], SIZE) is camera
        assert backed(camera, np.zeros((0, 3)), SIZE) is camera


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


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e300])
def test_what_cannot_be_drawn_leaves_the_correct_one(bad) -> None:
    wrong = np.full(3, bad)
    for items in (
        answers.ray(GivenRay(wrong, wrong), CORRECT, 6.0),
        answers.vector("u", "u", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
        answers.point("vec(e)", (0, 0, 0), wrong, np.array([1, 0, 0.0])),
    ):
        assert items and all(item.role != ROLE for item in items)
        assert np.isfinite(answers.points_of(items)).all()
