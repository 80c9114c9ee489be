"""Results as lines on the terminal, and for Gradescope's autograder."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lucida.renderer.system.errors import one_line, visible

from .checked import TaskResult
from .own_words import signature
from .tasks import CheckTask

VERDICTS = {"right": "correct"}  # words for a status, if they differ from it
MOST = 8  # printed lines to show on the terminal
OUTPUT_LETTERS = 4000  # characters of the student's output for Gradescope


def summary(tried: Sequence[TaskResult], tasks: Sequence[CheckTask]) -> str:
    """Return one line on all results, or only their number if a verdict is withheld."""
    if any(result.verdict is None for result in tried):
        return f"{len(tried)} {'task was' if len(tried) == 1 else 'tasks were'} tried."
    right = sum(result.status == "right" for result in tried)
    points = sum(result.points for result in tried), sum(task.points for task in tasks)
    return f"{right} of {len(tasks)} tasks correct, {of_points(*points)}"


def of_points(points: float, most: float) -> str:
    return f"{points:g} of {most:g} {'point' if most == 1 else 'points'}"


def terminal_lines(result: TaskResult) -> list[str]:
    """Return a task's verdict in a line for the terminal, and help if it is not correct."""
    name, verdict = one_line(result.task.name), result.verdict
    if verdict is None:
        return [f"tried   {name}"]
    head = f"{VERDICTS.get(verdict, verdict):7} {name}  "
    printed = result.printed.split("\n") if result.printed else []
    if len(printed) > MOST:
        printed[MOST:] = [f"... and {len(printed) - MOST} lines more"]
    lines = [*map(visible, result.lines), *["printed:"][: len(printed)]]
    lines += [f"  {line}" for line in printed]
    return [head + of_points(result.points, result.task.points), *(" " * 8 + x for x in lines)]


def gradescope(
    tried: Sequence[TaskResult],
    tasks: Sequence[CheckTask],
    seconds: float,
    problem: str = "",
) -> dict[str, Any]:
    """Return Gradescope's results.json as JSON values. Each task is a test.

    https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format

    A test omits the details that the task's feedback withholds. It is hidden if nothing is left.

    tried: the results that exist.
    tasks: all required tasks. Those without a result failed.
    problem: the reason why nothing could be run, or "".
    """
    names = {result.task.name for result in tried}
    tests = [_test(result, "\n".join(result.lines)) for result in tried]
    tests += [
        _test(TaskResult(task, "failed"), problem or "was not tried")
        for task in tasks
        if task.name not in names
    ]
    return {
        "score": round(sum(result.points for result in tried), 6),
        "execution_time": round(seconds, 3),
        "output": problem or summary(tried, tasks),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [{**test, "number": str(number)} for number, test in enumerate(tests, 1)],
    }


def _test(result: TaskResult, text: str) -> dict[str, Any]:
    task, verdict = result.task, result.verdict
    if result.printed:
        text += "\n\n" * bool(text) + f"Printed:\n{result.printed[:OUTPUT_LETTERS]}"
    return {
        "name": f"{task.name}: {signature(task)}",
        "max_score": task.points,
        "score": result.points,
        "status": "passed" if result.status == "right" else "failed",
        "output": text or ("Correct." if verdict == "right" else ""),
        "visibility": "hidden" if verdict is None else "visible",
    }
