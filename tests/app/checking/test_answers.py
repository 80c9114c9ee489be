"""Right and wrong answers to every built-in task, in many forms, through the student's process."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.checked import checked
from lucida.app.checking.running.file import FileStudent

ANSWERS = Path(__file__).parent / "answers"
STATUS = {"right": "right", "wrong": "wrong", "unusable": "failed"}

# The task, the file of its answers, and what their names have after right_, wrong_, unusable_.
FILES = {
    "to-gray": ("images", "gray_"),
    "to-bitmap": ("images", "bitmap_"),
    "memory-offset": ("images", "offset_"),
    "viewing-ray": ("viewing_ray", ""),
    "viewing-ray-parallel": ("parallel_ray", ""),
    "basis": ("basis", ""),
    "hit-sphere": ("hit_sphere", ""),
    "hit-triangle": ("hit_triangle", ""),
    "closest-hit": ("closest_hit", ""),
    "render": ("render", ""),
    "project": ("lenses", "project_"),
    "project-fisheye": ("lenses", "fisheye_"),
    "undistort": ("lenses", "undistort_"),
}


@pytest.mark.parametrize("task", BUILTIN, ids=lambda task: task.name)
def test_answers_are_judged_as_they_are(task):
    file, part = FILES[task.name]
    count: Counter[str] = Counter()
    with FileStudent(ANSWERS / f"{file}.py") as student:
        for function in sorted(student.functions()):
            kind, _, rest = function.partition("_")
            if kind not in STATUS or not rest.startswith(part):
                continue
            result = checked(student, replace(task, function=function))
            assert result.status == STATUS[kind], (function, result)
            assert result.points == (task.points if kind == "right" else 0.0)
            if kind == "wrong":
                assert result.first is not None and 0 < result.wrong <= result.cases
                assert result.first.right != result.first.given
            else:
                assert result.first is None
            count[kind] += 1
    assert count["right"] >= 3 and count["wrong"] >= 1 and count["unusable"] >= 1, count
