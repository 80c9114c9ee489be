"""Typed answers, and what exercises say to right and wrong ones."""

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.checking.mistakes.rays import RayTask, ray_program, ray_values, run_rays
from lucida.app.lecture import exercises
from lucida.app.lecture.exercises import (
    TOLERANCE,
    ChoiceExercise,
    Option,
    RayExercise,
    VectorExercise,
    Wanted,
    WrongVector,
)
from lucida.app.ui.explaining.arithmetic import number, text_of, vector, vector_text
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Ray
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.system.errors import LucidaError


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/8", 0.125),
        (" -0.25 ", -0.25),
        ("\u22121/4", -0.25),
        ("(6 - 0.5)/8 - 0.5", 0.1875),
        ("1/sqrt(2)", math.sqrt(0.5)),
        ("\u221a(2)/2", math.sqrt(0.5)),
        ("2e-3", 0.002),
        ("+3", 3.0),
        ("2 + 3 \u00b7 4", 14.0),
        ("-\u03c0/2", -math.pi / 2),
        ("7".ljust(80, "0"), 7e79),
    ],
)
def test_a_number_is_read_in_every_form(text, value):
    assert number(text) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (" ", "is empty; give a number"),
        ("9" * 81, "is too long; give a number"),
        (" 3 /0", "'3 /0' divides by zero"),
        ("1e999", "'1e999' is not finite"),
        ("1e400 - 1e400", "'1e400 - 1e400' is not finite"),
        ("2**3", "'2**3' is not a number; give one such as"),
    ],
)
def test_what_is_told_of_it(text, told):
    with pytest.raises(LucidaError) as error:
        number(text)
    assert told in str(error.value)


@pytest.mark.parametrize(
    "text", ["(1/8, 0, -1)", "1/8, 0, -1", "[0.125; 0; -1]", "1/8 0 -1", "(1/8), 0, (-1)"]
)
def test_a_vector_is_read_in_every_form(text):
    assert vector(text).tolist() == [0.125, 0.0, -1.0]


def test_how_solutions_are_written():
    assert [text_of(x) for x in (0.125, -0.0, 3.0, -2 / 3, 5 / 16, 0.70710678)] == [
        "1/8", "0", "3", "-2/3", "5/16", "0.7071",
    ]  # fmt: skip
    assert vector_text(np.array([0.5, 0, -1])) == "(1/2, 0, -1)"
    for below in (2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32):
        assert text_of(1 / below) == f"1/{below}"
    for value in (1 / 7, 1 / 9, 1 / 64, 0.25 + 1e-8):
        assert text_of(value) == f"{value:.4g}"
    assert text_of(0.25 + 1e-11) == "1/4"


CANONICAL = RayExercise("Which?", Camera.canonical(), (1, 5), (8, 8))
ANY = RayExercise(
    "Which?",
    Camera((4, 1, 0), (0, 0, -1), (0, 1, 0), (1, 0, 0), 2.0, (-0.5, 0.5, -0.4, 0.6)),
    (0, 2),
    (4, 3),
    scaled=False,
)
PARALLEL = RayExercise(
    "Which?", replace(ANY.camera, projection="parallel"), (0, 2), (4, 3), scaled=False
)


def answer(origin, direction):
    return {
        "origin": ", ".join(map(repr, map(float, origin))),
        "direction": ", ".join(map(repr, map(float, direction))),
    }


def mistakes(camera, i, j, size, indexing=Indexing.LECTURE):
    """Return the pixel that each wrong line computes."""
    task = RayTask(camera.projection, indexing)
    program, known = ray_program(task), ray_values(camera, i, j, size, task)
    return [(one, Ray(*run_rays(program, known, (one,)))) for one in program.mistakes]


