"""What the outside view draws of a wrong answer to an exercise of the lecture."""

from __future__ import annotations

import numpy as np
import pytest

from app.lecture.exercises import ChoiceExercise
from app.lecture.ghosts import ghosts
from app.lecture.reading import BUILTIN, load_lecture
from app.outside.diagram import Arrow, Dot

STEPS = {step.title: step for step in load_lecture(BUILTIN).steps if step.exercise is not None}


def drawn(title: str, chosen: int | None = None, **texts: str):
    step = STEPS[title]
    return ghosts(step.exercise, tuple(texts.items()), chosen, step.view.camera, 8.0)


@pytest.mark.parametrize(
    ("title", "texts", "names"),
    [
        ("Exercise: a pixel's ray", {"origin": "0 0 0", "direction": "1 1 -1"}, {"your d"}),
        (
            "Exercise: any camera's ray",
            {"origin": "0 0 0", "direction": "-2 0.125 -0.375"},
            {"your d", "your origin"},
        ),
        ("Exercise: find the basis", {"w": "-1 0 0", "u": "0 0 -1", "v": "0 -1 0"},
         {"your w", "your v"}),
        ("Exercise: K, R and t",
         {"e": "0 1 4", "w": "0 -1 0", "left, top, d": "-4 3 1"},
         {"your vec(e)", "your w", "your corner"}),
        ("Exercise: K, R and t",
         {"e": "1 4 0", "w": "0 1 0", "left, top, d": "-1 0.75 2"}, set()),
    ],
)  # fmt: skip
def test_the_wrong_parts_of_an_answer_are_drawn(title, texts, names) -> None:
    items = drawn(title, **texts)
    assert {i.name for i in items if isinstance(i, Arrow | Dot) and "your" in i.name} == names


def test_a_text_that_is_no_vector_draws_nothing() -> None:
    assert drawn("Exercise: a pixel's ray", origin="0 0", direction="") == ()
    assert drawn("Exercise: find the basis", w="up", u="0 0 1", v="0 1 0") == ()


def test_each_wrong_camera_to_choose_is_drawn_and_the_right_one_is_not() -> None:
    task = STEPS["Exercise: which camera?"].exercise
    assert isinstance(task, ChoiceExercise)
    for number, option in enumerate(task.options):
        items = drawn("Exercise: which camera?", number)
        assert (len(items) == 0) == option.right
    corners = [
        np.asarray(i.corners) for i in drawn("Exercise: which camera?", 2) if "side" in i.name
    ]
    assert np.ptp(np.concatenate(corners)[:, 0]) == pytest.approx(3.0)  # the whole viewport
