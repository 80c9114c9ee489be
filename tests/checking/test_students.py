"""Fifteen right and forty-four wrong files as students write them: verdicts and diagnosis."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from app.checking.builtin import BUILTIN
from app.checking.checked import check
from app.checking.reports.told import told
from app.checking.running.file import FileStudent

STUDENTS = Path(__file__).parent / "students"
ANSWERS = tomllib.loads((STUDENTS / "manifest.toml").read_text("utf-8"))["answers"]


def test_all_files_are_listed() -> None:
    files = {path.stem for path in STUDENTS.glob("*.py")}
    assert [answer["file"] for answer in ANSWERS] == sorted(files)
    assert [sum(name.startswith(kind) for name in files) for kind in ("right", "wrong")] == [15, 44]


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: answer["file"])
def test_verdict_and_diagnosis(answer: dict[str, Any]) -> None:
    expected = {name: None for name in answer.get("right", ())} | answer.get("wrong", {})
    with FileStudent(STUDENTS / f"{answer['file']}.py") as student:
        tasks = [task for task in BUILTIN if task.function in student.functions()]
        results = {result.task.name: result for result in check(student, tasks)}
    assert results.keys() == expected.keys()
    for name, wanted in expected.items():
        result = results[name]
        say = told(result)
        if wanted is None:
            assert result.status == "right", say.lines
        elif wanted["by"] == "failure":
            assert result.status == "failed" and wanted["says"] in say.failure[0]
        else:
            assert result.status == "wrong" and result.diagnosis is not None, say.lines
            assert wanted["says"] in " ".join(say.diagnosis), say.diagnosis
            assert bool(result.diagnosis.candidates) == (wanted["by"] == "exactly")
            if wanted["by"] != "exactly":
                assert (result.diagnosis.camera is not None) == (wanted["by"] == "camera")
