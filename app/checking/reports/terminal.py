"""Results on the terminal: a line a task, and what helps where one is not right."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TextIO

from app.checking.checked import TaskResult
from app.checking.reports.told import of_points, told
from renderer.errors import one_line, visible

MOST = 8  # lines of what it printed
COLORS = {"right": "32", "wrong": "31", "failed": "33", "dim": "2"}


def is_colored(stream: TextIO) -> bool:
    """Whether a stream is a terminal that may be coloured: https://no-color.org."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def lines(result: TaskResult, colored: bool = False) -> list[str]:
    """What is told of a task, as far as its feedback goes."""
    say = told(result)
    name = one_line(result.task.name)
    if say.verdict is None:
        return [f"{_painted('tried ', 'dim', colored)} {name}"]
    head = f"{_painted(f'{say.verdict:6}', say.verdict, colored)} {name}"
    points = f"  {of_points(result.points, result.task.points)}"
    head += _painted(points, "dim", colored)
    printed = (_painted(line, "dim", colored) for line in _printed(say.output))
    told_lines = [visible(line) for line in say.lines]
    return [head, *(f"       {line}" for line in (*told_lines, *printed))]


def _printed(output: str) -> list[str]:
    """What the student's code printed, shortened."""
    lines = output.split("\n") if output else []
    if not lines:
        return []
    more = [f"... and {len(lines) - MOST} lines more"] if len(lines) > MOST else []
    return ["printed:", *(f"  {line}" for line in lines[:MOST]), *(f"  {line}" for line in more)]


def summary(results: Sequence[TaskResult]) -> str:
    """One line of all results; empty where a single one says it, or nothing is to be told."""
    if len(results) < 2 or any(told(result).verdict is None for result in results):
        return ""
    right = sum(result.status == "right" for result in results)
    points, most = sum(r.points for r in results), sum(r.task.points for r in results)
    return f"{right} of {len(results)} tasks right, {of_points(points, most)}"


def _painted(text: str, color: str, colored: bool) -> str:
    return f"\x1b[{COLORS[color]}m{text}\x1b[0m" if colored else text
