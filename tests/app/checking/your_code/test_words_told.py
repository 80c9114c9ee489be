"""The words for a file, and their order."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from right_code import right_ray

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.mistakes.diagnosis import Diagnosis
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import Failure, Run
from lucida.app.checking.your_code.model import (
    RAY,
    CodeQuestion,
    CodeReport,
    cases_for,
    rays_of,
)
from lucida.app.checking.your_code.words import told_of
from lucida.renderer.camera.camera import Camera

SIZE = (4, 3)
CAMERA = Camera.look_at((1.0, 2.0, 5.0), (0.0, 0.5, 0.0), aspect=4 / 3)
TASK = next(task for task in BUILTIN if task.kind == RAY)
RIGHT = TaskResult(TASK, "right", 379)
QUESTION = CodeQuestion("rays.py", 1, CAMERA, SIZE)


def report(answer: Any = right_ray, run: Run | None = None, **changes: Any) -> CodeReport:
    cases = cases_for(TASK, CAMERA, SIZE)
    if run is None:
        calls = KINDS[RAY].calls(TASK, cases)
        run = Run(tuple(answer(dict(call.arguments)) for call in calls))
    rays = rays_of(TASK, SIZE, cases, run)
    found = CodeReport(QUESTION, rays, {TASK.name: RIGHT}, rays.result.failure, run.output)
    return replace(found, **changes)


def mirrored(known: dict[str, Any]) -> list[list[float]]:
    origin, direction = right_ray(known)
    return [origin, [-direction[0], *direction[1:]]]


def texts(one: CodeReport, pixel: tuple[int, int] | None = None) -> list[str]:
    return [line.text for line in told_of(one, pixel)]


def test_what_is_right_is_told_in_a_line_for_this_camera_and_the_others():
    found = told_of(report(), None)
    assert [line.text for line in found] == [
        "Every ray is correct.",
        "viewing-ray: correct in all of 379 cases.",
    ]
    assert {line.role for line in found} == {"good"}
    assert texts(report(results={}))[-1] == "trying others ..."


def test_wrong_rays_are_told_with_the_reason_of_the_task():
    found = texts(report(mirrored, results={}))
    assert found[:2] == ["12 of 12 rays are wrong.", "looking for the reason ..."]
    wrong = replace(RIGHT, status="wrong", diagnosis=Diagnosis(("u points left.",)))
    assert texts(report(mirrored, results={TASK.name: wrong}))[1] == "u points left."


def test_the_marked_pixel_in_numbers():
    found = texts(report(mirrored), (1, 2))
    first = next(k for k, text in enumerate(found) if text.startswith("pixel"))
    assert found[first] == "pixel (1, 2), from 0, of the pictures:"
    assert found[first + 1].startswith("yours    (1, 2, 5) + t (")
    assert found[first + 2].startswith("correct  (1, 2, 5) + t (")
    assert found[first + 1] != found[first + 2]
    half = report(run=Run((right_ray(dict(cases_for(TASK, CAMERA, SIZE)[0].arguments)),)))
    assert not any(text.startswith("pixel") for text in texts(half, (1, 2)))  # it has not come


def test_an_exception_is_told_with_its_own_lines():
    failure = Failure("exception", "rays.py, line 3: ZeroDivisionError", ("File x", "1 / 0"))
    found = told_of(report(run=Run((), "said\n", failure)), None)
    assert [(line.role, line.text) for line in found[:3]] == [
        ("bad", "rays.py, line 3: ZeroDivisionError"),
        ("code", "File x"),
        ("code", "1 / 0"),
    ]
    assert [line.text for line in found[-2:]] == ["printed:", "said"]
    assert not any("right" in line.text for line in found)


def test_a_file_that_answers_nothing():
    failure = Failure(
        "exception", "rays.py, line 2: SyntaxError", ("    x = (", "        ^", "Lost")
    )
    found = CodeReport(QUESTION, failure=failure, output="before")
    lines = ["rays.py, line 2: SyntaxError", "    x = (", "Lost"]  # not the line of marks
    assert texts(found) == [*lines, "printed:", "before"]
    ended = CodeReport(QUESTION, failure=Failure("time", "the time limit is over"))
    assert texts(ended)[1].startswith("It is not run again by itself: choose fewer pixels")


def test_a_function_with_nothing_in_it_is_told_what_it_is_to_do():
    empty = report(lambda known: None)
    assert texts(empty)[0].startswith("viewing_ray returns nothing yet. The viewing ray of pixel")


def test_a_ray_that_is_right_for_this_camera_alone():
    wrong = replace(RIGHT, status="wrong", wrong=7, diagnosis=Diagnosis(("Read again: Rays.",)))
    found = told_of(report(results={TASK.name: wrong}), None)
    assert [line.text for line in found[:2]] == [
        "Every ray is correct.",
        "But not for every camera:",
    ]
