"""`lucida check`: compare a student's code with the correct answers.

It is quick to import: it loads the modules that a check of rays needs, and no tracer.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, one_line, visible

from . import arguments as common
from .tasks import all_tasks, named

if TYPE_CHECKING:
    from lucida.app.checking.checked import TaskResult
    from lucida.app.checking.running.account import Account
    from lucida.app.checking.running.command import CommandStudent
    from lucida.app.checking.running.file import FileStudent
    from lucida.app.checking.running.program import ProgramStudent
    from lucida.app.checking.tasks import CheckTask, Limits

NAME = "check"

PYTHON = (".py", ".pyw", "")
NOT_ENDED = "The check did not finish: nothing has been graded."

DESCRIPTION = """\
Check a student's code, a Python file or any program, and report what is wrong with it.
`lucida tasks` lists the tasks; docs/checking.md has the details."""

EPILOG = """\
The code runs in a process of its own, with limits on time and memory. Without --as, a dishonest
program could read the correct answers, change its results, end the check, or leave a daemon
behind.
exit status: 0 all correct, 1 wrong answers, 2 could not be run (a missing function, an exception,
the time limit, ...) or a mistake in the arguments, 130 interrupted

examples:
  lucida check --starter viewing-ray -o rays.py    a file to start from
  lucida check rays.py                             all tasks whose functions the file has
  lucida check rays.py --tasks hw2.toml --json results.json
  lucida check --command "julia rays.jl" --task viewing-ray"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument(
        "file",
        nargs="?",
        metavar="FILE",
        help="a Python file",
    )
    which.add_argument(
        "--command", metavar="COMMAND", help="a program: one JSON object a line in, one a line out"
    )
    parser.add_argument(
        "--tasks",
        metavar="FILE.toml",
        help="a lecturer's own tasks; or the name of a course (lucida tasks lists them)",
    )
    parser.add_argument("--task", metavar="NAME", help="check only this task")
    parser.add_argument(
        "--json", metavar="OUT", help="write the results for Gradescope; -: print them"
    )
    parser.add_argument(
        "--as",
        dest="user",
        metavar="USER",
        help="run the code as this user, who has no other processes (needs root on Linux)",
    )
    parser.add_argument(
        "--python", metavar="PATH", help="run a Python file by this interpreter (default: Lucida's)"
    )
    which.add_argument(
        "--starter", metavar="TASK", help="write a file to start from; TASK may be `all`"
    )
    parser.add_argument("-o", dest="output", metavar="FILE", help="the file that --starter writes")


def run(arguments: argparse.Namespace) -> int:
    if arguments.starter is not None:
        return _write_starter(arguments)
    begin = time.perf_counter()
    tasks: list[CheckTask] = []
    results: list[TaskResult] = []
    from lucida.app.checking.checked import check, status_of
    from lucida.app.checking.reports import summary, terminal_lines
    from lucida.app.checking.running.program import DISHONEST

    def write(problem: str = "") -> None:
        _write_json(arguments.json, results, tasks, time.perf_counter() - begin, problem)

    try:
        _check_arguments(arguments)
        tasks, limits = all_tasks(arguments.tasks)
        if arguments.task is not None:
            tasks = [named(tasks, arguments.task)]
        student = _student(arguments, limits)
        if arguments.json != "-":  # leaves results even if the student's program ends this process
            write(NOT_ENDED)
        try:
            tasks = _possible(arguments, student, tasks)
            if arguments.user is None:
                print(f"lucida: {DISHONEST}", file=sys.stderr)
            for result in check(student, tasks):
                results.append(result)
                if arguments.json != "-":
                    print("\n".join(terminal_lines(result)), flush=True)
        finally:
            student.close()
        if student.survived:
            results.clear()
            problem = "something that the program started could not be ended"
            checked = str(arguments.file or arguments.command)
            raise LucidaError("", problem, "its answers do not count", checked)
    except LucidaError as error:
        lines = _why(error)
        write("\n".join([str(error), *lines]))
        if lines:
            print("\n".join(lines), file=sys.stderr)
        raise
    write()
    if arguments.json != "-" and len(results) > 1:
        print(summary(results, tasks))
    return status_of(results)


def _why(error: LucidaError) -> list[str]:
    """Return the output of a student's file up to its failure, and the failing lines, if it does
    not run.
    """
    from lucida.app.checking.checked import failure_lines
    from lucida.app.checking.running.file import NotRunnableError

    if not isinstance(error, NotRunnableError):
        return []
    printed = visible(error.output).rstrip().split("\n") if error.output else []
    return [*printed, *failure_lines(error.failure)]


