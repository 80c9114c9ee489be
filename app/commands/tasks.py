"""`lucida tasks`: list the tasks for a student's code."""

from __future__ import annotations

import argparse
import sys
import textwrap
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, visible

from .arguments import say

if TYPE_CHECKING:
    from lucida.app.checking.tasks import CheckTask, Limits

NAME = "tasks"
WIDTH = 96

DESCRIPTION = """\
List the tasks of `lucida check`: the functions, their arguments and results, and their points.
With a task's name, print its text and the meaning of each word."""

EPILOG = """\
examples:
  lucida tasks
  lucida tasks viewing-ray
  lucida tasks --tasks cornell-cs4620
  lucida tasks --tasks hw2.toml"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("task", nargs="?", metavar="NAME", help="this task alone, with its text")
    parser.add_argument(
        "--tasks", metavar="FILE.toml", help="a lecturer's own tasks; or a course's name"
    )


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.checking.courses import course_names

    tasks, _ = all_tasks(arguments.tasks)
    if arguments.task is not None:
        say(*described(named(tasks, arguments.task, "NAME")))
    else:
        say(*listed(tasks))
        if arguments.tasks is None:
            courses = textwrap.fill(", ".join(course_names()), WIDTH, break_on_hyphens=False)
            print(f"\nIn the words of courses and books, for --tasks:\n{courses}")
    return 0


def listed(tasks: list[CheckTask]) -> list[str]:
    """Return a line for each task, in columns."""
    from lucida.app.checking.own_words import returned, signature

    rows = [
        (task.name, f"{task.points:g}", f"{signature(task)} -> {returned(task)}") for task in tasks
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(2)]
    return [f"{name:{widths[0]}}  {points:>{widths[1]}}  {call}" for name, points, call in rows]


def described(task: CheckTask) -> list[str]:
    """Return a task with its text and the meanings of its words."""
    from lucida.app.checking.own_words import arguments_text, returned, signature

    points = "point" if task.points == 1 else "points"
    return [
        f"{task.name}: {signature(task)} -> {returned(task)}",
        *textwrap.wrap(task.text, WIDTH),
        "",
        *arguments_text(task, indent=2),
        "",
        f"{task.points:g} {points}. In the lecture: {task.part}.",
    ]


def all_tasks(source: str | None) -> tuple[list[CheckTask], Limits]:
    """Return the tasks and limits of a task file or a course; without one, the built-in tasks."""
    from lucida.app.checking.task_file import BUILTIN
    from lucida.app.checking.tasks import Limits

    if source is None:
        return list(BUILTIN), Limits()
    from lucida.app.checking.courses import task_path
    from lucida.app.checking.task_file import load_tasks

    found = load_tasks(task_path(source))
    for note in found.notes:
        print(f"lucida: {visible(source)}: {note}", file=sys.stderr)
    return list(found.tasks), found.limits


def named(tasks: list[CheckTask], name: str, field: str = "--task") -> CheckTask:
    """Return the task with a name, in which _ may replace -, or with a function of that name.

    field: the argument that has the name. Raises LucidaError.
    """
    from lucida.renderer.files.reading import suggestion

    for task in tasks:
        if name in (task.name, task.function) or name.replace("_", "-") == task.name:
            return task
    names = [task.name for task in tasks]
    raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))
