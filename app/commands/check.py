"""`lucida check`: a student's code beside the right answers."""

from __future__ import annotations

import argparse
import sys

NAME = "check"

DESCRIPTION = "Check what a student wrote."


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description = DESCRIPTION
    parser.add_argument("file", metavar="FILE")


def run(arguments: argparse.Namespace) -> int:
    from pathlib import Path

    from app.checking.builtin import BUILTIN
    from app.checking.checked import check, status_of
    from app.checking.in_process import InProcess
    from app.checking.reports import terminal

    student = InProcess(Path(arguments.file))
    functions = student.functions()
    tasks = [task for task in BUILTIN if task.function in functions]
    results = []
    for result in check(student, tasks):
        results.append(result)
        print("\n".join(terminal.lines(result, terminal.is_colored(sys.stdout))))
    print(terminal.summary(results))
    return status_of(results)
