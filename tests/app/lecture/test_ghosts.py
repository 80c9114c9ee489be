"""The drawing of a wrong answer to an exercise of the lecture, in the outside view."""

import pytest
from both_lectures import both_lectures

from lucida.app.instruments.outside.diagram import Arrow, Dot
from lucida.app.lecture.ghosts import ghosts


def drawn(title, **texts):
    step = next(one for one in both_lectures().steps if one.title == title and one.exercise)
    return ghosts(step.exercise, tuple(texts.items()), step.view.camera, 8.0)


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
def test_the_wrong_parts_of_an_answer_are_drawn(title, texts, names):
    items = drawn(title, **texts)
    assert {i.name for i in items if isinstance(i, Arrow | Dot) and "your" in i.name} == names


def test_a_text_that_is_no_vector_draws_nothing():
    assert drawn("Exercise: a pixel's ray", origin="0 0", direction="") == ()
    assert drawn("Exercise: find the basis", w="up", u="0 0 1", v="0 1 0") == ()
