"""Lecture files: what they hold, and mistakes with file, line and field; the built-in lecture."""

from __future__ import annotations

import itertools
import re
from dataclasses import fields
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from plain_text import plain_text, words_of

from app.explaining.languages import LANGUAGES
from app.lecture import reading
from app.lecture import text as texts
from app.lecture.exercises import ChoiceExercise, RayExercise, VectorExercise
from app.lecture.model import Lecture
from app.lecture.reading import BUILTIN, lecture_from_toml, load_lecture
from app.lecture.session import LectureSession
from app.lecture.states import state_of
from app.lecture.step_options import ELSEWHERE
from app.probe.model import Probe
from app.state.all_options import Options
from app.state.app_state import AppState
from app.storage.watching import FilesWatch
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import load_scene
from renderer.scene.noting import stamp
from renderer.scene.places import Places, parsed_path

FILE = '''\
lucida = 1
title = "A lecture"
author = "A. Speaker"

[scenes.ball]
objects = [
    { type = "sphere" },
]

[[steps]]
title = "One"
part = "First"
text = """
# Hello
A **bold** word and $u = 1$.

- one
"""
scene = "ball"
camera = { eye = [0, 0, 5] }
views = ["outside", "camera"]
options.images.pixel_size = 8
options.images.channel = "depth"
options.outside.bundle = [4, 4]
options.outside.camera = { eye = [5, 5, 5], target = [0, 0, 0] }
options.shadows = true
pixel = [2, 3]
highlight = ["eye", "outside"]

[steps.exercise]
kind = "ray"
question = "Which ray?"
pixel = [1, 3]
size = [4, 3]

[[steps]]
title = "Two"

[[steps]]
title = "Three"
part = "Second"
exercise.kind = "choice"
exercise.question = "Which?"
exercise.options = [
    { text = "this", feedback = "No." },
    { text = "that", feedback = "Yes.", right = true },
]
'''


def read(text: str = FILE, folder: Path = Path()):
    return lecture_from_toml(text, folder, "x.toml")


