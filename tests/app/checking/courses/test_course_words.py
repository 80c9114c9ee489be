"""The table of wrong lines in the words of courses: right lines are right, wrong ones are known."""

from __future__ import annotations

import copy
import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.checking.cases import shots
from lucida.app.checking.checked import check
from lucida.app.checking.conventions import Conventions
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.mistakes.candidates import candidates
from lucida.app.checking.mistakes.ray_trial import RayCase, RayTrial
from lucida.app.checking.mistakes.rays import WORDS, RayTask, ray_program
from lucida.app.checking.ray_words import ray_task
from lucida.app.checking.reports.told import told
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import load_tasks
from lucida.app.checking.tasks import CheckTask

TASKS = [
    pytest.param(task, id=f"{name}: {task.name}")
    for name in course_names()
    for task in load_tasks(task_path(name)).tasks
    if task.kind == "viewing-ray"
]
CAMERAS = 50
PIXELS = 4  # of each image


def cases_of(task: CheckTask) -> tuple[list[RayCase], RayTask]:
    """A few pixels of 50 cameras, as the course's words ask for them."""
    made = []
    random = np.random.default_rng(7)
    for shot in shots(replace(task, count=CAMERAS)):
        width, height = shot.size
        for number in sorted(random.choice(width * height, PIXELS, replace=False).tolist()):
            pixel = divmod(number, width)
            made.append(RayCase(shot.camera, shot.size, pixel, shot.target, shot.up))
    asked = replace(ray_task(task.conventions), projection=task.projections[0])
    return made, asked


@pytest.mark.parametrize("task", TASKS)
def test_the_right_lines_are_right(task: CheckTask) -> None:
    cases, asked = cases_of(task)
    program = ray_program(asked)
    trial = RayTrial(cases, np.zeros((len(cases), 2, 3)), asked)
    made = trial.made(program, [()], np.arange(len(cases)))
    assert (trial.apart(trial.right, made[0], np.arange(len(cases))) < 1e-13).all()


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


def unseen(cases: list[RayCase]) -> set[str]:
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
    """And with it only what gives the same rays."""
    cases, asked = cases_of(task)
    program = ray_program(asked)
    everything = np.arange(len(cases))
    plain = RayTrial(cases, np.zeros((len(cases), 2, 3)), asked)
    rays = {
        mistakes: plain.made(program, [mistakes], everything)[0]
        for mistakes in ((mistake,) for mistake in program.mistakes)
    }
    unnamed = set()
    for (mistake,), given in rays.items():
        trial = copy.copy(plain)  # whose values are the same
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
    asked = ray_task(Conventions(arguments=words, camera=(("z", "forward"),)))
    assert asked.words == WORDS - {"i", "j"} | {"x11", "y11"}
