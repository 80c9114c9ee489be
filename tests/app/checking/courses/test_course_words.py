"""The table of wrong lines in the words of courses: right lines are right, wrong ones are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lucida.app.checking.checked import check
from lucida.app.checking.conventions import Conventions
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.mistakes.program import Mistake
from lucida.app.checking.mistakes.programs import case_values, program_of
from lucida.app.checking.mistakes.rays import WORDS, ray_task, run_rays
from lucida.app.checking.mistakes.trials import candidates, trials_of
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import BUILTIN, load_tasks
from lucida.app.checking.tasks import CheckCase, CheckTask

TASKS = {
    f"{name}: {task.name}": task
    for name in course_names()
    for task in load_tasks(task_path(name)).tasks
    if task.kind == "viewing-ray"
}
CAMERAS = 10
RAYS = 40
SHARES = 5  # of the mistakes, each of which takes a search through all others

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


def unit_rays(rays: NDArray[np.float64]) -> NDArray[np.float64]:
    rays[:, 1] /= np.linalg.norm(rays[:, 1], axis=1, keepdims=True)
    return rays


def alike(rays: NDArray[np.float64], others: NDArray[np.float64]) -> bool:
    """Return True if origins and directions are the same, of any length."""
    with np.errstate(all="ignore"):
        pairs = zip(unit_rays(rays.copy()), unit_rays(others.copy()), strict=True)
        return all(np.allclose(*pair, atol=1e-8, equal_nan=True) for pair in pairs)


@pytest.mark.parametrize(("share", "task"), [*enumerate(TASKS.values())], ids=TASKS)
def test_every_mistake_is_known_by_name(share: int, task: CheckTask) -> None:
    """And with it only what gives the same rays. The right lines are right. Each task has its share
    of the mistakes.
    """
    every = KINDS[task.kind].cases(replace(task, count=CAMERAS))
    chosen = np.random.default_rng(7).choice(len(every), RAYS, replace=False)
    cases = [every[number] for number in chosen]
    program = program_of(task)
    right = np.array([case.right for case in cases])

    made = [case_values(case, *case.pixel, ray_task(task)) for case in cases]
    known = {name: np.array([np.atleast_1d(one[name]) for one in made]) for name in made[0]}

    def rays_with(*mistakes: Mistake) -> NDArray[np.float64]:
        rays = np.stack(run_rays(program, known, mistakes), axis=1)
        with np.errstate(all="ignore"):
            return unit_rays(rays) if task.conventions.unit else rays

    assert alike(rays_with(), right)
    rays = {mistake: rays_with(mistake) for mistake in program.mistakes}
    unnamed = {mistake for mistake, given in rays.items() if alike(given, right)}
    for mistake in program.mistakes[share % SHARES :: SHARES]:
        if mistake in unnamed:
            continue
        given = rays[mistake]
        found = candidates(program, trials_of(task, cases, given))
        assert (mistake,) in found, mistake.name
        for (other,) in found:
            assert alike(given, rays[other]), (mistake, other)
    names = {mistake.name for mistake in program.mistakes}
    assert {mistake.name for mistake in unnamed} == unseen(cases) & names


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
    lines = result.lines
    assert any("they are exchanged" in line for line in lines)
    assert any("+ i*camera.pixel_delta_u + j*camera.pixel_delta_v" in line for line in lines)


def test_words_without_lines_of_their_own_are_told_by_the_contract() -> None:
    words = (("p", "xy11"), ("q", "top_left"), ("camera", "camera"))
    conventions = Conventions(arguments=words, camera=(("z", "forward"),))
    asked = ray_task(replace(BUILTIN[0], conventions=conventions))
    assert asked.words == WORDS - {"i", "j"} | {"x11", "y11"}