class TestReading:
    def test_a_whole_file(self):
        lecture = read()
        assert (lecture.title, lecture.author) == ("A lecture", "A. Speaker")
        assert lecture.outline() == [("First", [0, 1]), ("Second", [2])]
        one, two, three = lecture.steps
        assert [step.line for step in lecture.steps] == [10, 36, 39]
        assert one.scene.name == "ball"
        assert one.view.camera == Camera(eye=(0, 0, 5))
        assert one.views == ("outside", "camera")
        assert one.pixel == (1, 2)  # row 2, column 3
        assert one.highlight == ("eye", "outside")
        assert one.options["images"] == {"pixel_size": 8, "channel": "depth"}
        assert one.options["outside"]["bundle"] == (4, 4)
        assert one.options["outside"]["camera"] == Camera.look_at((5, 5, 5), (0, 0, 0))
        assert isinstance(one.exercise, RayExercise)
        assert (one.exercise.pixel, one.exercise.size) == ((0, 2), (4, 3))
        assert one.exercise.camera == one.view.camera
        assert isinstance(three.exercise, ChoiceExercise)
        assert [option.right for option in three.exercise.options] == [False, True]
        # What a step leaves out.
        assert two.views == ("raster",) and two.part == "First"
        assert two.pixel is None and two.exercise is None and not two.options
        assert two.scene.name == "still life" and two.view == two.scene.view

    def test_a_step_is_a_state_whatever_was_before(self):
        one, two, _ = read().steps
        before = AppState.for_scene(load_scene("columns"))
        before = before.with_options(
            preferences={"presentation": True}, mirrors=True, images={"exposure_ev": 2.0}
        )
        state = state_of(one, before)
        assert state.scene is one.scene and state.camera == one.view.camera
        assert state.images.pixel_size == 8 and state.images.channel == "depth"
        assert state.marked == (1, 2) and state.options.shadows
        assert not state.options.mirrors and state.images.exposure_ev == 0.0
        assert state.preferences.presentation  # the speaker's own
        assert state_of(one, state_of(two, before)) == state

    def test_a_lecture_counts_pixels_in_one_way(self):
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
                base = AppState.for_scene(step.scene).with_options(one_based=lecture is other)
                state = state_of(lecture.steps[number], base)
                assert state.options.one_based == (lecture is one)
        assert other.steps[0].exercise.indexing.text((1, 3)) == "(1, 3)"
        last = from_zero.replace("pixel = [1, 3]", "pixel = [2, 3]")
        assert read(last).steps[0].exercise.pixel == (2, 3)
        with_two = FILE.replace("author =", "pixels_from = 2\nauthor =")
        for text, told in (
            (last.replace("[2, 3]\nsize", "[3, 3]\nsize"), "4x3; give a row up to 2 and a"),
            (FILE.replace("[1, 3]", "[0, 3]"), "no pixel; give row and column, from 1"),
            (from_zero.replace("[1, 3]", "[-1, 3]"), "no pixel; give row and column, from 0"),
            (with_two, r"x\.toml:3: pixels_from: "),
            (FILE.replace("options.shadows = true", "options.one_based = false"),
             r"x\.toml:26: steps\[0\]\.options\.one_based: differs from pixels_from = 1; leave it"),
        ):  # fmt: skip
            with pytest.raises(LucidaError, match=told):
                read(text)

    def test_the_built_in_lecture_counts_from_one_and_says_so_first(self):
        lecture = load_lecture(BUILTIN)
        assert not any("one_based" in step.options for step in lecture.steps)
        first = next(step for step in lecture.steps if "(i, j)" in step.text)
        assert "from 1" in first.text

    def test_every_option_is_known_to_a_step(self):
        lines = [line for line in FILE.splitlines() if not line.startswith("options.")]
        for name in {entry.name for entry in fields(Options)} - set(ELSEWHERE):
            broken = "\n".join([*lines[:20], f"options.{name} = []", *lines[20:]])
            with pytest.raises(LucidaError, match=rf"x\.toml:21: steps\[0\]\.options\.{name}: "):
                read(broken)

    def test_scenes_and_views_beside_the_file(self, tmp_path):
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
            ("[4, 4]", "[4, 400]", 24, "options.outside.bundle[1]: 400 is out of range"),
            ("size = 8", "size = 7", 22, "options.images.pixel_size: 7 is not possible"),
            ("pixel_size = 8", "exposure_ev = 9", 22, "options.images.exposure_ev: 9 is out of"),
            ("pixel_size = 8", "resolution = [0, 1]", 22, "options.images.resolution: 0x1 has no"),
            ("pixel_size = 8", "exposure_ev = nan", 22, "options.images.exposure_ev: nan is out"),
            ("images.pixel_size = 8", "laboratory.apart = inf", 22, "laboratory.apart: inf is out"),
            ("images.pixel_size = 8", "laboratory.zoom_center = [0, nan]", 22,
             "options.laboratory.zoom_center[1]: nan is out of range; give 0 to 1"),
            ("images.pixel_size = 8", "stepper.canvas = [65, 12]", 22,
             "options.stepper.canvas[0]: 65 is out of range; give 1 to 64"),
            ("images.pixel_size = 8", "laboratory.zoom = 0", 22,
             "options.laboratory.zoom: 0 is out of range; give 1 to 32"),
            ("images.pixel_size = 8", "laboratory.side_px = 1000000", 22,
             "options.laboratory.side_px: 1000000 is out of range; give 3 to 300"),
             ("images.pixel_size = 8", "laboratory.cycle_s = 0", 22,
              "options.laboratory.cycle_s: 0 is out of range; give 1 to 60"),
            ("options.shadows", "options.preferences", 26, "options.preferences: is unknown"),
            ("[0, 0, 5]", "[0, 0]", 20, "camera.eye: has 2 entries; give 3"),
            ("[0, 0, 0]", "[5, 5, 5]", 25, "options.outside.camera.target: (5, 5, 5) is the eye"),
            ('"ball"', '"bal"', 19, "scene: 'bal' is unknown; did you mean 'ball'?"),
            ('"ball"', '"gone.toml"', 19, "scene: gone.toml: does not exist"),
            ("{ eye = [0, 0, 5] }", '"gone.toml"', 20, "camera: gone.toml: does not exist"),
            ('"outside", "', '"outsid", "', 21, "views[0]: 'outsid' is unknown; did you mean"),
            ('"outside", "', '"ray", "probe", "raster", "', 21, "views: names 3 besides 'camera'"),
            ('"outside", "camera"]', '"ray", "ray"]', 21, "views: names one twice"),
            ("[2, 3]", "[0, 3]", 27, "pixel: [0, 3] is no pixel; give row and column, from 1"),
            ("pixel_size = 8", "resolution = [2, 9]", 27, "pixel: [2, 3] is not in an image"),
            ('"eye", "', '"eyes", "', 28, "highlight[0]: 'eyes' is unknown; did you mean 'eye'?"),
            ('title = "One"', 'titel = "One"', 11, "titel: is unknown; did you mean 'title'?"),
            ('title = "Two"', "", 36, "title: is missing; give it"),
            ('title = "Two"', 'title = " "', 37, "title: is empty"),
            ("$u = 1$", "$u = 1", 15, "text: a formula does not end"),
            ("$u = 1$", "$\\\\frac{1}{2$", 15, "text: the braces of "),
            ("- one", "```", 17, "text: the code does not end"),
            ("[4, 3]", "[2, 3]", 33, "exercise.pixel: [1, 3] is not in an image of 2x3"),
            ('"Which ray?"', '""', 32, "exercise.question: is empty"),
            ('kind = "ray"', 'kind = "rya"', 31, "exercise.kind: 'rya' is unknown; did you"),
            (", right = true", "", 44, "exercise.options: has 0 right ones"),
            ('"that", ', '"$that", ', 46, "exercise.options[1].text: a formula does not end"),
            ('"sphere"', '"sphre"', 7, "objects[0].type: 'sphre' is unknown; did you mean"),
            ("scenes.ball", "scenes.spheres", 5, "scenes.spheres: is the name of a built-in"),
        ],
    )  # fmt: skip
    def test_mistakes_name_file_line_and_field(self, old, new, line, told):
        assert old in FILE
        with pytest.raises(LucidaError) as error:
            read(FILE.replace(old, new, 1))
        assert str(error.value).startswith(f"x.toml:{line}: "), error.value
        assert told in str(error.value)

    def test_mistakes_of_the_whole(self, tmp_path):
        for text, told in (
            ('title = "x"\nsteps = []', "x.toml:2: steps: holds 0 steps"),
            ('title = "x"', "x.toml:1: steps: is missing"),
            ('title = "x"\nsteps = [1]', r"x.toml:2: steps[0]: is a whole number; give a table"),
            ('title = ""\n[[steps]]\ntitle = "x"', "x.toml:1: title: is empty"),
            ("title = ", "x.toml:1: column 9: invalid value"),
            ("\nlucida = 2", "x.toml:2: lucida: the file is of version 2"),
        ):
            with pytest.raises(LucidaError) as error:
                read(text)
            assert str(error.value).startswith(told)
        with pytest.raises(LucidaError, match="does not exist"):
            load_lecture(tmp_path / "none.toml")

    def test_text_that_is_not_utf8_names_its_line(self, tmp_path):
        path = tmp_path / "latin.toml"
        path.write_bytes('title = "a"\n# \xe9\n'.encode("latin-1"))
        with pytest.raises(LucidaError) as error:
            load_lecture(path)
        assert str(error.value).startswith(f"{path}:2: is not text in UTF-8")


