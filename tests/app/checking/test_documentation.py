"""docs/checking.md names every word, every field, every kind; its task file is one."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import get_args

import pytest

from lucida.app.checking.conventions import CAMERA_WORDS, PAIRS, PIXEL_WORDS
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.own_words import signature
from lucida.app.checking.task_file import BUILTIN, load_tasks
from lucida.app.checking.task_schema import TaskFile, TaskTable
from lucida.app.checking.tasks import CAMERA_KINDS, Feedback

PAGE = (Path(__file__).parents[3] / "docs" / "checking.md").read_text("utf-8")


WORDS = {*CAMERA_WORDS, *PIXEL_WORDS, *PAIRS}


@pytest.mark.parametrize("names", [WORDS, TaskTable.__struct_fields__])
def test_words_and_fields_are_named(names):
    quoted = set(re.findall(r"`([\w-]+)`", PAGE))
    assert set(names) <= quoted


def test_kinds_and_choices_are_named():
    for name in (*KINDS, *CAMERA_KINDS, *get_args(Feedback)):
        assert re.search(rf"\b{name}\b", PAGE), name
    for field in TaskFile.__struct_fields__:
        assert re.search(rf"^    \[*{field}\b", PAGE, re.MULTILINE), field
    for task in BUILTIN:
        assert f"def {signature(replace(task, notation='code'))}: ..." in PAGE


def test_the_task_file_is_read(tmp_path):
    blocks = re.findall(r"(?:^    .*\n(?:\n(?=    ))*)+", PAGE, re.MULTILINE)
    text = next(block for block in blocks if block.startswith("    lucida = 1"))
    (tmp_path / "hw2.toml").write_text(re.sub("^    ", "", text, flags=re.MULTILINE), "utf-8")
    found = load_tasks(tmp_path / "hw2.toml")
    assert [task.kind for task in found.tasks] == ["viewing-ray", "basis"]


def test_courses_are_there_with_their_functions_and_fields():
    table = PAGE[PAGE.index("## Courses and books") : PAGE.index("## Autograders")]
    rows = {row.split("`")[1]: row for row in table.splitlines() if row.startswith("| `")}
    rows.pop("--tasks")
    assert list(rows) and set(rows) == set(course_names())
    for name, row in rows.items():
        for task in load_tasks(task_path(name)).tasks:
            if task.kind == "viewing-ray":
                assert re.search(rf"\b{task.function}\b", row), (name, task.function)
