"""The second lecture's K, R and t are its step's camera, and what it calls wrong is what each
mistake makes."""

import numpy as np
import pytest

from lucida.app.lecture.exercises import VectorExercise
from lucida.app.lecture.reading import BUILTINS, load_lecture
from lucida.app.ui.explaining.arithmetic import vector_text
from lucida.renderer.camera.camera import Camera

SIZE = (8, 6)
K = np.array([[8, 0, 3.5], [0, 8, 2.5], [0, 0, 1]])
R = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
T = np.array([0, 1, 4])


@pytest.fixture(scope="module")
def step():
    steps = load_lecture(BUILTINS["Cameras beyond the formula"]).steps
    return next(step for step in steps if step.title == "Exercise: K, R and t")


def answers(camera):
    left, _, _, top = camera.viewport
    return {
        "e": camera.eye,
        "w": camera.w,
        "left, top, d": (left, top, camera.distance),
    }


def test_the_step_shows_the_camera_that_is_asked_for(step):
    pose = np.column_stack([R, T])
    camera = Camera.from_intrinsics(K, size=SIZE, camera_from_world=pose)
    for name in ("eye", "u", "v", "w", "viewport", "distance"):
        assert getattr(step.view.camera, name) == pytest.approx(getattr(camera, name), abs=1e-12)
    assert isinstance(step.exercise, VectorExercise)
    for wanted in step.exercise.answers:
        assert wanted.value == pytest.approx(answers(camera)[wanted.name], abs=1e-12)


@pytest.mark.parametrize(
    ("field", "made", "told"),
    [
        ("e", T, "origin as the camera sees it"),
        ("e", -T, "turn it back"),
        ("e", R.T @ T, "The sign"),
        ("e", -R @ T, "the inverse"),
        ("e", R @ T, "its sign is minus"),
        ("w", R[2], "ahead"),
        ("w", R[:, 2], "column"),
        ("w", -R[:, 2], "column"),
        ("left, top, d", (-3.5 / 8, 2.5 / 8, 1), "half a pixel"),
        ("left, top, d", (-3 / 8, 2 / 8, 1), "the other way"),
        ("left, top, d", (-4 / 8, -3 / 8, 1), "top"),
        ("left, top, d", (-4, 3, 1), "in pixels"),
        ("left, top, d", (-3.5, 2.5, 1), "from a centre"),
    ],
)
def test_each_mistake_is_known(step, field, made, told):
    task = step.exercise
    texts = {wanted.name: vector_text(np.asarray(wanted.value)) for wanted in task.answers}
    assert task.check(texts).right
    judged = task.check(texts | {field: vector_text(np.asarray(made, float))})
    assert (judged.right, judged.field) == (False, field) and told in judged.text
