"""The files that `lucida check` writes: Gradescope's results, and the page with pictures."""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError

if TYPE_CHECKING:
    from lucida.app.checking.checked import TaskResult
    from lucida.app.checking.reports.picture import Pictured
    from lucida.app.checking.running.program import ProgramStudent
    from lucida.app.checking.tasks import CheckTask


def write_json(
    arguments: argparse.Namespace,
    results: list[TaskResult],
    tasks: list[CheckTask],
    seconds: float,
    problem: str = "",
) -> None:
    if arguments.json is None:
        return
    from lucida.app.checking.reports.told import gradescope

    values = gradescope(results, tasks, seconds, problem)
    text = json.dumps(values, indent=2, allow_nan=False) + "\n"
    if arguments.json == "-":
        sys.stdout.write(text)
    else:
        from lucida.renderer.system.atomic import atomic_write

        try:
            with atomic_write(arguments.json) as file:
                file.write(text.encode())
        except LucidaError:
            earlier = Path(arguments.json)
            if earlier.is_file():  # an earlier check's must not pass for this one's
                with contextlib.suppress(OSError):
                    earlier.unlink()
            raise


def pictures_of(student: ProgramStudent, result: TaskResult) -> dict[str, Pictured]:
    from lucida.app.checking.reports.picture import pictured

    found = pictured(student, result)
    return {} if found is None else {result.task.name: found}


def write_page(
    arguments: argparse.Namespace,
    results: list[TaskResult],
    tasks: list[CheckTask],
    pictures: dict[str, Pictured],
    problem: str = "",
) -> None:
    if arguments.html is None:
        return
    from lucida.app.checking.reports.page import page
    from lucida.renderer.system.atomic import atomic_write

    text = page(results, tasks, *_without_folders(arguments, problem), pictures)
    with atomic_write(arguments.html) as file:
        file.write(text.encode())


def _without_folders(arguments: argparse.Namespace, problem: str) -> tuple[str, str]:
    """Return the checked name and the problem, with file names in place of paths."""
    parts = [arguments.file] if arguments.command is None else arguments.command.split()
    for part in parts:
        problem = problem.replace(part, Path(part).name or part)
    return " ".join(Path(part).name or part for part in parts), problem