def _possible(
    arguments: argparse.Namespace, student: ProgramStudent, tasks: list[CheckTask]
) -> list[CheckTask]:
    """Return the tasks to try: all that a lecturer or the user has named, or else the built-in
    ones whose functions exist.
    """
    functions = student.functions()
    if functions is None or arguments.tasks is not None or arguments.task is not None:
        return tasks
    found = [task for task in tasks if task.function in functions]
    if not found:
        problem = "it has none of the requested functions"
        names = dict.fromkeys(task.function for task in tasks)
        raise LucidaError("", problem, f"define one of {', '.join(names)}", arguments.file)
    return found


def _write_json(
    path: str | None,
    results: list[TaskResult],
    tasks: list[CheckTask],
    seconds: float,
    problem: str,
) -> None:
    from lucida.app.checking.reports import gradescope
    from lucida.renderer.system.atomic import atomic_write

    if path is None:
        return
    values = gradescope(results, tasks, seconds, problem)
    text = json.dumps(values, indent=2, allow_nan=False) + "\n"
    if path == "-":
        sys.stdout.write(text)
        return
    try:
        with atomic_write(path) as file:
            file.write(text.encode())
    except LucidaError:
        with contextlib.suppress(OSError):  # earlier results must not pass for this check's
            Path(path).unlink()
        raise


def _check_arguments(arguments: argparse.Namespace) -> None:
    from lucida.renderer.system.atomic import check_writable

    if arguments.file is not None:
        _check_link(Path(arguments.file))
    if arguments.json not in (None, "-"):
        check_writable(arguments.json)
    if arguments.output is not None:
        raise LucidaError("-o", "is for --starter", "results are written with --json OUT")
    if arguments.command is not None and arguments.task is None and arguments.tasks is None:
        raise LucidaError("--task", "is missing", "say what the program answers: lucida tasks")


def _check_link(path: Path) -> None:
    """Raise LucidaError if the path is a link to another folder's file: a solution, a secret."""
    try:
        inside = path.resolve().is_relative_to(path.parent.resolve())
    except (OSError, RuntimeError):  # a link to itself
        return
    if path.is_symlink() and not inside:
        raise LucidaError("", "is a link out of its folder", "give the file itself", str(path))


def _account(arguments: argparse.Namespace) -> Account | None:
    """Return the user of the student's program, who can reach neither results nor tasks; None
    without `--as`.
    """
    from lucida.app.checking.courses import task_path
    from lucida.app.checking.running.account import account

    if arguments.user is None:
        return None
    user = account(arguments.user)
    results = [Path(arguments.json)] if arguments.json not in (None, "-") else []
    own_tasks = arguments.tasks is not None and Path(arguments.tasks).is_file()
    user.check_reach([Path(task_path(arguments.tasks))] if own_tasks else [], results)
    return user


def _student(arguments: argparse.Namespace, limits: Limits) -> FileStudent | CommandStudent:
    if arguments.command is not None:
        from lucida.app.checking.running.command import CommandStudent

        return CommandStudent(arguments.command, limits, _account(arguments))
    from lucida.app.checking.running.file import FileStudent

    path = Path(arguments.file)
    if path.suffix.lower() not in PYTHON:
        problem, remedy = "is not a Python file", "--command runs other programs: lucida check -h"
        raise LucidaError("", problem, remedy, str(path))
    return FileStudent(path, limits, arguments.python or "", _account(arguments))


def _write_starter(arguments: argparse.Namespace) -> int:
    from lucida.app.checking.own_words import starter
    from lucida.renderer.system.atomic import atomic_write

    tasks, _ = all_tasks(arguments.tasks)
    if arguments.starter != "all":
        first = named(tasks, arguments.starter, "--starter")
        tasks = [task for task in tasks if task.function == first.function]
    text = starter(tasks)
    if arguments.output is None:
        common.say(text.rstrip("\n"))
        return 0
    path = Path(arguments.output)
    if os.path.lexists(path):
        problem, remedy = "is there already", "give another name, or delete it first"
        raise LucidaError("-o", problem, remedy, str(path))
    with atomic_write(path) as file:
        file.write(text.encode())
    functions = dict.fromkeys(task.function for task in tasks)
    common.say(one_line(f"{path}: {', '.join(functions)}"))
    return 0
