"""Checking a task: call the student's code, read its answers, compare them, report the result."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds.kind import CheckKind
from lucida.app.checking.running.program import ProgramStudent, told_call
from lucida.app.checking.tasks import CheckCase, CheckTask, Failure, Run
from lucida.renderer.files.reading import close_matches

if TYPE_CHECKING:
    from lucida.app.checking.mistakes.diagnosis import Diagnosis

Status = Literal["right", "wrong", "failed"]
LONGEST_VALUE = 400  # characters of an argument, enough to try the case by hand
CHANGES = (
    "Asked again, the first wrong case has another answer: is there a random number in it, or does "
    "it keep something from one call to the next?"
)


@dataclass(frozen=True)
class WrongCase:
    """A case with a wrong answer, in words and in numbers.

    call: the call, with its arguments.
    right, given: the answers as the function would write them.
    where: the pixel.
    answer: the given answer in the kind's own form, like case.right.
    """

    case: CheckCase
    call: str
    right: str
    given: str
    where: str
    answer: Any


@dataclass(frozen=True)
class TaskResult:
    """The result of a task.

    points: the points earned.
    cases, wrong: the number of cases, and of wrong ones.
    failure: the reason why the task could not be tried, with the call that led to it.
    output: the text that the student's code printed.
    """

    task: CheckTask
    status: Status
    points: float
    cases: int
    wrong: int = 0
    first: WrongCase | None = None
    failure: Failure | None = None
    diagnosis: Diagnosis | None = None
    output: str = ""


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
    result = judged(task, cases, student.call(kind.calls(task, cases)))
    if result.status == "wrong" and task.feedback == "diagnosis":
        return _asked_again(student, result)
    return result


def _asked_again(student: ProgramStudent, result: TaskResult) -> TaskResult:
    """Call the first wrong case again, twice, in a program that remembers no other call. If an
    answer has changed, add a sentence on that to the result.
    """
    task, first = result.task, result.first
    assert first is not None
    kind = KINDS[task.kind]
    student.restart()
    cases = [first.case, first.case]
    run = student.call(kind.calls(task, cases))
    if run.failure is not None or any(isinstance(value, Failure) for value in run.values):
        return result
    given, problems = kind.given(task, cases, run.values)
    if problems or np.array_equal(
        np.asarray(given, float), np.asarray([first.answer] * 2, float), equal_nan=True
    ):
        return result
    told = result.diagnosis
    assert told is not None
    return replace(result, diagnosis=replace(told, sentences=(CHANGES, *told.sentences)))


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
        return TaskResult(task, "right", task.points, len(cases), output=run.output)
    return TaskResult(
        task,
        "wrong",
        0.0,
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
    # Loads the mistakes, so only if there are some.
    from lucida.app.checking.mistakes.diagnosis import diagnosis

    return diagnosis(task, cases, given, wrong)


def failed(task: CheckTask, failure: Failure, cases: int = 0, output: str = "") -> TaskResult:
    """Return the result of a task that could not be tried."""
    return TaskResult(task, "failed", 0.0, cases, failure=failure, output=output)


def status_of(results: Sequence[TaskResult]) -> int:
    """Return the exit status: 0 all correct, 1 wrong answers, 2 could not be run."""
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
) -> WrongCase:
    number = int(np.argmax(wrong))
    case = cases[number]
    where, right, answer = kind.first_wrong(task, case, given[number])
    (call,) = kind.calls(task, [case])
    return WrongCase(case, told_call(call, LONGEST_VALUE), right, answer, where, given[number])