class TestPlaces:
    def test_every_form_of_toml(self):
        text = (
            "a = 1 # [x]\n"  # 1
            "'b c'.d = { e = [1, { f = 2 }], g = '}' }\n"  # 2
            "\n"
            "[t] # comment\n"  # 4
            'x."y".z = "# not a comment ] ["\n'  # 5
            "list = [\n  1, # one\n  [2,\n   3],\n]\n"  # 6 to 10
            'long = """\nfirst\n\\"""\nlast"""\n'  # 11 to 14
            "same = '''one\ntwo'''\n"  # 15, 16
            "[[t.many]]\nk = 1\n"  # 17
            "[[t.many]]\n"  # 19
            "[t.many.in]\nk = 2\n"  # 20
            "[[t.many.in.deep]]\n[[t.many.in.deep]]\nlast = 1979-05-27T07:32:00Z\n"  # 22, 23
        )
        places = Places(text)
        lines = {
            "a": 1, "b c": 2, "b c.d": 2, "b c.d.e[1].f": 2, "b c.d.g": 2, "t": 4, "t.x.y.z": 5,
            "t.list": 6, "t.list[0]": 7, "t.list[1]": 8, "t.list[1][1]": 9, "t.long": 12,
            "t.same": 15, "t.many[0]": 17, "t.many[0].k": 18, "t.many[1]": 19, "t.many[1].in": 20,
            "t.many[1].in.k": 21, "t.many[1].in.deep[1]": 23, "t.many[1].in.deep[1].last": 24,
        }  # fmt: skip
        assert {field: places.line(field) for field in lines} == lines
        # What is not there is where it should be.
        assert places.line("t.many[1].in.missing") == 20
        assert places.line("nothing") == 1

    def test_nothing_between_signs(self):
        """Or all that may be: spaces about names, commas after the last, comments."""
        text = (
            "[t]#k = 9\n"  # 1
            "t=1\n"
            "k=[[1]]\n"  # 3
            "m=[1,2,\n3]\n"  # 4, 5
            "n={}\n"
            'o="""\n\nx"""\n'  # 7 to 9
            "p={a={},b={c=1}}\n"
            "r=[{a=1},\n{b=[\n1]},\n{}]\n"  # 11 to 14
            "[[u.v]]#k = 9\n"
            "k=1\n"  # 16
            "[ v . w ] #\n"
            " x . y\t= [ # ]\n 1 , # ,\n 2 , ]\n"  # 18 to 20
            "z = 1\n"
        )
        places = Places(text)
        lines = {
            "t": 1, "t.t": 2, "t.k": 3, "t.k[0][0]": 3, "t.m[1]": 4, "t.m[2]": 5, "t.n": 6,
            "t.o": 8, "t.p.b.c": 10, "t.r[0].a": 11, "t.r[1]": 12, "t.r[1].b": 12,
            "t.r[1].b[0]": 13, "t.r[2]": 14, "u.v[0]": 15, "u.v[0].k": 16,
            "v.w": 17, "v.w.x": 18, "v.w.x.y": 18, "v.w.x.y[0]": 19, "v.w.x.y[1]": 20, "v.w.z": 21,
        }  # fmt: skip
        assert {field: places.line(field) for field in lines} == lines
        # A table and an array of tables begin where the first of them does.
        assert places.line("u") == places.line("u.v") == 15

    def test_paths(self):
        assert parsed_path("steps[3].camera.w") == ("steps", 3, "camera", "w")
        assert parsed_path("") == ()

    @pytest.mark.parametrize(
        "text",
        ["a = [1", "[[", '"', "{", "a = {", "= = =", "'''", "a.b.c", "a = [}", "a = {]", "a = [{"],
    )
    def test_what_is_no_toml_ends_too(self, text):
        assert Places(text).line("a") >= 1


