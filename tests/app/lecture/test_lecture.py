"""Lecture files: what they hold, and mistakes with file, line and field."""

from dataclasses import fields

import pytest
from option_changes import with_options
from sample_lecture import FILE, read

from lucida.app.lecture.exercises import ChoiceExercise, RayExercise
from lucida.app.lecture.reading import lecture_from_toml, load_lecture
from lucida.app.lecture.step_options import ELSEWHERE, state_of
from lucida.app.lecture.view import is_stacked
from lucida.app.state.app_state import AppState
from lucida.app.state.options import Options
from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError


def test_a_whole_file_is_read():
    lecture = read()
    assert (lecture.title, lecture.author) == ("A lecture", "A. Speaker")
    assert lecture.outline() == [("First", [0, 1]), ("Second", [2])]
    one, two, three = lecture.steps
    assert [step.line for step in lecture.steps] == [10, 36, 39]
    assert one.scene.name == "ball"
    assert one.view.camera == Camera(eye=(0, 0, 5))
    assert one.views == ("outside", "ray")
    assert one.pixel == (1, 2)  # row 2, column 3
    assert one.changes["images"] == {"samples": 4, "channel": "depth"}
    assert one.changes["outside"]["bundle"] == (4, 4)
    assert one.changes["outside"]["camera"] == Camera.look_at((5, 5, 5), (0, 0, 0))
    assert isinstance(one.exercise, RayExercise)
    assert (one.exercise.pixel, one.exercise.size) == ((0, 2), (4, 3))
    assert one.exercise.camera == one.view.camera
    assert isinstance(three.exercise, ChoiceExercise)
    assert [option.right for option in three.exercise.options] == [False, True]
    # What a step leaves out.
    assert two.views == ("raster",) and two.part == "First"
    assert two.pixel is None and two.exercise is None and not two.changes
    assert two.scene.name == "still life" and two.view == two.scene.view


def test_a_lecture_counts_pixels_in_one_way():
    """From 1; or from 0, in the file, in the window and in what is told of exercises."""
    from_zero = FILE.replace("author =", "pixels_from = 0\nauthor =")
    one, other = read(FILE), read(from_zero)
    for lecture, pixel, asked, told in (
        (one, (1, 2), (0, 2), "Pixel (1, 3) lies"),
        (other, (2, 3), (1, 3), "Pixel (1, 3) lies"),
    ):
        step = lecture.steps[0]
        assert (step.pixel, step.exercise.pixel) == (pixel, asked)
        assert step.exercise.solution().startswith(told)
        for number in (0, 1, 2):
            base = with_options(AppState.for_scene(step.scene), one_based=lecture is other)
            state = state_of(lecture.steps[number], base)
            assert state.options.one_based == (lecture is one)
    assert other.steps[0].exercise.indexing.text((1, 3)) == "(1, 3)"
    last = from_zero.replace("pixel = [1, 3]", "pixel = [2, 3]")
    assert read(last).steps[0].exercise.pixel == (2, 3)
    with_two = FILE.replace("author =", "pixels_from = 2\nauthor =")
    for text, told in (
        (last.replace("[2, 3]\nsize", "[3, 3]\nsize"), "4x3; give a row up to 2 and a"),
        (FILE.replace("[1, 3]", "[0, 3]"), "not a pixel; give row and column, from 1"),
        (from_zero.replace("[1, 3]", "[-1, 3]"), "not a pixel; give row and column, from 0"),
        (with_two, r"x\.toml:3: pixels_from: "),
        (FILE.replace("options.shadows = true", "options.one_based = false"),
         r"x\.toml:26: steps\[0\]\.options\.one_based: differs from pixels_from = 1; leave it"),
    ):  # fmt: skip
        with pytest.raises(LucidaError, match=told):
            read(text)


def test_every_option_is_known_to_a_step():
    lines = [line for line in FILE.splitlines() if not line.startswith("options.")]
    for name in {entry.name for entry in fields(Options)} - set(ELSEWHERE):
        broken = "\n".join([*lines[:20], f"options.{name} = []", *lines[20:]])
        with pytest.raises(LucidaError, match=rf"x\.toml:21: steps\[0\]\.options\.{name}: "):
            read(broken)


