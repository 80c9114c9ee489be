"""Task files: what they say, and what is said of mistakes in them."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.checking.cases import shots
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_file import BUILTIN, load_tasks
from lucida.renderer.system.errors import LucidaError

RAYS = '[[tasks]]\nkind = "viewing-ray"\n'


def load(folder, text):
    path = folder / "hw.toml"
    path.write_text(text, "utf-8")
    return load_tasks(path)


def test_a_task_without_more_is_the_built_in_one(tmp_path):
    for built_in in BUILTIN[:1] + BUILTIN[2:-1]:
        task = load(tmp_path, f'[[tasks]]\nkind = "{built_in.kind}"\npoints = {built_in.points}')
        assert task.tasks == (built_in,)


def test_all_that_a_file_can_say(tmp_path):
    found = load(
        tmp_path,
        """
        title = "Homework 2"
        seed = 5
        feedback = "verdict"
        seconds = 3
        memory_mb = 256
        network = false
        [conventions]
        pixels_from = 1
        rows = "bottom"
        axes = { x = "left", z = "forward" }
        vectors = "column"
        unit = true
        origin = "exact"
        camera = { pos = "eye", c2w = "camera_to_world", wide = "viewport_width" }
        [[tasks]]
        kind = "viewing-ray"
        name = "rays"
        function = "generate_ray"
        text = "Write it."
        points = 2.5
        arguments = { x = "x01", y = "y01", camera = "camera" }
        returns = ["direction", "origin"]
        vectorised = true
        projection = "parallel"
        cameras = ["moved", "turned"]
        views = []
        size = [12, 8]
        cases = 7
        seed = 6
        feedback = "first-wrong"
        [[tasks]]
        kind = "to-gray"
        weights = [0.299, 0.587, 0.114]
        [[tasks]]
        kind = "closest-hit"
        pixels_from = 0
        """,
    )
    ignored = ("vectors", "origin", "vectorised", "views")
    assert [note.partition(" is ignored")[0] for note in found.notes[:-2]] == [*ignored]
    assert found.notes[-2].startswith("network = false is not enforced")
    assert found.notes[-1] == "tasks[1]: to-gray is no longer checked; see CHANGELOG.md"
    assert (found.limits.seconds, found.limits.memory_mb) == (3.0, 256)
    rays, closest = found.tasks
    says = rays.conventions
    assert (rays.name, rays.function, rays.points, rays.text) == (
        "rays", "generate_ray", 2.5, "Write it.",
    )  # fmt: skip
    assert says.arguments == (("x", "x01"), ("y", "y01"), ("camera", "camera"))
    assert says.camera[:2] == (("pos", "eye"), ("c2w", "camera_to_world"))
    assert (says.base, says.rows, says.axes) == (1, "bottom", (-1, 1, -1))
    assert says.unit and says.space == "world"
    assert says.returns == ("direction", "origin")
    assert rays.projection == "parallel" and rays.cameras == ("moved", "turned")
    assert (rays.size, rays.count, rays.seed) == ((12, 8), 7, 6)
    assert rays.feedback == "first-wrong" and closest.feedback == "verdict" and closest.seed == 5
    assert len(list(shots(rays))) == 7
    assert closest.conventions.base == 0


def test_the_built_in_text_is_not_told_where_it_is_not_true(tmp_path):
    text = '[[tasks]]\nkind = "hit-sphere"\narguments = ["ray", "sphere"]\n'
    sphere, rays = load(tmp_path, text + RAYS + 'returns = ["direction"]\n').tasks
    assert sphere.text == "See the course's own text. Give a number t, or None."
    assert rays.text == "See the course's own text. Give direction."


def test_what_such_tasks_ask(tmp_path):
    text = '[[tasks]]\nkind = "basis"\narguments = ["eye", "forward", "up"]\n'
    (task,) = load(tmp_path, text + 'returns = ["forward", "left"]').tasks
    kind = KINDS["basis"]
    cases = kind.cases(task)
    answers = [[case.values["forward"], (-case.right[0]).tolist()] for case in cases]
    given, problems = kind.given(task, cases, answers)
    assert not problems and not kind.wrong(task, cases, given).any()
    assert kind.answer_text(task, cases[0], cases[0].right).startswith("forward (0, 0, -1), left (")
    answers[0][1] = [-x for x in answers[0][1]]
    given, _ = kind.given(task, cases, answers)
    assert np.flatnonzero(kind.wrong(task, cases, given)).tolist() == [0]


MISTAKES = {
    'kind = "rays"': (6, "tasks[1].kind", "'rays' is unknown"),
    'function = "a b"': (7, "tasks[1].function", "'a b' is no name"),
    'arguments = ["i", "k"]': (7, "tasks[1].arguments[1]", "'k' is unknown"),
    "arguments = []": (7, "tasks[1].arguments", "no word for the pixel"),
    'arguments = ["camera"]': (7, "tasks[1].arguments", "no word for the pixel"),
    'camera = { fov = "fov" }': (7, "tasks[1].camera.fov", "'fov' is unknown"),
    'returns = ["origin", "way"]': (7, "tasks[1].returns[1]", "'way' is unknown"),
    'cameras = ["turnd"]': (7, "tasks[1].cameras[0]", "did you mean 'turned'"),
    "cameras = []": (7, "tasks[1].cameras", "of length >= 1"),
    "cases = 0": (7, "tasks[1].cases", ">= 1"),
    "size = [500, 500]": (7, "tasks[1].size", "500000"),
    'name = "first"': (7, "tasks[1].name", "'first' is there already"),
    'arguments = ["i", "j", "fov_y"]\ncameras = ["skewed"]': (8, "tasks[1].cameras[0]", "skewed"),
    'arguments = ["i", "j", "fov_y"]\nprojection = "parallel"': (
        8, "tasks[1].projection", "has no fov_y",
    ),
}  # fmt: skip


@pytest.mark.parametrize("line", MISTAKES)
def test_mistakes_name_file_line_and_field(tmp_path, line):
    number, field, words = MISTAKES[line]
    kind = line if line.startswith("kind") else f'kind = "viewing-ray"\n{line}'
    text = f'[[tasks]]\nkind = "viewing-ray"\nname = "first"\n\n[[tasks]]\n{kind}\n'
    with pytest.raises(LucidaError) as told:
        load(tmp_path, text)
    assert str(told.value).startswith(f"{tmp_path / 'hw.toml'}:{number}: {field}: ")
    assert words in str(told.value) and told.value.remedy


OTHERS = {
    "tasks = []": ("1: tasks", "of length >= 1"),
    "tasks = 3": ("1: tasks", "give a list"),
    "seconds = 0\n" + RAYS: ("1: seconds", "expected a number > 0"),
    '[conventions]\ncamera = { a = "b" }\n' + RAYS: ("2: conventions.camera.a", "unknown"),
    '[[tasks]]\nkind = "basis"\ncameras = ["turned"]': ("3: tasks[0].cameras", "no cameras"),
    '[[tasks]]\nkind = "basis"\nsize = [3, 4]': ("3: tasks[0].size", "no cameras"),
    '[[tasks]]\nkind = "hit-sphere"\nreturns = ["t"]': ("3: tasks[0].returns", "leave it out"),
    '[[tasks]]\nkind = "closest-hit"\nreturns = ["t"]': (
        "3: tasks[0].returns",
        "leaves something out",
    ),
    "lucida = 9": ("1: lucida", "version 9"),
}


@pytest.mark.parametrize("text", OTHERS)
def test_mistakes_in_the_rest_of_the_file(tmp_path, text):
    where, words = OTHERS[text]
    with pytest.raises(LucidaError) as told:
        load(tmp_path, text)
    assert str(told.value).startswith(f"{tmp_path / 'hw.toml'}:{where}")
    assert words in str(told.value)


@pytest.mark.parametrize("more", ['vectors = "row"', 'views = ["spheres"]', 'projection = "both"'])
def test_values_of_older_files_that_made_another_task_are_refused(tmp_path, more):
    with pytest.raises(LucidaError) as told:
        load(tmp_path, RAYS + more)
    assert told.value.field == f"tasks[0].{more.split()[0]}" and told.value.remedy