class TestText:
    def test_blocks(self):
        blocks = texts.parse(
            "# One\n\nA *slanted* **bold $x$** `code`\ngoes on.\n> Why\n> so?\n"
            "- a\n- b\n  c\n\n1. x\n2. y\n\n$$\na\nb\n$$\n$$ c $$\n```python\n  x = $1\n```\n"
        )
        words = texts.Words
        assert blocks == (
            texts.Heading(1, (words("One"),)),
            texts.Paragraph(
                (
                    words("A "),
                    words("slanted", italic=True),
                    words(" "),
                    words("bold ", bold=True),
                    texts.Math("x"),
                    words(" "),
                    words("code", code=True),
                    words(" goes on."),
                )
            ),
            texts.Question((words("Why so?"),)),
            texts.ItemList(((words("a"),), (words("b c"),))),
            texts.ItemList(((words("x"),), (words("y"),)), numbered=True),
            texts.DisplayedFormula("a\nb"),
            texts.DisplayedFormula("c"),
            texts.Code("  x = $1", "python"),
        )
        assert texts.formulas(blocks) == ("x", "a\nb", "c")
        assert "slanted" in plain_text(blocks) and "*" not in plain_text(blocks)

    @pytest.mark.parametrize(
        ("text", "line"),
        [
            ("*a* b", (texts.Words("a", italic=True), texts.Words(" b"))),
            ("-5 is", (texts.Words("-5 is"),)),
            ("2. ", (texts.Words("2."),)),
            (r"a\$", (texts.Words("a$"),)),
            (r"a\*b", (texts.Words("a*b"),)),
            (r"$x$$y$ a\#", (texts.Math("x"), texts.Math("y"), texts.Words(" a#"))),
            (r"**a\*** b", (texts.Words("a*", bold=True), texts.Words(" b"))),
            (r"${\{}{a}$", (texts.Math(r"{\{}{a}"),)),
        ],
    )
    def test_neighbours_of_one_style_are_one(self, text, line):
        assert texts.parse(text) == (texts.Paragraph(line),)

    def test_blocks_that_follow_each_other_at_once(self):
        words = texts.Words
        assert texts.parse("```\na\n```\nb\n$$x$$\n$$\ny$$\nc") == (
            texts.Code("a"),
            texts.Paragraph((words("b"),)),
            texts.DisplayedFormula("x"),
            texts.DisplayedFormula("y"),
            texts.Paragraph((words("c"),)),
        )
        assert texts.parse("- a\n  b\n  c\n- d\n  e") == (
            texts.ItemList(((words("a b c"),), (words("d e"),))),
        )

    def test_of_what_a_text_consists(self):
        text = "# $x$ head\n\n- one *two*\n- three\n\n```\na\nb\n```\n$$y$$\n> who $z$?\n\nso"
        blocks = texts.parse(text)
        assert texts.pieces(blocks) == 2 + 3 + 1 + 1 + 3 + 1
        assert texts.formulas(blocks) == ("x", "y", "z")
        assert texts.pieces(()) == 0

    def test_a_program_in_one_of_its_languages(self):
        def fenced(*names):
            return "".join(f"```{name}\n{name} {k}\n```\n" for k, name in enumerate(names))

        def shown(text, language):
            return [block.text for block in texts.in_language(texts.parse(text), language)]

        text = fenced("python", "c", "julia", "toml", "c", "julia")
        assert shown(text, "c") == ["c 1", "toml 3", "c 4"]
        assert shown(text, "julia") == ["julia 2", "toml 3", "julia 5"]
        assert shown(text, "python") == ["python 0", "toml 3", "c 4"]  # or else the first
        assert shown(fenced("toml", "toml"), "c") == ["toml 0", "toml 1"]
        assert texts.languages(texts.parse(text)) == ("python", "c", "julia")
        assert texts.languages(texts.parse(fenced("c", "toml", "c"))) == ()
        assert texts.languages(texts.parse(fenced("c", "toml", "julia"))) == ("c", "julia")

    def test_how_long_a_text_may_be(self):
        assert texts.parse("a" * texts.LETTERS)
        with pytest.raises(texts.TextError, match="is a text of 50001 characters"):
            texts.parse("a" * (texts.LETTERS + 1))

    def test_signs_that_mean_themselves(self):
        (paragraph,) = texts.parse(r"\$5 and 3 * 4 * 5 and \*, `a*b*c`")
        assert words_of(paragraph.line) == "$5 and 3 * 4 * 5 and *, a*b*c"

    @pytest.mark.parametrize(
        ("text", "line"), [("a\n\n$x", 2), ("a\n$$\nb", 1), ("x\n\n```\ny", 2), ("- a\n- $", 1)]
    )
    def test_mistakes_have_a_line(self, text, line):
        with pytest.raises(texts.TextError) as error:
            texts.parse(text)
        assert error.value.line == line

    @pytest.mark.parametrize(
        ("text", "line", "told"),
        [
            (
                "so $$x$$ is",
                0,
                "$$ stands within a line; give it lines of its own, or write $ ... $",
            ),
            ("a\n\n- so **$$x$$**", 2, "$$ stands within a line"),
            ("a\n$$x$$ is", 1, "text follows a displayed formula's $$; begin a new line after it"),
            ("$$\nx\n$$ is", 2, "text follows a displayed formula's $$"),
            ("$$$$ is", 0, "text follows a displayed formula's $$"),
            ("$$", 0, "the formula does not end; close it by $$"),
            ("a\n$}{$", 0, "the braces of '}{' do not match"),
            ("${a{b}$", 0, "the braces of '{a{b}' do not match"),
        ],
    )
    def test_a_displayed_formula_within_a_line_is_told_the_remedy(self, text, line, told):
        with pytest.raises(texts.TextError) as error:
            texts.parse(text)
        assert told in str(error.value)
        assert error.value.line == line