def test_scenes_and_views_beside_the_file(tmp_path):
    (tmp_path / "one.toml").write_text('[[objects]]\ntype = "box"\n')
    (tmp_path / "eye.toml").write_text("[camera]\neye = [1, 2, 3]\n")
    text = FILE.replace('"ball"', '"one.toml"').replace("{ eye = [0, 0, 5] }", '"eye.toml"')
    step = read(text, tmp_path).steps[0]
    assert step.scene.name == "one" and step.view.camera.eye == (1, 2, 3)
    (tmp_path / "one.toml").write_text('[[objects]]\ntype = "bax"\n')
    with pytest.raises(LucidaError) as told:
        read(text, tmp_path)
    assert str(told.value).startswith("x.toml:19: steps[0].scene: ")
    assert "one.toml: objects[0].type: 'bax' is unknown; did you mean 'box'?" in str(told.value)


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ('"depth"', '"depht"', 23, "options.images.channel: 'depht' is unknown; did you mean"),
        ("bundle", "bundel", 24, "options.outside.bundel: is unknown; did you mean 'bundle'?"),
        ("options.shadows", "options.preferences", 26, "options.preferences: is unknown"),
        ("[0, 0, 5]", "[0, 0]", 20, "camera.eye: has 2 entries; give 3"),
        ("[0, 0, 0]", "[5, 5, 5]", 25, "options.outside.camera.target: (5, 5, 5) is the eye"),
        ('"ball"', '"bal"', 19, "scene: 'bal' is unknown; did you mean 'ball'?"),
        ("{ eye = [0, 0, 5] }", '"gone.toml"', 20, "camera: gone.toml: does not exist"),
        ('"outside", "', '"outsid", "', 21, "views[0]: 'outsid' is unknown; did you mean"),
        ('"outside", "', '"stepper", "probe", "', 21, "views: names 3; give one or two"),
        ('"outside", "ray"]', '"ray", "ray"]', 21, "views: names one twice"),
        ("[2, 3]", "[0, 3]", 27, "pixel: [0, 3] is not a pixel; give row and column, from 1"),
        ("samples = 4", "resolution = [2, 9]", 27, "pixel: [2, 3] is not in an image"),
        ('title = "One"', 'titel = "One"', 11, "titel: is unknown; did you mean 'title'?"),
        ('title = "Two"', "", 36, "title: is missing; give it"),
        ('title = "Two"', 'title = " "', 37, "title: is empty"),
        ("$u = 1$", "$u = 1", 15, "text: a formula does not end"),
        ("[4, 3]", "[2, 3]", 33, "exercise.pixel: [1, 3] is not in an image of 2x3"),
        ('"Which ray?"', '""', 32, "exercise.question: is empty"),
        ('kind = "ray"', 'kind = "rya"', 31, "exercise.kind: 'rya' is unknown; did you"),
        (", right = true", "", 44, "exercise.options: has 0 correct ones"),
        ('"sphere"', '"sphre"', 6, "objects[0].type: 'sphre' is unknown; did you mean"),
        ("scenes.ball", "scenes.spheres", 5, "scenes.spheres: is the name of a built-in"),
    ],
)  # fmt: skip
def test_mistakes_name_file_line_and_field(old, new, line, told):
    assert old in FILE
    with pytest.raises(LucidaError) as error:
        read(FILE.replace(old, new, 1))
    assert str(error.value).startswith(f"x.toml:{line}: "), error.value
    assert told in str(error.value)


def test_mistakes_of_the_whole(tmp_path):
    for text, told in (
        ('title = "x"\nsteps = []', "x.toml:2: steps: holds 0 steps"),
        ('title = "x"', "x.toml:1: steps: is missing"),
        ('title = "x"\nsteps = [1]', r"x.toml:2: steps[0]: is a whole number; give a table"),
        ('title = ""\n[[steps]]\ntitle = "x"', "x.toml:1: title: is empty"),
        ("title = ", "x.toml:1: column 9: invalid value"),
        ("\nlucida = 2", "x.toml:2: lucida: the file has version 2"),
    ):
        with pytest.raises(LucidaError) as error:
            read(text)
        assert str(error.value).startswith(told)
    with pytest.raises(LucidaError, match="does not exist"):
        load_lecture(tmp_path / "none.toml")


def test_text_that_is_not_utf8_names_its_line(tmp_path):
    path = tmp_path / "latin.toml"
    path.write_bytes('title = "a"\n# \xe9\n'.encode("latin-1"))
    with pytest.raises(LucidaError) as error:
        load_lecture(path)
    assert str(error.value).startswith(f"{path}:2: is not text in UTF-8")


def test_what_is_said_to_a_wrong_vector_is_a_text_too(tmp_path):
    text = """\
title = "x"
[[steps]]
title = "a"
[steps.exercise]
kind = "vector"
question = "Which?"
answers = [
    { name = "w", value = [0, 0, 1], wrong = [
        { value = [0, 0, -1], feedback = "$w" },
    ] },
]
"""
    with pytest.raises(LucidaError) as told:
        lecture_from_toml(text, tmp_path, "x.toml")
    assert str(told.value).startswith(
        "x.toml:7: steps[0].exercise.answers[0].wrong[0].feedback: a formula does not end"
    )


@pytest.mark.parametrize(
    ("views", "window", "stacked"),
    [
        (("outside", "ray"), (1024, 768), True),
        (("outside", "ray"), (1200, 800), False),
        (("stepper", "ray"), (1024, 768), False),
        (("outside",), (1024, 768), False),
    ],
)
def test_two_pictures_are_stacked_in_a_window_narrower_than_3_to_2(views, window, stacked):
    assert is_stacked(views, window) == stacked
