"""The limits of a lecture file, each at its border, and what is refused beyond."""

from pathlib import Path

import pytest

from lucida.app.lecture import reading
from lucida.app.lecture.exercises import ChoiceExercise, VectorExercise
from lucida.app.lecture.reading import is_lecture, lecture_from_toml, load_lecture
from lucida.renderer.files.outside import OutsideError
from lucida.renderer.system.errors import LucidaError

STEP = "[[steps]]\ntitle = 'T'\n"
OPTION = "{ text = 'a', feedback = 'b' }, "
BOX = "objects = [{ type = 'box' }]\n"  # of 12 triangles


def read(text, folder=Path()):
    return lecture_from_toml(f"title = 'L'\n{text}", folder, "x.toml")


def exercise(kind, more):
    return STEP + f"[steps.exercise]\nkind = '{kind}'\nquestion = 'Which?'\n{more}"


def choice(count):
    options = (count - 1) * OPTION + "{ text = 'c', feedback = 'd', right = true }"
    return exercise("choice", f"options = [{options}]")


def vectors(*names, wrong=0, more=""):
    known = wrong * "{ value = [0, 0, 1], feedback = 'No.' },"
    rows = (f"{{ name = '{name}', value = [1, 2, 3], wrong = [{known}] }}" for name in names)
    return exercise("vector", f"answers = [{', '.join(rows)}]\n{more}")


def told(text, folder=Path()):
    """Return what is wrong with a text, without file and line; empty: nothing."""
    try:
        read(text, folder)
    except LucidaError as error:
        return str(error).removeprefix(f"{error.source}: ")
    return ""


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (STEP, True),
        ("title = 'none yet'\n[scenes.a]\n", True),
        ("[[steps]\n[[steps]]", True),
        ("name = 'x'\n[[objects]]\ntype = 'sphere'", False),
        ("steps = 1\n[[objects]]\ntype = 'sphere'", False),
        ("[camera]\neye = [0, 0, 1]", False),
        ("[[objects]\n", False),
        ("", False),
    ],
)
def test_a_lecture_is_known_by_its_keys(text, meant, tmp_path):
    path = tmp_path / "x.TOML"
    path.write_text(text)
    assert is_lecture(path) is meant
    other = path.rename(tmp_path / "x.txt")
    assert is_lecture(other) is False
    assert is_lecture(tmp_path / "nowhere.toml") is False
    assert not is_lecture(tmp_path)


def test_how_many_steps_and_scenes(monkeypatch):
    monkeypatch.setattr(reading, "STEPS", 3)
    scenes = "".join(f"[scenes.s{number}]\n{BOX}" for number in range(4))
    assert len(read(scenes.split("[scenes.s3]")[0] + 3 * STEP).steps) == 3
    assert told(4 * STEP) == "steps: holds 4 steps; give 1 to 3"
    assert told(scenes + STEP) == "scenes: holds 4; give at most 3"
    assert told("steps = []") == "steps: holds 0 steps; give 1 to 3"


def test_how_much_all_steps_and_all_scenes_hold(monkeypatch):
    monkeypatch.setattr(reading, "PIECES", 6)
    three = STEP + "text = 'a *b* c'\n"
    assert len(read(three + three).steps) == 2
    assert told(three + three + STEP + "text = 'a'") == (
        "steps[2]: brings the lecture to more than 6 formulas and runs of words;"
        " divide it into several lectures"
    )
    monkeypatch.setattr(reading, "TRIANGLES", 24)
    scenes = [f"[scenes.s{number}]\n{BOX}" for number in range(3)]
    step = STEP + "scene = 's0'\n"
    assert read(scenes[0] + scenes[1] + step)
    assert told("".join(scenes) + step) == (
        "scenes.s2: brings the lecture's scenes to more than 24 triangles;"
        " divide it into several lectures"
    )
    assert told("[scenes]\ns = 1\n" + STEP) == "scenes.s: is not a table; write it as [scenes.s]"
    assert told("[scenes.s]\nobjects = 1\n" + STEP) == (
        "scenes.s.objects: is a whole number; give a list"
    )
    assert "objects[0]: is a whole number" in told("[scenes.s]\nobjects = [1]\n" + STEP)


def test_titles_stay_within_their_length():
    longest = "a" * 300
    assert read(f"[[steps]]\ntitle = '{longest}'\npart = '{longest}'\n").steps[0].part == longest
    for field in ("title", "part"):
        text = STEP.replace("'T'", f"'{longest}a'") if field == "title" else STEP
        text += f"part = '{longest}a'\n" if field == "part" else ""
        assert told(text) == f"steps[0].{field}: is 301 characters long; stay within 300"
    assert told(STEP + "part = ' '") == "steps[0].part: is empty; give the part's title"


@pytest.mark.parametrize("frames", range(2))
def test_nested_arrays_of_any_depth(frames):
    """One of them may just be read as TOML, and its lines just not be found any more: that
    depends on how deep the calls are already."""

    def answer(text, deeper):
        return answer(text, deeper - 1) if deeper else told(text)

    depths = (1, *range(400, 500), 100_000)
    answers = [answer("a = " + "[" * depth + "]" * depth, frames) for depth in depths]
    few = "a: is unknown; give one of title, author, pixels_from, scenes, steps"
    many = "is nested too deeply; write it with fewer brackets"
    assert sorted(answers) == answers and set(answers) == {few, many}


