"""The part of a result that the task's feedback allows to report: as lines on the terminal, and for
Gradescope's autograder.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from lucida.app.checking.checked import Status, TaskResult
from lucida.app.checking.own_words import signature
from lucida.app.checking.tasks import FEEDBACK, CheckTask, Failure
from lucida.renderer.system.errors import one_line, visible

if TYPE_CHECKING:
    from lucida.app.checking.mistakes.diagnosis import Diagnosis

VERDICTS = {"right": "correct"}  # a status in words, where it is not its own
MOST = 8  # printed lines to show on the terminal
OUTPUT_LETTERS = 4000  # characters of the student's output for Gradescope


@dataclass(frozen=True)
class Told:
    """The reported part of a result.

    verdict: None if it is withheld.
    is_right: also if the verdict is withheld.
    lines: all that helps: the reason for a failure with the student's own lines, or the diagnosis
    and the first wrong case.
    output: the text that the student's code printed.
    mistakes: those of the diagnosis, as results.py reads them.
    """

    task: CheckTask
    verdict: Status | None
    points: float = 0.0
    is_right: bool = False
    lines: tuple[str, ...] = ()
    output: str = ""
    mistakes: tuple[dict[str, str], ...] = ()


def told(result: TaskResult) -> Told:
    """Return what may be reported.

    The reason for a failure, with the call that led to it, is always included: without it, nobody
    could correct the code.
    """
    task = result.task
    feedback = FEEDBACK.index(task.feedback)
    output = visible(result.output.replace("\r\n", "\n")).rstrip()
    if result.failure is not None:
        lines = one_line(result.failure.text), *failure_lines(result.failure)
        return Told(task, "failed", lines=lines, output=output)
    is_right = result.status == "right"
    if feedback == 0:
        return Told(task, None, result.points, is_right)
    if is_right or feedback == 1:
        return Told(task, result.status, result.points, is_right, output=output)
    diagnosis = result.diagnosis if feedback == 3 else None
    sentences = diagnosis.sentences if diagnosis else ()
    mistakes = _mistakes(diagnosis) if diagnosis else ()
    lines = *sentences, *_first_wrong(result)
    return Told(task, "wrong", lines=lines, output=output, mistakes=mistakes)


def _first_wrong(result: TaskResult) -> list[str]:
    """Return the number of wrong cases, and the first one."""
    first = result.first
    if first is None:
        return []
    are = "is" if result.wrong == 1 else "are"
    lines = [
        f"{result.wrong} of {result.cases} cases {are} wrong; the first one:",
        first.where,
        first.call,
        f"correct: {first.right}",
        f"given: {first.given}",
    ]
    return [line for line in lines if line]


def _mistakes(diagnosis: Diagnosis) -> tuple[dict[str, str], ...]:
    """Return the likeliest mistakes by name; without a name, the first sentence."""
    if not diagnosis.candidates:
        return tuple({"mistake": text, "reply": text} for text in diagnosis.sentences[:1])
    return tuple(
        {"mistake": mistake.name, "reply": mistake.hint, "read": mistake.part}
        for mistake in diagnosis.candidates[0]
    )


def summary(tried: Sequence[TaskResult], tasks: Sequence[CheckTask]) -> str:
    """Return one line on all results; only their number if a verdict is withheld."""
    if any(told(result).verdict is None for result in tried):
        return f"{len(tried)} {'task was' if len(tried) == 1 else 'tasks were'} tried."
    right = sum(result.status == "right" for result in tried)
    points = sum(result.points for result in tried), sum(task.points for task in tasks)
    return f"{right} of {len(tasks)} tasks correct, {of_points(*points)}"


def of_points(points: float, most: float) -> str:
    return f"{points:g} of {most:g} {'point' if most == 1 else 'points'}"


def failure_lines(failure: Failure) -> list[str]:
    """Return the student's own lines, without the last one if the failure's text repeats it."""
    lines = [visible(line.rstrip()) for line in failure.traceback]
    if lines and lines[-1] in failure.text:
        del lines[-1]
    return lines if len(lines) > 1 else []


def terminal_lines(result: TaskResult) -> list[str]:
    """Return a task's verdict in a line for the terminal, and help if it is not correct."""
    say = told(result)
    name = one_line(result.task.name)
    if say.verdict is None:
        return [f"tried   {name}"]
    points = of_points(result.points, result.task.points)
    head = f"{VERDICTS.get(say.verdict, say.verdict):7} {name}  {points}"
    printed = say.output.split("\n") if say.output else []
    if len(printed) > MOST:
        printed[MOST:] = [f"... and {len(printed) - MOST} lines more"]
    lines = [*map(visible, say.lines), *["printed:"][: len(printed)], *(f"  {p}" for p in printed)]
    return [head, *(f"        {line}" for line in lines)]


def gradescope(
    tried: Sequence[TaskResult],
    tasks: Sequence[CheckTask],
    seconds: float,
    problem: str = "",
) -> dict[str, Any]:
    """Return Gradescope's results.json as JSON values. Each task is a test.

    https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format

    A test omits what the task's feedback withholds. It is hidden if nothing may be shown.

    tried: the results that exist.
    tasks: all required tasks. Those without a result failed.
    problem: the reason if nothing could be run at all.
    """
    names = {result.task.name for result in tried}
    why = (problem or "was not tried",)
    untried = [Told(task, "failed", lines=why) for task in tasks if task.name not in names]
    every = enumerate([*map(told, tried), *untried], 1)
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
        "tests": [{**_test(one), "number": str(number)} for number, one in every],
    }


def _test(one: Told) -> dict[str, Any]:
    lines = list(one.lines)
    if one.output:
        lines += [""] * bool(lines) + ["Printed:", one.output[:OUTPUT_LETTERS]]
    test = {
        "name": f"{one.task.name}: {signature(one.task)}",
        "max_score": one.task.points,
        "score": one.points,
        "status": "passed" if one.is_right else "failed",
        "output": "\n".join(lines) or ("Correct." if one.verdict == "right" else ""),
        "visibility": "hidden" if one.verdict is None else "visible",
    }
    return {**test, "extra_data": {"mistakes": one.mistakes}} if one.mistakes else test
