"""Right and wrong answers to the tasks of lenses, in many forms, through the student's process."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.checked import checked
from lucida.app.checking.running.file import FileStudent

STATUS = {"right": "right", "wrong": "wrong", "unusable": "failed"}
# What the functions' names have after right_, wrong_, unusable_.
PARTS = {"project": "project_", "project-fisheye": "fisheye_", "undistort": "undistort_"}
TASKS = {task.name: task for task in BUILTIN}


@pytest.mark.parametrize("name", PARTS)
def test_answers_are_judged_as_they_are(name):
    task, count = TASKS[name], Counter()
    with FileStudent(Path(__file__).with_name("students_lenses.py")) as student:
        for function in sorted(student.functions()):
            kind, _, rest = function.partition("_")
            if kind in STATUS and rest.startswith(PARTS[name]):
                result = checked(student, replace(task, function=function))
                assert result.status == STATUS[kind], (function, result)
                assert result.points == (task.points if kind == "right" else 0.0)
                assert (result.first is not None) == (kind == "wrong")
                count[kind] += 1
    assert count["right"] >= 3 and count["wrong"] >= 1 and count["unusable"] >= 1, count
