"""Check a task: call the student's code, read its answers, compare them, report the result."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import close_matches
from lucida.renderer.system.errors import one_line, visible

from .kinds import KINDS
from .kinds.kind import CheckKind
from .running.program import ProgramStudent, told_call
from .tasks import CheckCase, CheckTask, Failure, Run

if TYPE_CHECKING:
    from .mistakes.diagnosis import Diagnosis

Status = Literal["right", "wrong", "failed"]
LONGEST_VALUE = 400  # characters of an argument, enough to try the case by hand


@dataclass(frozen=True)
class TaskResult:
    """The result of a task.

    cases, wrong: the number of cases, and of wrong ones.
    first: lines on the first wrong case: the pixel, the call with its arguments, the correct answer
    and the given one.
    failure: the reason why the task could not be tried, with the call that led to it.
    output: the text that the student's code printed.
    """

    task: CheckTask
    status: Status
    cases: int = 0
    wrong: int = 0
    first: tuple[str, ...] = ()
    failure: Failure | None = None
    diagnosis: Diagnosis | None = None
    output: str = ""

    @property
    def points(self) -> float:
        """The points earned, which are all or none."""
        return self.task.points if self.status == "right" else 0.0

    @property
    def verdict(self) -> Status | None:
        """The status; None if the task's feedback withholds it. A failure is never withheld."""
        withheld = self.task.feedback == "nothing" and self.failure is None
        return None if withheld else self.status

    @property
    def lines(self) -> tuple[str, ...]:
        """All helpful lines that the task's feedback allows.

        The reason for a failure, with the call that led to it, is always included, because the code
        could not be corrected without it.
        """
        if self.failure is not None:
            return one_line(self.failure.text), *failure_lines(self.failure)
        if not self.first or self.task.feedback in ("nothing", "verdict"):
            return ()
        sentences = self.diagnosis.sentences if self.diagnosis is not None else ()
        are = "is" if self.wrong == 1 else "are"
        count = f"{self.wrong} of {self.cases} cases {are} wrong; the first one:"
        return *sentences, count, *self.first

    @property
    def printed(self) -> str:
        """The printed text, without terminal control codes."""
        if self.verdict is None:
            return ""
        return visible(self.output.replace("\r\n", "\n")).rstrip()


def failure_lines(failure: Failure) -> list[str]:
    """Return the student's own lines, without the last one if the failure's text repeats it."""
    lines = [visible(line.rstrip()) for line in failure.traceback]
    if lines and lines[-1] in failure.text:
        del lines[-1]
    return lines if len(lines) > 1 else []


def check(student: ProgramStudent, tasks: Sequence[CheckTask]) -> Iterator[TaskResult]:
    """Yield the results of the tasks in order, each as soon as it is known. Raises LucidaError if
    the student's code cannot be run at all.
    """
    functions = student.functions()
    for task in tasks:
        if functions is not None and task.function not in functions:
            yield failed(task, _missing(task, functions))
        else:
            yield checked(student, task)


def checked(student: ProgramStudent, task: CheckTask) -> TaskResult:
    """Return the result of one task. The student's code must have its function."""
    kind = KINDS[task.kind]
    cases = kind.cases(task)
    return judged(task, cases, student.call(kind.calls(task, cases)))


def judged(task: CheckTask, cases: Sequence[CheckCase], run: Run) -> TaskResult:
    """Return the result of a run of all of a task's calls."""
    kind = KINDS[task.kind]
    failures = (
        replace(value, call=number)
        for number, value in enumerate(run.values)
        if isinstance(value, Failure)
    )
    failure = run.failure or next(failures, None)
    if failure is not None:
        return failed(task, failure, len(cases), run.output)
    given, problems = kind.given(task, cases, run.values)
    if problems:
        number = min(problems)
        (call,) = kind.calls(task, [cases[number]])
        failure = Failure("answer", f"{told_call(call)} {problems[number]}", call=number)
        return failed(task, failure, len(cases), run.output)
    wrong = kind.wrong(task, cases, given)
    if not wrong.any():
        return TaskResult(task, "right", len(cases), output=run.output)
    return TaskResult(
        task,
        "wrong",
        len(cases),
        int(np.count_nonzero(wrong)),
        _first_wrong(task, kind, cases, given, wrong),
        diagnosis=_diagnosis(task, cases, given, wrong),
        output=run.output,
    )


def _diagnosis(
    task: CheckTask, cases: Sequence[CheckCase], given: Any, wrong: NDArray[np.bool_]
) -> Diagnosis | None:
    if task.feedback != "diagnosis":
        return None
    # This loads the mistakes, so import it only if there are any.
    from .mistakes.diagnosis import diagnosis

    return diagnosis(task, cases, given, wrong)


def failed(task: CheckTask, failure: Failure, cases: int = 0, output: str = "") -> TaskResult:
    """Return the result of a task that could not be tried."""
    return TaskResult(task, "failed", cases, failure=failure, output=output)


def status_of(results: Sequence[TaskResult]) -> int:
    """Return the exit status: 0 if all are correct, 1 for wrong answers, 2 if it could not run."""
    statuses = {result.status for result in results}
    return 2 if "failed" in statuses else int("wrong" in statuses)


def _missing(task: CheckTask, functions: frozenset[str]) -> Failure:
    close = close_matches(task.function, functions)
    remedy = f"did you mean {close[0]}?" if close else "define it"
    return Failure("missing", f"there is no function {task.function}; {remedy}")


def _first_wrong(
    task: CheckTask,
    kind: CheckKind,
    cases: Sequence[CheckCase],
    given: Any,
    wrong: NDArray[np.bool_],
) -> tuple[str, ...]:
    number = int(np.argmax(wrong))
    case, answer = cases[number], given[number]
    where, right, shown = kind.first_wrong(task, case, answer)
    (call,) = kind.calls(task, [case])
    lines = where, told_call(call, LONGEST_VALUE), f"correct: {right}", f"given: {shown}"
    return lines if where else lines[1:]
