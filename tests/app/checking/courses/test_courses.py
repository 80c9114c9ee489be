"""The conventions of courses: right and wrong answers in each course's own style.

written/ holds a file for each course. Of its functions those called right_... are right, those
called wrong_... wrong; the docstring names the task, and what the diagnosis must say.
"""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from lucida.app.checking.checked import check
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import load_tasks
from lucida.renderer.system.errors import LucidaError

WRITTEN = Path(__file__).parent / "written"
COURSES = (
    "berkeley-cs184",
    "cmu-scotty3d",
    "cornell-cs4620",
    "lecture",
    "mit-6837",
    "nori",
    "pbrt",
    "ray-tracer-challenge",
    "ray-tracing-in-one-weekend",
)


def answers(course: str) -> list[tuple[str, str, str]]:
    """The functions of a course's file: name, task, what the diagnosis must say."""
    found = []
    for node in ast.parse((WRITTEN / f"{course}.py").read_text("utf-8")).body:
        if isinstance(node, ast.FunctionDef) and node.name.startswith(("right_", "wrong_")):
            task, _, says = (ast.get_docstring(node) or "").partition(": ")
            found.append((node.name, task, says))
    return found


def test_all_courses_are_there() -> None:
    assert tuple(course_names()) == COURSES
    assert {path.stem for path in WRITTEN.glob("*.py")} == set(COURSES)


@pytest.mark.parametrize("course", COURSES)
def test_right_is_right_and_wrong_is_named(course: str) -> None:
    tasks = {task.name: task for task in load_tasks(task_path(course)).tasks}
    written = answers(course)
    asked = [replace(tasks[task], function=name, count=5) for name, task, _ in written]
    assert sum(name.startswith("right_") for name, *_ in written) >= 2
    assert sum(name.startswith("wrong_") for name, *_ in written) >= 2
    with FileStudent(WRITTEN / f"{course}.py") as student:
        results = list(check(student, asked))
    for (name, _, says), result in zip(written, results, strict=True):
        text = "\n".join(result.lines)
        assert result.status == name[:5], f"{name}: {result.status}: {text}"
        assert says in text.replace("`", ""), f"{name}: {says!r} is not in: {text}"


def test_every_task_has_a_right_and_a_wrong_answer() -> None:
    for course in COURSES:
        for task in load_tasks(task_path(course)).tasks:
            kinds = {name[:5] for name, of, _ in answers(course) if of == task.name}
            assert "right" in kinds or task.kind == "basis", f"{course}: {task.name}"


def test_a_file_goes_before_a_course_and_typos_are_named(tmp_path: Path) -> None:
    own = tmp_path / "pbrt"
    own.write_text("", "utf-8")
    assert task_path(str(own)) == own
    assert task_path("hw2.toml") == Path("hw2.toml")
    with pytest.raises(LucidaError, match=r"neither a file nor a course.*cornell-cs4620"):
        task_path("cornel-cs4620")