def test_a_ray_computed_by_hand_is_right_scaled_or_rounded():
    # Row 2, column 6 of 8: u = 5.5/8 - 0.5, v = -(1.5/8 - 0.5).
    right = CANONICAL.check({"origin": "(0, 0, 0)", "direction": "3/16, 5/16, -1"})
    assert right.right
    assert CANONICAL.check({"origin": "0 0 0", "direction": "(3, 5, -16)"}).right
    rounded = CANONICAL.check({"origin": "0,0,0", "direction": "0.188, 0.313, -1"})
    assert rounded.right


@pytest.mark.parametrize("exercise", [CANONICAL, ANY, PARALLEL])
def test_the_renderers_ray_is_right_and_nothing_near_it(exercise):
    ray = exercise.camera.ray(*exercise.pixel, exercise.size)
    assert exercise.check(answer(*ray)).right
    for part in range(3):
        for where in (0, 1):
            wrong = [np.array(ray.origin), np.array(ray.direction)]
            wrong[where][part] += 0.05
            verdict = exercise.check(answer(*wrong))
            assert not verdict.right
            assert verdict.field == ("origin", "direction")[where]


def test_a_tolerance_is_a_share_of_the_correct_length():
    exercise = replace(ANY, tolerance=0.1)
    ray = ANY.camera.ray(*ANY.pixel, ANY.size)
    for share, right in ((1.099, True), (1.105, False)):
        assert exercise.check(answer(share * ray.origin, ray.direction)).right == right
        assert exercise.check(answer(ray.origin, share * ray.direction)).right == right


@pytest.mark.parametrize("exercise", [CANONICAL, ANY, PARALLEL])
def test_every_classic_mistake_is_told_by_its_own_hint(exercise):
    camera, pixel, size = exercise.camera, exercise.pixel, exercise.size
    right = camera.ray(*pixel, size)
    told = set()
    made = mistakes(camera, *pixel, size)
    close, along = exercises.is_close, exercises.is_multiple
    same_direction = along if exercise.scaled else close
    for mistake, ray in made:
        same = close(ray.origin, right.origin, TOLERANCE) and same_direction(
            ray.direction, right.direction, TOLERANCE
        )
        verdict = exercise.check(answer(*ray))
        assert verdict.right == same, mistake.name
        if not same and ray.direction.any():
            told.add(verdict.text)
            alike = [
                exercises.hint(other)
                for other, its in made
                if close(ray.origin, its.origin, TOLERANCE)
                and same_direction(ray.direction, its.direction, TOLERANCE)
            ]
            assert verdict.text == alike[0], mistake.name
    assert len(told) >= 15


def test_hints_count_as_the_lecture_does():
    exercise = replace(CANONICAL, indexing=Indexing.ARRAY)

    def hint(direction):
        return exercise.check({"origin": "0, 0, 0", "direction": direction}).text

    # Row 1, column 5 of 8 x 8, from 0: u = (5 + 0.5) / 8 - 1/2.
    assert hint("5.5/8 - 1/2, 1/2 - 1.5/8, -1") == "Correct."
    assert "corner" in hint("5/8 - 1/2, 1/2 - 1/8, -1")
    assert "from 0: add the half" in hint("4.5/8 - 1/2, 1/2 - 0.5/8, -1")
    assert "not at j + 1" in hint("6/8 - 1/2, 1/2 - 2/8, -1")
    names = {mistake.name for mistake, _ in mistakes(Camera(), 1, 5, (8, 8), Indexing.ARRAY)}
    assert "a whole pixel" in names and "no half pixel" not in names
    assert exercise.solution().startswith("Pixel (1, 5) lies")


