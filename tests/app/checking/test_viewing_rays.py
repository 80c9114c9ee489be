"""Viewing rays: right answers are never called wrong, near ones always are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.app.checking.cases import shots
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds.viewing_ray import are_right
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckCase

KIND = KINDS["viewing-ray"]
TASK = next(task for task in BUILTIN if task.name == "viewing-ray")
MANY = replace(TASK, count=500, size=(2, 1))


@pytest.fixture(scope="module")
def many():
    """2,000 rays of 1,000 cameras, and of each ray what the student's function is given."""
    cases = KIND.cases(MANY) + KIND.cases(replace(MANY, projection="parallel"))
    names = ("eye", "u", "v", "w")
    known = {name: np.array([getattr(c.camera, name) for c in cases]) for name in names}
    numbers = [
        (*c.camera.viewport, c.camera.distance, *c.pixel, c.camera.is_parallel) for c in cases
    ]
    known["numbers"] = np.array(numbers, float)
    return cases, known


def rays(known, kind, through_the_world=False, moved=0.0):
    """Return the rays of the contract's lines, computed with numbers of a kind.

    through_the_world: by the point on the viewport, from which the eye is subtracted again. moved:
    columns.
    """
    eye, u, v, w = (known[name].astype(kind) for name in ("eye", "u", "v", "w"))
    parts = known["numbers"].astype(kind).T[..., None]
    left, right, bottom, top, distance, i, j, parallel = parts
    half, width, height = kind(0.5), kind(2), kind(1)
    x = left + (j + half + kind(moved)) / width * (right - left)
    y = top - (i + half) / height * (top - bottom)
    direction = x * u + y * v - distance * w
    if through_the_world:
        direction = (eye + x * u + y * v - distance * w) - eye
    origin = np.where(parallel > 0, eye + x * u + y * v, eye)
    return np.stack([origin, np.where(parallel > 0, -w, direction)], axis=1)


def wrong(cases, made, task=MANY):
    given, problems = KIND.given(task, cases, made.tolist())
    assert not problems
    return KIND.wrong(task, cases, given)


@pytest.mark.parametrize("kind", [np.float64, np.float32])
@pytest.mark.parametrize("through_the_world", [False, True])
def test_right_answers_are_right_for_a_thousand_cameras(many, kind, through_the_world):
    cases, known = many
    assert len({id(case.camera) for case in cases}) == 1_000
    assert not wrong(cases, rays(known, kind, through_the_world)).any()


def test_a_twentieth_of_a_pixel_is_seen(many):
    cases, known = many
    assert wrong(cases, rays(known, np.float64, moved=0.05)).all()


lengths = st.floats(1e-150, 1e150)
SHOT = next(shots(replace(TASK, cameras=("turned",), count=1)))
RAY = SHOT.camera.ray(1, 2, SHOT.size)


@given(lengths)
def test_any_positive_length_is_right(length):
    unit = RAY.direction / np.linalg.norm(RAY.direction)
    made = np.array([[RAY.origin, unit * length], [RAY.origin, -unit * length]])
    cases = [CheckCase((), np.array(RAY), (1e-9, 1e-9))] * 2
    assert are_right(cases, made, unit=False).tolist() == [True, False]


def test_cases_follow_from_the_seed_and_begin_with_the_simplest():
    first, again = KIND.cases(TASK), KIND.cases(TASK)
    assert [c.arguments for c in first] == [c.arguments for c in again]
    other = KIND.cases(replace(TASK, seed=TASK.seed + 1))
    assert [c.arguments for c in first] != [c.arguments for c in other]
    cameras = list(dict.fromkeys(case.camera for case in first))
    assert cameras[0].eye == (0, 0, 0) and cameras[0].u == (1, 0, 0)
    assert len(list(shots(TASK))) == TASK.count


@pytest.mark.parametrize("part", ["origin", "direction"])
def test_one_part_of_a_ray_in_camera_space(part):
    """A part that is not asked for counts as right, whatever space it is in."""
    asked = replace(TASK.conventions, space="camera", returns=(part,))
    task = replace(TASK, conventions=asked, count=20)
    cases = KIND.cases(task)
    made = np.zeros((len(cases), 3))
    if part == "direction":
        points = [(*case.camera.image_point(*case.pixel, case.size), case) for case in cases]
        made = np.array([(x, y, -case.camera.distance) for x, y, case in points])
    assert not wrong(cases, made, task).any()
    assert wrong(cases, made + np.array([0.5, 0.25, 0.125]), task).all()
