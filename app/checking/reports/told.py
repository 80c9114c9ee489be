"""What a result tells, as far as the task's feedback allows: the words that all reports share."""

from __future__ import annotations

from dataclasses import dataclass

from app.checking.checked import Status, TaskResult
from app.checking.tasks import FEEDBACK
from renderer.errors import one_line


@dataclass(frozen=True)
class Told:
    """verdict: None where it is kept back. lines: what helps."""

    verdict: Status | None
    lines: tuple[str, ...] = ()


def told(result: TaskResult) -> Told:
    """Of a task that could not be tried, why is always told, with the call that led to it: else it
    could not be mended."""
    feedback = FEEDBACK.index(result.task.feedback)
    if result.status == "failed":
        return Told("failed", tuple(_failure(result)))
    if feedback == 0:
        return Told(None)
    if result.status == "right" or feedback == 1:
        return Told(result.status)
    lines = list(result.diagnosis.sentences) if feedback == 3 and result.diagnosis else []
    return Told("wrong", (*lines, *_first_wrong(result)))


def _first_wrong(result: TaskResult) -> list[str]:
    first = result.first
    if first is None:
        return []
    lines = [f"{result.wrong} of {result.cases} cases are wrong; the first one:"]
    if first.where:
        lines.append(first.where)
    call = f"{result.task.function}({first.arguments})"
    return [*lines, call, f"right: {first.right}", f"given: {first.given}"]


def _failure(result: TaskResult) -> list[str]:
    """Why, and the student's own lines; the last of them is told in the first line already."""
    failure = result.failure
    assert failure is not None
    lines = [line.rstrip() for line in failure.traceback]
    if lines and lines[-1] in failure.text:
        del lines[-1]
    return [one_line(failure.text), *(lines if len(lines) > 1 else [])]
