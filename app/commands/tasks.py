"""`lucida tasks`: list the tasks for a student's code."""

from __future__ import annotations

import argparse
import textwrap
from typing import TYPE_CHECKING

from .arguments import say

if TYPE_CHECKING:
    from lucida.app.checking.tasks import CheckTask

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

    from .asked_tasks import all_tasks, named

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
