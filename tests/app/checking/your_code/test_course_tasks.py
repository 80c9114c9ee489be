"""A course's tasks in the window: its own words and conventions, on the window's camera."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckTask, Run
from lucida.app.checking.your_code.model import (
    RAY,
    CodeContent,
    CodeQuestion,
    CodeReport,
    asked_of,
    canvas_pixel,
    cases_for,
    chosen_of,
    is_of_camera,
    rays_of,
    why_not_asked,
)
from lucida.app.checking.your_code.words import told_of, verdict_of
from lucida.renderer.camera.camera import Camera

SIZE = (8, 6)
CAMERA = Camera.look_at((1.0, 2.0, 5.0), (0.0, 0.5, 0.0), aspect=4 / 3)
PARALLEL = replace(CAMERA, projection="parallel")
ASKED = """lucida = 1
[[tasks]]
kind = "viewing-ray"
name = "my-ray"
function = "my_ray"
feedback = "{}"
"""


def file_of(folder: Path, feedback: str = "diagnosis") -> str:
    path = folder / "hw2.toml"
    path.write_text(ASKED.format(feedback))
    return str(path)


def course_rays() -> list[CheckTask]:
    """A viewing ray in each course's words."""
    found = [asked_of(str(task_path(name))).tasks for name in course_names()]
    return [next(task for task in tasks if task.kind == RAY) for tasks in found]


def answered(task: CheckTask, camera: Camera) -> Any:
    """The rays that the kind itself calls right, as a student would return them."""
    cases = cases_for(task, camera, SIZE)
    kind = KINDS[RAY]
    if task.conventions.space == "camera":
        axes = np.array(task.conventions.axes, float)
        frame, eye = cases[0].camera.basis * axes, np.asarray(cases[0].camera.eye)
        right = [np.linalg.solve(frame, (case.right - [eye, np.zeros(3)]).T).T for case in cases]
    else:
        right = [case.right for case in cases]
    places = {"origin": 0, "direction": 1}
    returns = task.conventions.returns
    values = tuple([ray[places[name]].tolist() for name in returns] for ray in right)
    if len(returns) == 1:
        values = tuple(value[0] for value in values)
    assert len(kind.calls(task, cases)) == len(cases)
    return rays_of(task, SIZE, cases, Run(values))


@pytest.mark.parametrize("task", course_rays(), ids=lambda task: f"{task.function}-{task.name}")
def test_each_course_s_right_rays_are_right_on_the_window_s_camera(task: CheckTask) -> None:
    assert why_not_asked(task, CAMERA, SIZE) == ""
    rays = answered(task, CAMERA)
    assert rays.came.all() and not rays.wrong.any() and rays.result.status == "right"
    mirrored = task.conventions.mirrored
    assert (np.dot(rays.camera.u, CAMERA.u) < 0) == mirrored
    # The pixel that is marked in the window's image is the one that sees the same.
    marked = canvas_pixel((1, 2), CAMERA, SIZE, rays.camera, SIZE)
    assert marked == (1, SIZE[0] - 3 if mirrored else 2)
    right, seen = rays.right[marked][1], CAMERA.ray(1, 2, SIZE).direction
    assert np.allclose(np.cross(right, seen), 0, atol=1e-9) and np.dot(right, seen) > 0


def test_what_a_course_s_words_cannot_tell_is_not_asked() -> None:
    built_in = next(task for task in BUILTIN if task.kind == RAY)
    rigid = next(task for task in course_rays() if task.conventions.needs_rigid)
    left, right, bottom, top = CAMERA.viewport
    skewed = replace(CAMERA, u=tuple(1.5 * np.asarray(CAMERA.u)))
    moved = replace(CAMERA, viewport=(left + 0.1, right + 0.1, bottom, top))
    for camera in (skewed, moved):
        assert "orthonormal, with a symmetric viewport" in why_not_asked(rigid, camera, SIZE)
        assert why_not_asked(built_in, camera, SIZE) == ""
    turned = replace(CAMERA, u=tuple(-np.asarray(CAMERA.u)))
    for task in course_rays():
        if task.conventions.needs_rigid and not task.conventions.mirrored:
            assert "left-handed" in why_not_asked(task, turned, SIZE)
    assert "P switches" in why_not_asked(rigid, PARALLEL, SIZE)


@pytest.mark.parametrize(
    ("feedback", "seen", "verdict", "said"),
    [
        ("nothing", False, "tried", "The course tells no more of it."),
        ("verdict", False, "right", "correct"),
        ("first-wrong", True, "right", "correct"),
    ],
)
def test_what_the_course_keeps_back_is_not_shown(
    tmp_path: Path, feedback: str, seen: bool, verdict: str, said: str
) -> None:
    (task,) = asked_of(file_of(tmp_path, feedback)).tasks
    assert is_of_camera(task) == seen
    assert chosen_of([task], "") == task
    result = TaskResult(task, "right", 1.0, 10)
    question = CodeQuestion(CodeContent("rays.py"), "", CAMERA, SIZE)
    report = CodeReport(question, (task,), task, results={task.name: result}, asked=(task,))
    assert verdict_of(report, task) == verdict
    lines = told_of(report, None)
    assert said in lines[0].text and len(lines) == 1