@pytest.mark.parametrize(
    ("exercise", "origin", "direction", "told", "field"),
    [
        # Both parts as one mistake gives them, of which one is wrong.
        (CANONICAL, "0 0 0", "3/16, -5/16, -1", "minus sign", "direction"),
        (PARALLEL, "0, 1/10 + 1/3, -1/8", "-1, 0, 0", "forgets the eye", "origin"),
        # A mistake in one part alone.
        (CANONICAL, "3/16, 5/16, 0", "3, 5, -16", "whatever the pixel", "origin"),
        (CANONICAL, "0 0 0", "0 0 -1", "parallel ray", "direction"),
        (CANONICAL, "0 0 0", "-3, -5, 16", "points backwards", "direction"),
        # None that is known.
        (CANONICAL, "0 0 7", "3, 5, -16", "begins at the eye", "origin"),
        (PARALLEL, "7 7 7", "-1, 0, 0", "begins on the image plane", "origin"),
        (CANONICAL, "0 0 0", "7, 5, -16", "the direction is not", "direction"),
    ],
)
def test_what_is_wrong_is_told_at_its_field(exercise, origin, direction, told, field):
    verdict = exercise.check({"origin": origin, "direction": direction})
    assert told in verdict.text
    assert (verdict.right, verdict.field) == (False, field)


def test_length_counts_where_the_question_says_so():
    strict = replace(CANONICAL, scaled=False)
    verdict = strict.check({"origin": "0, 0, 0", "direction": "3, 5, -16"})
    assert not verdict.right and "length" in verdict.text


def test_what_is_no_vector_is_told_with_its_field():
    verdict = CANONICAL.check({"origin": "0, 0, 0", "direction": "left"})
    assert (verdict.right, verdict.field) == (False, "direction")
    assert "is not three numbers" in verdict.text
    assert CANONICAL.check({}).field == "origin"
    assert not CANONICAL.check({"origin": "0 0 0", "direction": "0 0 0"}).right


def test_the_solution_shows_the_pixel_and_its_ray():
    text = CANONICAL.solution()
    assert "Pixel (2, 6)" in text and "(3/16, 5/16, -1)" in text
    assert r"\mathbf{p} = \mathbf{e} + u" in PARALLEL.solution()


class TestVectors:
    exercise = VectorExercise(
        question="u and w?",
        answers=[
            Wanted(
                name="w",
                value=(1, 0, 0),
                wrong=[WrongVector(value=(-1.0, 0.0, 0.0), feedback="w points back.")],
            ),
            Wanted(name="u", value=(0, 0, -1), scaled=True),
        ],
    )

    def test_each_wrong_vector_has_its_own_verdict(self):
        check = self.exercise.check
        assert check({"w": "1, 0, 0", "u": "0 0 -5"}).right
        assert check({"w": "-1, 0, 0", "u": "0 0 -5"}).text == "w points back."
        assert "length" in check({"w": "2, 0, 0", "u": "0 0 -5"}).text
        other_way = check({"w": "1, 0, 0", "u": "0 0 1"})
        assert other_way.field == "u" and "other way" in other_way.text
        assert "not correct" in check({"w": "1, 0, 0", "u": "1 0 0"}).text
        assert check({"w": "1, 0, 0"}).field == "u"
        for w, u in (("-1, 0, 0", "0 0 -5"), ("1, 0, 0", "0 0 1"), ("1, 0, 0", "1 0 0")):
            assert not check({"w": w, "u": u}).right
        assert "(0, 0, -1)" in self.exercise.solution()


@pytest.mark.parametrize(("length", "off"), [(0.1, 0.002), (1.0, 0.002), (100.0, 0.2)])
def test_answers_may_be_rounded_to_three_digits(length, off):
    """Two thousandths of the vector's length, or of 1."""
    exercise = VectorExercise(question="p?", answers=[Wanted(name="p", value=(length, 0, 0))])
    for part, right in ((0.95, True), (1.05, False)):
        assert exercise.check({"p": f"{length}, {part * off:.9f}, 0"}).right == right


def test_choices_have_feedback_for_each():
    options = [Option(text="a", feedback="No."), Option(text="b", feedback="Yes.", right=True)]
    exercise = ChoiceExercise(question="Which?", options=options)
    assert [exercise.check(k).right for k in (0, 1)] == [False, True]
    assert [exercise.check(k).text for k in (0, 1)] == ["No.", "Yes."]
    assert exercise.solution() == "b\n\nYes."