def test_a_choice_has_two_to_eight_options():
    found = read(choice(8)).steps[0].exercise
    assert isinstance(found, ChoiceExercise) and len(found.options) == 8
    assert len(read(choice(2)).steps[0].exercise.options) == 2
    where = "steps[0].exercise"
    assert told(choice(9)) == f"{where}.options: holds 9; give at most 8"
    assert told(choice(1)) == f"{where}.options: holds 1; give at least two"
    text = choice(2).replace("feedback = 'b'", "feedback = '$b'")
    assert told(text).startswith(f"{where}.options[0].feedback: a formula does not end")
    text = choice(2).replace("Which?", "$Which?")
    assert told(text).startswith(f"{where}.question: a formula does not end")


def test_an_exercise_has_one_to_eight_vectors_with_names_of_their_own():
    found = read(vectors("u", "v", wrong=32, more="tolerance = 0.1")).steps[0].exercise
    assert isinstance(found, VectorExercise) and found.tolerance == 0.1
    assert [(one.name, one.value, len(one.wrong)) for one in found.answers] == [
        ("u", (1, 2, 3), 32),
        ("v", (1, 2, 3), 32),
    ]
    assert len(read(vectors(*"abcdefgh")).steps[0].exercise.answers) == 8
    where = "steps[0].exercise"
    assert told(vectors()) == f"{where}.answers: is empty; give at least one vector"
    assert told(vectors(*"abcdefghi")) == f"{where}.answers: holds 9; give at most 8"
    assert told(vectors("u", wrong=33)) == f"{where}.answers[0].wrong: holds 33; give at most 32"
    assert told(vectors(*"uvu")) == (
        f"{where}.answers[2].name: 'u' is there already; give another name"
    )
    for value in ("0", "-0.1", "0.101", "nan"):
        assert told(vectors("u", more=f"tolerance = {value}")).startswith(
            f"{where}.tolerance: {value} is out of range; give up to 0.1"
        )
    assert read(vectors("u", more="tolerance = 1e-9")).steps[0].exercise.tolerance == 1e-9


def test_every_text_of_a_step_has_its_formulas_in_their_lines():
    """Lines 4 and on of a file; the same formula twice is two, also at a text's beginning."""
    text = '''\
lucida = 1
title = "L"
[[steps]]
title = "A"
text = """
$x$ and

then $x$, but not $y + z$

$$
w
$$"""
[steps.exercise]
kind = "choice"
question = "Why $q$?"
options = [
    { text = "$a$", feedback = "No $b$." },
    { text = "c", feedback = "Yes $d$.", right = true },
]
[[steps]]
title = "B"
[steps.exercise]
kind = "vector"
question = "Which $u$?"
[[steps.exercise.answers]]
name = "v"
value = [1, 2, 3]
[[steps.exercise.answers]]
name = "w"
value = [1, 2, 3]
wrong = [
    { value = [0, 0, 1], feedback = "No." },
    { value = [0, 1, 0], feedback = "Not $e$." },
]
'''
    formulas = lecture_from_toml(text, Path(), "x.toml").formulas
    assert {entry.source for entry in formulas} == {"x.toml"}
    assert [(entry.field, entry.latex, entry.line) for entry in formulas] == [
        ("steps[0].text", "x", 6),
        ("steps[0].text", "x", 8),
        ("steps[0].text", "y + z", 8),
        ("steps[0].text", "w", 11),
        ("steps[0].exercise.question", "q", 15),
        ("steps[0].exercise.options[0].text", "a", 16),
        ("steps[0].exercise.options[0].feedback", "b", 16),
        ("steps[0].exercise.options[1].feedback", "d", 16),
        ("steps[1].exercise.question", "u", 24),
        ("steps[1].exercise.answers[1].wrong[1].feedback", "e", 31),
    ]


def test_files_elsewhere_are_named_whatever_names_them(tmp_path):
    """Models of a lecture's own scenes, scenes, views: before any is read."""
    inside = tmp_path / "inside"
    inside.mkdir()
    path = inside / "x.toml"

    def outside(text):
        path.write_text(f"title = 'L'\n{text}")
        try:
            load_lecture(path)
        except OutsideError as error:
            return [file.name for file in error.files]
        except LucidaError:
            return []
        return []

    model = "objects = [{ type = 'model', file = '../m.obj' }]\n"
    assert outside(f"[scenes.s]\n{model}{STEP}scene = '../s.toml'\ncamera = '../c.toml'\n") == [
        "m.obj",
        "s.toml",
        "c.toml",
    ]
    # A name of a scene is no file, wherever it would lead; nor is a table.
    assert outside(f"[scenes.'../s.toml']\n{BOX}{STEP}scene = '../s.toml'\n") == []
    assert outside(f"{STEP}scene = 'spheres'\ncamera = {{ eye = [0, 0, 5] }}\n") == []
    assert outside("steps = [1]\n") == []


def test_mistakes_of_the_text_itself_name_their_place(tmp_path):
    path = tmp_path / "x.toml"
    path.write_text("a = " + 5000 * "9")
    with pytest.raises(LucidaError) as caught:
        load_lecture(path)
    assert str(caught.value) == f"{path}: holds a number of too many digits; shorten it"
    path.write_bytes(b"a = 1\x00")
    with pytest.raises(LucidaError) as caught:
        load_lecture(path)
    assert str(caught.value).startswith(f"{path}:1: ")
