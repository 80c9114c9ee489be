"""The formulas in reports run in the starter's file, and compute what the mistake computes."""

from __future__ import annotations

import functools
import re
import textwrap
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lucida.app.checking import own_words
from lucida.app.checking.builtin import builtin_tasks
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.mistakes.program import Mistake, Program
from lucida.app.checking.mistakes.programs import case_values, known_values, programs
from lucida.app.checking.mistakes.rays import ray_task
from lucida.app.checking.own_words import AS_IF, functions, in_the_tasks_words, own_names, starter
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import load_tasks
from lucida.app.checking.tasks import CheckCase, CheckTask, Failure

TASKS = [
    pytest.param(task, id=f"{name}: {task.name}")
    for name, tasks in (
        ("book", builtin_tasks("book")),
        ("code", builtin_tasks("code")),
        *((name, load_tasks(task_path(name)).tasks) for name in course_names()),
    )
    for task in tasks
]
# Functions in the lines of both loops that the student has written otherwise. No formula has them.
OTHERS = """
import numpy
def hit(origin, direction, shape): return shape["radius"] if "radius" in shape else 2.5
def far_away(width, height): return numpy.full((height, width), numpy.inf)
def plain(color, width, height): return numpy.zeros((height, width, 3)) + color
"""
NAME = re.compile(r"(?<![\w.'])[A-Za-z_]\w*")


@pytest.mark.parametrize("task", TASKS)
def test_formulas_run_in_the_starter(
    task: CheckTask, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One function has all correct lines; the others have the formulas of one mistake each."""
    for function in (own_names, functions):  # once for each task, not for each line
        monkeypatch.setattr(own_words, function.__name__, functools.cache(function))
    case = KINDS[task.kind].cases(task)[-1]
    wanted, made = [], []
    known = _known(task, case)
    for its in programs(task):
        for mistake in (None, *its.mistakes):
            body, is_whole = _body(task, its, mistake)
            if body:
                wanted.append(its.run(known, (mistake,) if mistake else ()) if is_whole else None)
                made.append(body)
    if task.name in KINDS:  # a course may leave to the student all that its mistakes are about
        assert len(made) > len(programs(task))
    text = starter([task])
    head = text[text.index("(", text.index(f"def {task.function}(")) :].partition("\n")[0]
    tried = [f"def formula{k}{head}\n{body}" for k, body in enumerate(made)]
    path = tmp_path / "student.py"
    path.write_text("\n".join([text, OTHERS, *_values(task, known), *tried]), "utf-8")
    (call,) = KINDS[task.kind].calls(task, [case])
    calls = [replace(call, function=f"formula{k}") for k in range(len(made))]
    with FileStudent(path) as student:
        values = student.call(calls).values
    for value, right, body in zip(values, wanted, made, strict=True):
        assert not isinstance(value, Failure), (value.text, body)
        if right is not None:
            np.testing.assert_allclose(
                _flat(value), _flat(right), rtol=1e-9, atol=1e-9, err_msg=body
            )


def _body(task: CheckTask, its: Program, mistake: Mistake | None) -> tuple[str, bool]:
    """Return the lines of a function, with the formulas that reports show in place of those that
    the mistake changes, and True if these are all; "" if there are none.
    """
    own = own_words.own_names(task)
    lines, shown, hidden = [], 0, 0
    if task.kind == "render":
        rows, columns = own["height"], own["width"]
        lines.append(
            f"i, j = numpy.arange({rows})[:, None, None], numpy.arange({columns})[:, None]"
        )
    for line in its.text((mistake,) if mistake else ()):
        instead = line.code if line.instead is None else line.instead
        parts = instead.split("\n")
        wrong = " and ".join(f"`{part.strip()}`" for part in parts)
        told = in_the_tasks_words(task, [f"{AS_IF} {wrong}, not `{line.code.strip()}`."])
        codes = told[0].split("`")[1::2] if told else []
        space = line.code[: -len(line.code.lstrip())]
        if len(codes) > 1:
            lines += [space + code for code in codes[:-1]]
            shown += line.instead is not None
        else:  # not shown: the correct line, in the student's names
            hidden += line.instead is not None
            lines.append(NAME.sub(lambda found: own.get(found[0], found[0]), line.code))
    if mistake is not None and not shown:
        return "", False
    lines.append(f"return {', '.join(own[name] for name in its.results)}")
    return textwrap.indent("\n".join(lines), "    "), not hidden


def _values(task: CheckTask, known: dict[str, Any]) -> list[str]:
    """Return lines with the values in correct lines that the task does not pass."""
    names = {name for its in programs(task) for name in NAME.findall(its.source())}
    others = sorted((names & known.keys()) - own_words.own_names(task).keys())
    return [
        f"{name} = numpy.array({np.ravel(known[name]).tolist()})"
        for name in others
        if not callable(known[name])
    ]


def _known(task: CheckTask, case: CheckCase) -> dict[str, Any]:
    """Return the values of the program's names in a case."""
    known: dict[str, Any] = {}
    exec(OTHERS, known)
    if case.camera is None:
        return known_values(task, case) | known
    size = case.size
    assert size is not None
    i, j = case.pixel or (np.arange(size[1])[:, None], np.arange(size[0]))
    return known | case_values(case, i, j, ray_task(task)) | case.values.get("scene", {})


def _flat(value: Any) -> Any:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return np.concatenate([_flat(part) for part in value]) if len(value) else np.zeros(0)
    return np.ravel(np.asarray(np.nan if value is None else value, float))
