"""Results on the terminal: one line for each task, and help if it is not correct."""

from __future__ import annotations

import os
from typing import TextIO

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.reports.told import VERDICTS, of_points, told
from lucida.renderer.system.errors import one_line, visible

MOST = 8  # printed lines to show
COLORS = {"right": "32", "wrong": "31", "failed": "33", "dim": "2"}


def is_colored(stream: TextIO) -> bool:
    """Return True if a stream is a terminal and may be coloured: https://no-color.org."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def lines(result: TaskResult, colored: bool = False) -> list[str]:
    """Return the lines about a task, as far as its feedback allows."""
    say = told(result)
    name = one_line(result.task.name)
    if say.verdict is None:
        return [f"{_painted('tried  ', 'dim', colored)} {name}"]
    head = f"{_painted(f'{VERDICTS.get(say.verdict, say.verdict):7}', say.verdict, colored)} {name}"
    points = f"  {of_points(result.points, result.task.points)}"
    head += _painted(points, "dim", colored)
    printed = (_painted(line, "dim", colored) for line in _printed(say.output))
    told_lines = [visible(line) for line in say.lines]
    return [head, *(f"        {line}" for line in (*told_lines, *printed))]


def _printed(output: str) -> list[str]:
    """Return the output of the student's code, shortened."""
    lines = output.split("\n") if output else []
    if not lines:
        return []
    more = [f"... and {len(lines) - MOST} lines more"] if len(lines) > MOST else []
    return ["printed:", *(f"  {line}" for line in lines[:MOST]), *(f"  {line}" for line in more)]


def _painted(text: str, color: str, colored: bool) -> str:
    return f"\x1b[{COLORS[color]}m{text}\x1b[0m" if colored else text
