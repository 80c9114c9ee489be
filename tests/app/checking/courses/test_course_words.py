"""The table of wrong lines in the words of courses: right lines are right, wrong ones are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.checking.checked import check
from lucida.app.checking.conventions import Conventions
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.mistakes.rays import WORDS, ray_program, ray_task
from lucida.app.checking.mistakes.trials import RayTrial, candidates
from lucida.app.checking.reports import told
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import BUILTIN, load_tasks
from lucida.app.checking.tasks import CheckCase, CheckTask

TASKS = [
    pytest.param(task, id=f"{name}: {task.name}")
    for name in course_names()
    for task in load_tasks(task_path(name)).tasks
    if task.kind == "viewing-ray"
]
CAMERAS = 50
RAYS = 200

SYMMETRIC = {"as far to the left as to the right", "the viewport's middle at 0"}
SQUARE_PIXELS = {"rows as far apart as columns", "columns as far apart as rows"}
SQUARE_IMAGES = {
    "width and height exchanged",
    "both divided by the width",
    "both divided by the height",
    "the aspect ratio upside down",
    "no aspect ratio",
    "the angle scaled, not its tangent",
    "the angle of the other side",
}


def unseen(cases: list[CheckCase]) -> set[str]:
    """The mistakes that no ray shows: those of a length that does not count, and those of what all
    cameras of the task are by its words."""
    names = {"normalised"}
    edges = [(case.camera.viewport, case.size) for case in cases]
    if all((x[0], x[2]) == (-x[1], -x[3]) for x, _ in edges):
        names |= SYMMETRIC
    if all(math.isclose((x[1] - x[0]) * high, (x[3] - x[2]) * wide) for x, (wide, high) in edges):
        names |= SQUARE_PIXELS
    if all(width == height for _, (width, height) in edges):
        names |= SQUARE_IMAGES
    return names


@pytest.mark.parametrize("task", TASKS)
def test_every_mistake_is_known_by_name(task: CheckTask) -> None:
    """And with it only what gives the same rays. The right lines are right."""
    every = KINDS[task.kind].cases(replace(task, count=CAMERAS))
    chosen = np.random.default_rng(7).choice(len(every), RAYS, replace=False)
    cases, asked = [every[number] for number in chosen], ray_task(task, task.projections[0])
    program, everything = ray_program(asked), np.arange(RAYS)
    trial = RayTrial(cases, np.zeros((RAYS, 2, 3)), asked)
    tried = [(), *((mistake,) for mistake in program.mistakes)]
    rays = dict(zip(tried, trial.made(program, tried, everything), strict=True))
    assert (trial.apart(trial.right, rays.pop(()), everything) < 1e-13).all()
    unnamed = set()
    for (mistake,), given in rays.items():
        trial.given = given
        wrong = ~(trial.apart(trial.right, given, everything) < 1e-9)
        if not wrong.any():
            unnamed.add(mistake.name)
            continue
        found = candidates(program, trial, wrong)
        assert (mistake,) in found, mistake.name
        for others in found:
            assert (trial.apart(given, rays[others], everything) < 1e-9).all(), (mistake, others)
    assert unnamed == unseen(cases) & {mistake.name for mistake in program.mistakes}


SWAPPED = """
def get_ray(i, j, camera):
    c, p, u, v = camera.center, camera.pixel00_loc, camera.pixel_delta_u, camera.pixel_delta_v
    return c, [p[k] + j * u[k] + i * v[k] - c[k] for k in range(3)]
"""


def test_letters_are_told_as_the_course_calls_them(tmp_path) -> None:
    """There i is the column: what the lecture calls i is the student's j."""
    path = tmp_path / "book.py"
    path.write_text(SWAPPED, "utf-8")
    task = load_tasks(task_path("ray-tracing-in-one-weekend")).tasks[0]
    with FileStudent(path) as student:
        (result,) = check(student, [task])
    lines = told(result).lines
    assert any("they are exchanged" in line for line in lines)
    assert any("+ i*camera.pixel_delta_u + j*camera.pixel_delta_v" in line for line in lines)


def test_words_without_lines_of_their_own_are_told_by_the_contract() -> None:
    words = (("p", "xy11"), ("q", "top_left"), ("camera", "camera"))
    conventions = Conventions(arguments=words, camera=(("z", "forward"),))
    asked = ray_task(replace(BUILTIN[3], conventions=conventions))
    assert asked.words == WORDS - {"i", "j"} | {"x11", "y11"}