def test_what_is_pointed_out_is_looked_for_once():
    highlight = "highlight = ['eye'" + ", 'u', 'eye'" * 1000 + "]\n"
    lecture = read("title = 'L'\n[[steps]]\ntitle = 'A'\n" + highlight)
    assert lecture.steps[0].highlight == ("eye", "u")


class TestWatching:
    def test_a_change_is_told_once_it_rests(self, tmp_path):
        path = tmp_path / "x"
        path.write_text("a")
        watch = FilesWatch({path: stamp(path)})
        assert not watch.changed(0.0)
        path.write_text("ab")
        assert not watch.changed(1.0) and watch.waiting
        path.write_text("abc")
        assert not watch.changed(1.3)  # still being written
        assert watch.changed(1.6)
        assert not watch.changed(2.0) and not watch.waiting

    def test_a_file_that_is_replaced(self, tmp_path):
        path, other = tmp_path / "x", tmp_path / "y"
        path.write_text("a")
        other.write_text("other")
        old, watch = tmp_path / "old", FilesWatch({path: stamp(path)})
        path.rename(old)
        assert not watch.changed(1.0) and not watch.waiting
        other.rename(path)
        assert not watch.changed(1.3)
        assert watch.changed(1.6)
        # Changed and changed back before it rested: nothing to do.
        path.rename(other)
        old.rename(path)
        assert not watch.changed(2.0) and watch.waiting
        path.rename(old)
        other.rename(path)
        assert not watch.changed(2.3) and not watch.waiting
        assert not watch.changed(2.6)

    def test_one_of_several_files_and_one_that_comes(self, tmp_path):
        there, missing = tmp_path / "there", tmp_path / "missing"
        there.write_text("a")
        watch = FilesWatch({there: stamp(there), missing: None})
        assert not watch.changed(1.0) and not watch.waiting
        there.write_text("ab")
        assert not watch.changed(2.0)
        assert watch.changed(2.3)
        missing.write_text("now it is there")
        assert not watch.changed(3.0)
        assert watch.changed(3.3)
        missing.unlink()
        there.write_text("abc")  # whatever else is away
        assert not watch.changed(4.0)
        assert watch.changed(4.3)

    def test_a_lecture_s_scene_that_is_saved_while_it_is_read(self, tmp_path, monkeypatch):
        path, scene = tmp_path / "l.toml", tmp_path / "s.toml"
        path.write_text('title = "L"\n[[steps]]\ntitle = "A"\nscene = "s.toml"\n')
        scene.write_text("[[objects]]\ntype = 'sphere'\n")
        load = reading.load_scene

        def slow(source):
            found = load(source)
            scene.write_text("[[objects]]\ntype = 'sphere'\nradius = 2\n")
            return found

        monkeypatch.setattr(reading, "load_scene", slow)
        session = LectureSession(load_lecture(path), path)
        assert not session.watch.changed(1.0)
        assert session.watch.changed(2.0)

    def test_going_on_in_a_newer_version(self):
        old = read()
        titles = [f'[[steps]]\ntitle = "{name}"\n' for name in ("Zero", "One", "New", "Three")]
        newer = read('title = "x"\n' + "".join(titles))
        assert old.followed(0, newer) == 1
        assert old.followed(2, newer) == 3
        assert old.followed(1, newer) == 1  # "Two" is gone: the same number
        assert newer.followed(3, read('title = "x"\n[[steps]]\ntitle = "Only"')) == 0


