"""Results for Gradescope's autograder: results.json, with the documented fields.

https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.reports.told import Reported, reported, summary
from lucida.app.checking.starter import signature
from lucida.app.checking.tasks import CheckTask

OUTPUT_LETTERS = 4000  # characters of the student's output


def results(
    tried: Sequence[TaskResult],
    tasks: Sequence[CheckTask],
    seconds: float,
    problem: str = "",
) -> dict[str, Any]:
    """Return results.json as JSON values. Each task is a test.

    A test omits what the task's feedback withholds. It is hidden if nothing may be shown.

    tried, tasks, problem: as in told.reported.
    """
    tests = [_test(one) for one in reported(tried, tasks, problem)]
    for number, test in enumerate(tests, 1):
        test["number"] = str(number)
    return {
        "score": round(sum(result.points for result in tried), 6),
        "execution_time": round(seconds, 3),
        "output": problem or summary(tried, tasks),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": {"lucida": "check", "time": datetime.now(UTC).isoformat(timespec="seconds")},
        "tests": tests,
    }


def _test(one: Reported) -> dict[str, Any]:
    say = one.say
    lines = list(say.lines)
    if say.output:
        lines += [""] * bool(lines) + ["Printed:", say.output[:OUTPUT_LETTERS]]
    test = {
        "name": f"{one.task.name}: {signature(one.task)}",
        "max_score": one.task.points,
        "score": one.points,
        "status": "passed" if one.is_right else "failed",
        "output": "\n".join(lines) or ("Correct." if say.verdict == "right" else ""),
        "visibility": "hidden" if say.verdict is None else "visible",
    }
    return {**test, "extra_data": {"mistakes": say.mistakes}} if say.mistakes else test
