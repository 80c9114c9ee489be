"""Exercises that are answered by moving an object: counted in id images, said in words."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from both_lectures import first_lecture

from lucida.app.cli import main
from lucida.app.instruments.objects.choosing import chosen
from lucida.app.lecture.hiding import HideExercise
from lucida.app.lecture.reading import lecture_from_toml
from lucida.app.lecture.step_options import state_of
from lucida.app.state.app_state import AppState
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import set_field
from lucida.renderer.editing.outline import outline
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer

TEXT = """\
title = "L"
[scenes.s]
camera = { eye = [0, 0, 8], target = [0, 0, 0], fov_y_deg = 30, aspect = 1.5 }
objects = [
    { type = "box", name = "wall", size = [9, 1, 1], translate = [0, -2, -3] },
    { type = "box", name = "box", size = 1, translate = [1, 0, -1] },
    { type = "sphere", name = "ball", center = [-1, 0, 1], radius = 0.6 },
    { type = "sphere", name = "gone", hidden = true },
    { type = "sphere", name = "fixed", locked = true, center = [0, 1.5, 0], radius = 0.1 },
    { type = "disk", name = "twin", translate = [0, 0, -20] },
    { type = "disk", name = "twin", translate = [0, 0, -30] },
]
lights = [{ type = "point", name = "lamp", position = [2, 5, 4] }]
[[steps]]
title = "T"
scene = "s"
[steps.exercise]
kind = "hide"
question = "Which?"
object = "ball"
hidden = "box"
answer = [0.5, 0, 3.5]
"""
SIZE = (90, 60)


def step(text=TEXT):
    return lecture_from_toml(text, Path(), "x.toml").steps[0]


def task():
    found = step().exercise
    assert isinstance(found, HideExercise)
    return found


def ids(exercise, scene):
    with Tracer(scene) as tracer:
        return tracer.render(exercise.view.for_size(SIZE), SIZE, channels=("id",)).channel("id")


def said(exercise, scene):
    """To a scene, by its own image."""
    alone = exercise.pixels(exercise.without, ids(exercise, exercise.without))
    judged = exercise.check(scene, ids(exercise, scene), alone)
    return judged.right, judged.text


def moved(exercise, center):
    return set_field(exercise.scene, [exercise.item], "center", center)


def test_it_is_counted_in_the_image():
    one = task()
    numbers = {row.shown: row.ids.start for row in outline(one.scene)}
    pixels = np.full((10, 10), -1, np.int32)
    pixels[0, 0], pixels[1] = numbers["ball"], numbers["box"]
    pixels[2] = numbers["wall"]
    assert one.pixels(one.scene, pixels) == 10
    assert one.check(one.scene, pixels, 40).text == "25 % of the box can still be seen."
    pixels[1, 1:] = numbers["ball"]  # one of 50 is not more than 2 %, one of 49 is
    judged = one.check(one.scene, pixels, 50)
    assert judged.right and judged.text.startswith("Correct: hardly a pixel shows the box")
    judged = one.check(one.scene, pixels, 49)
    assert (judged.right, judged.text) == (False, "2.0 % of the box can still be seen.")
    pixels[1, 0] = numbers["ball"]
    assert one.check(one.scene, pixels, 49).text.startswith("Correct: at each pixel of the box")
    judged = one.check(one.scene, pixels, 0)
    assert not judged.right and judged.text.startswith("The box is not in the picture")
    pixels[:2] = -1
    judged = one.check(one.scene, pixels, 40)
    assert (judged.right, judged.text) == (False, "The ball is not in the picture.")
    pixels[:] = numbers["ball"]
    judged = one.check(one.scene, pixels, 40)
    assert not judged.right and judged.text.startswith("The ball fills the whole picture")


def test_what_is_said_while_it_is_moved():
    one = task()
    assert said(one, one.scene) == (False, "100 % of the box can still be seen.")
    right, text = said(one, moved(one, (0.9, 0.3, 1.5)))
    part = float(text.split(" %")[0])
    assert not right and 0 < part < 60 and "farther" not in text
    assert said(one, one.solved(one.scene))[0]
    assert said(one, one.solved(moved(one, (3, 2, 1))))[0]  # wherever it was
    for z in (-1.4, -3):
        right, text = said(one, moved(one, (2.5, 0, z)))
        assert not right and text.endswith("The ball is farther away: the closest hit is the box.")


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [("box", "translate", [9, 0, 0]), ("wall", "size", [9, 9, 1]), ("box", "hidden", True)],
)
def test_only_the_object_is_to_be_moved(name, field, value):
    one = task()
    other = next(row.item for row in outline(one.scene) if row.shown == name)
    right, text = said(one, set_field(one.solved(one.scene), [other], field, value))
    assert not right and text.startswith("Move only the ball")


def test_its_size_is_to_stay_and_its_colour_may_change():
    one = task()
    solved = one.solved(one.scene)
    right, text = said(one, set_field(solved, [one.item], "radius", 3.0))
    assert not right and "shape and size" in text
    assert said(one, set_field(solved, [one.item], "radius", 0.6000001))[0]  # rounded in a drag
    assert said(one, set_field(solved, [one.item], "material.diffuse", "#ffffff"))[0]


def test_what_was_added_or_deleted_is_told():
    one = task()
    more, _ = objects.add(one.scene, objects.new_table(one.scene, "box", (0, 0, 2), 2.0))
    assert said(one, more)[1].startswith("Move only the ball")
    less = objects.delete(one.scene, [one.item])
    assert said(one, less)[1].startswith("Move only the ball")
    with pytest.raises(LucidaError, match="no 'ball' any more; go back to the step"):
        one.solved(less)


def test_another_camera_is_known():
    one = task()
    assert not one.camera_moved(one.view.for_size(SIZE), SIZE)
    eye = View(replace(one.view.camera, eye=(0, 0.01, 8)), one.view.fit)
    assert one.camera_moved(eye.for_size(SIZE), SIZE)
    assert one.when_moved.text.startswith("The camera has moved.")


def test_the_object_is_chosen_when_the_step_begins():
    here = step()
    assert isinstance(here.exercise, HideExercise)
    base = AppState(here.scene, here.view, True)
    assert chosen(state_of(here, base)) == (here.exercise.item,)
    assert chosen(state_of(replace(here, exercise=None), state_of(here, base))) == ()


@pytest.mark.parametrize(
    ("line", "wrong", "told"),
    [
        ('object = "ball"', 'object = "bal"', "20: {}.object: 'bal' is unknown; did you mean"),
        ('hidden = "box"', 'hidden = "lamp"', "21: {}.hidden: 'lamp' is unknown; give one of"),
        ('hidden = "box"', 'hidden = "ball"', "21: {}.hidden: is the object itself; name another"),
        ('hidden = "box"', 'hidden = "twin"', "21: {}.hidden: 2 objects are called 'twin'; give"),
        ('hidden = "box"', 'hidden = "gone"', "21: {}.hidden: 'gone' is hidden in the scene; show"),
        ('object = "ball"', 'object = "fixed"', "20: {}.object: 'fixed' is locked in the scene;"),
        ("answer = [0.5, 0, 3.5]\n", "", "17: {}.answer: is missing"),
        ("answer = ", "at_most = 0.6\nanswer = ", "22: {}.at_most: 0.6 is out of range; give 0 to"),
        ("answer = ", "at_most = -0.1\nanswer = ", "22: {}.at_most: -0.1 is out of range; give"),
    ],
)  # fmt: skip
def test_mistakes_name_line_field_value_and_remedy(line, wrong, told):
    assert line in TEXT
    with pytest.raises(LucidaError) as caught:
        step(TEXT.replace(line, wrong))
    expected = "x.toml:" + told.format("steps[0].exercise")
    assert str(caught.value).startswith(expected), str(caught.value)


def test_the_built_in_one_is_solved_by_its_answer():
    lecture = first_lecture()
    step = next(one for one in lecture.steps if isinstance(one.exercise, HideExercise))
    assert isinstance(step.exercise, HideExercise)
    assert said(step.exercise, step.scene) == (False, "100 % of the box can still be seen.")
    assert said(step.exercise, step.exercise.solved(step.scene))[0]
    # Where it stands now, beside the ray of the marked pixel, it could not hide it.
    x, y, z = step.exercise.answer
    assert not said(step.exercise, moved(step.exercise, (x + 0.35, y - 0.2, z - 2.6)))[0]


def test_objects_of_the_same_name_are_no_way_round(tmp_path):
    one = task()
    big = {"type": "sphere", "radius": 2.0, "center": [0.8, 0, 4]}
    for name in ("ball", "wall", "box"):
        added, _ = objects.add(one.scene, {**big, "name": name})
        assert said(one, added) == (False, one.told["changed"]), name
    twins = [row.item for row in outline(one.scene) if row.shown == "twin"]
    solved = one.solved(one.scene)
    for scene in (
        objects.delete(solved, twins[:1]),
        set_field(solved, twins[:1], "translate", [0, 0, -30]),  # now both are as one of them was
    ):
        assert said(one, scene) == (False, one.told["changed"])


def test_the_solution_turns_the_object_as_it_was():
    flat = '{ type = "rectangle", name = "ball", width = 2, depth = 2, rotate_deg = [90, 0, 0] }'
    ball = '{ type = "sphere", name = "ball", center = [-1, 0, 1], radius = 0.6 }'
    one = step(TEXT.replace(ball, flat)).exercise
    assert isinstance(one, HideExercise)
    turned = set_field(one.scene, [one.item], "rotate_deg", [0, 0, 0])
    assert (
        said(one, one.solved(turned))
        == said(one, one.solved(one.scene))
        == (
            True,
            "Correct: at each pixel of the box, the closest hit is now the ball.",
        )
    )


@pytest.mark.parametrize(
    ("line", "wrong", "told"),
    [
        ("[0.5, 0, 3.5]", "[0.5, 0, 4.5]", None),
        ("[0.5, 0, 3.5]", "[0.5, 0, 1.5]", ":22: {}.answer: is not correct: "),
        ("[0.5, 0, 3.5]", "[0.5, 0, -5]", ":22: {}.answer: is not correct: 100 % of the box can"),
        ("[0.5, 0, 3.5]", "[inf, 0, 3.5]", ":22: {}.answer: inf is not finite"),
        ("[0.5, 0, 3.5]", "[1e11, 0, 3.5]", ":22: {}.answer: is not correct: The ball is not in"),
        ("[-1, 0, 1]", "[0.5, 0, 3.5]", ":20: {}.object: 'box' is hidden before anything is mov"),
        ("[1, 0, -1]", "[1, 0, 30]", ":21: {}.hidden: 'box' is not in the picture; put it in fro"),
    ],
)  # fmt: skip
def test_checking_a_lecture_tries_the_answer(line, wrong, told, tmp_path, capsys):
    assert line in TEXT
    path = tmp_path / "x.toml"
    asked_last = TEXT.replace(line, wrong) + "\n[[steps.builds]]\ntext = 'Now.'\n"
    path.write_text("\ufeff" + asked_last, "utf-8")
    assert main(["lecture", str(path), "--check"]) == (0 if told is None else 2)
    out, error = capsys.readouterr()
    assert ("1 exercise" in out) == (told is None)
    if told is not None:
        assert error.startswith(f"lucida: {path}" + told.format("steps[0].exercise")), error
        assert error.count("\n") == 1