class TestTheBuiltInLecture:
    lecture = load_lecture(BUILTIN)

    def test_it_covers_the_lecture_in_its_order(self):
        parts = [part for part, _ in self.lecture.outline()]
        assert parts == [
            "Rendering",
            "What is an image?",
            "Representations",
            "Two algorithms",
            "Losing a dimension",
            "Rays",
            "The camera",
            "One camera, two renderers",
        ]
        titles = [step.title for step in self.lecture.steps]
        order = [
            "What is an image?", "Kinds of raster image", "Object order: rasterization",
            "The camera conundrum", "Perspective projection", "Parallel projection",
            "A ray is half a line", "A simple camera", "From pixel to ray", "Any camera",
            "The program", "One camera, two renderers",
        ]  # fmt: skip
        assert [title for title in titles if title in order] == order
        assert 20 <= len(titles) == len(set(titles))

    def test_it_fits_a_slide(self):
        for step, language in itertools.product(self.lecture.steps, LANGUAGES):
            shown = texts.in_language(step.blocks, language)
            words = len(re.findall(r"\w+", plain_text(shown)))
            assert 5 <= words <= 85, (step.title, language, words)

    def test_every_kind_of_exercise_is_in_it(self):
        kinds = {type(step.exercise) for step in self.lecture.steps} - {type(None)}
        assert kinds == {RayExercise, VectorExercise, ChoiceExercise}

    def test_marked_pixels_are_in_their_images(self):
        marked = [step for step in self.lecture.steps if step.pixel]
        assert len(marked) > 5
        for step in marked:
            width, height = step.options["images"]["resolution"]
            assert step.pixel[0] < height and step.pixel[1] < width, step.title

    def test_what_is_shown_worked_out_hits_something(self):
        step = next(step for step in self.lecture.steps if "probe" in step.views)
        assert step.pixel is not None
        size = step.options["images"]["resolution"]
        reading = Probe(step.scene).at(step.pixel, step.view.camera, size)
        assert sum(meeting.is_on_ray for meeting in reading.meetings) >= 2

    def test_u_and_v_exchanged_are_told_as_such(self):
        for step in self.lecture.steps:
            if isinstance(step.exercise, RayExercise):
                camera, pixel, size = step.exercise.camera, step.pixel, step.exercise.size
                assert pixel == step.exercise.pixel
                x, y = camera.image_point(*pixel, size)
                way = y * np.array(camera.u) + x * np.array(camera.v)
                way -= camera.distance * np.array(camera.w)
                given = {"origin": str(camera.eye), "direction": " ".join(map(str, way))}
                assert "exchanged" in step.exercise.check(given).text, step.title

    def test_rays_that_are_asked_for_are_the_ones_shown(self):
        for step in self.lecture.steps:
            if isinstance(step.exercise, RayExercise):
                assert step.pixel == step.exercise.pixel
                assert step.options["images"]["resolution"] == step.exercise.size
                assert step.view.for_size(step.exercise.size) == step.exercise.camera


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
        "x.toml:9: steps[0].exercise.answers[0].wrong[0].feedback: a formula does not end"
    )


@given(st.text(alphabet="$*`\\\\a1.,()[]{}_^#>-", min_size=1, max_size=12))
def test_an_escaped_text_is_shown_as_it_stands(typed):
    (block,) = texts.parse("typed: " + texts.escaped(typed))
    assert words_of(block.line) == ("typed: " + typed)


def test_in_a_newer_lecture_the_nearest_step_of_that_title_is_shown():
    steps = tuple(SimpleNamespace(title=title) for title in "abaca")
    found = [Lecture.nearest(SimpleNamespace(steps=steps), "a", k) for k in range(-2, 9)]
    assert found == [0, 0, 0, 0, 2, 2, 4, 4, 4, 4, 4]
    # Where there is none, the same number, as far as there are steps.
    found = [Lecture.nearest(SimpleNamespace(steps=steps), "gone", k) for k in range(-2, 9)]
    assert found == [0, 0, 0, 1, 2, 3, 4, 4, 4, 4, 4]
