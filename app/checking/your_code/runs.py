"""Run a student's file in the background, for the window's camera and then for others.

The newest question wins. A run of an older question is ended if it takes long.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from lucida.app.checking.checked import checked
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.running.file import FileStudent, NotRunnableError
from lucida.app.checking.tasks import CheckTask, Failure, Limits
from lucida.app.ui.background import Background, Outcome
from lucida.renderer.system.errors import describe

from .model import RAY, CodeQuestion, CodeReport, cases_for, ray_task_for, rays_of

LIMITS = Limits(seconds=10.0)
OVERTAKEN_S = 0.3  # a run of an older question is ended if it takes longer


@dataclass(frozen=True)
class _Work:
    """A run. question: None if its result is no longer needed."""

    question: CodeQuestion | None
    begun_s: float


class CodeRuns:
    """The runs of a file, one after another. Call methods on the window's thread.

    make: creates the student for a file.
    report: the newest report; None before the first.
    """

    def __init__(self, make: Callable[[Path, Limits], FileStudent] = FileStudent) -> None:
        self._make = make
        self._background: Background[CodeReport] = Background("lucida-your-code")
        self._student: FileStudent | None = None
        self._file: tuple[str, int] | None = None  # the student's path and version
        self._work: _Work | None = None
        self._newest: CodeQuestion | None = None
        self._stopped = False  # by the user
        self.report: CodeReport | None = None

    @property
    def busy(self) -> bool:
        return self._work is not None or self._wanted() is not None

    @property
    def running_s(self) -> float:
        """The time for which the file has been running, in seconds; 0 if it is not."""
        return time.monotonic() - self._work.begun_s if self._work is not None else 0.0

    def follow(self, question: CodeQuestion) -> None:
        """Ask a question, take the answer of the run that has ended, and begin the next run. Call
        once a frame.

        A file that did not end is not run again for another camera, but only for another version or
        size.
        """
        self.poll()
        self._newest, work = question, self._work
        if work is not None:
            is_late = work.question != question and self.running_s > OVERTAKEN_S
            if is_late:
                self._work = replace(work, question=None)
            if self._student is not None and (self._stopped or is_late):
                self._student.stop()
        elif (wanted := self._wanted()) is not None:
            self._begin(question, wanted)

    def poll(self) -> None:
        """Take the answer of the run that has ended."""
        outcome = self._background.poll()
        if outcome is None or self._work is None:
            return
        work, self._work = self._work, None
        if work.question is not None:
            self.report = _report(work.question, outcome)

    def stop(self) -> None:
        """End the current run. Its report mentions this, and nothing else is tried."""
        self._stopped = True

    def forget(self) -> None:
        """Discard all results and end the process, because there is no file or to start over."""
        self._newest = self.report = self._file = None
        if self._work is not None:
            self._work = replace(self._work, question=None)
        if self._student is not None:
            self._student.stop()

    def close(self) -> None:
        """End the file's process."""
        self.forget()
        self._background.close()

    def _wanted(self) -> Callable[[FileStudent], CodeReport] | None:
        """Return the next run; None if all answers are known."""
        question, report = self._newest, self.report
        if question is None:
            return None
        if report is not None and report.question == question:
            task = report.untried
            return None if task is None else partial(_tried, report=report, task=task)
        if report is not None and report.halted and question.differs_in_camera(report.question):
            return None
        return partial(_answered, question=question, before=report)

    def _begin(self, question: CodeQuestion, run: Callable[[FileStudent], CodeReport]) -> None:
        file = question.path, question.version
        if self._student is None or self._file != file:
            if self._student is not None:
                self._student.close()
            self._student, self._file = self._make(Path(question.path), LIMITS), file
        if self.report is None or self.report.question != question:
            self._stopped = False
        student, self._work = self._student, _Work(question, time.monotonic())
        self._background.submit(lambda: run(student))


def _report(question: CodeQuestion, outcome: Outcome[CodeReport]) -> CodeReport:
    """Return the report on a run, even if it failed."""
    match outcome.error:
        case None:
            assert outcome.value is not None
            return outcome.value
        case NotRunnableError(failure=failure, output=output):
            return CodeReport(question, failure=failure, output=output)
        case error:
            return CodeReport(question, failure=Failure("missing", describe(error)))


def _answered(
    student: FileStudent, question: CodeQuestion, before: CodeReport | None
) -> CodeReport:
    """Return the file's answer for the camera. Runs on a thread. Raises LucidaError."""
    task = ray_task_for(question.camera)
    if task.function not in student.functions():
        problem = f"it has no function {task.function}; `lucida check` tries the other ones"
        return CodeReport(question, failure=Failure("missing", problem))
    cases = cases_for(task, question.camera, question.size)
    run = student.call(KINDS[RAY].calls(task, cases))
    rays = rays_of(task, question.size, cases, run)
    is_known = before is not None and before.question.version == question.version
    results = before.results if before is not None and is_known else {}
    return CodeReport(question, rays, results, rays.result.failure, run.output)


def _tried(student: FileStudent, report: CodeReport, task: CheckTask) -> CodeReport:
    """Return the report with the result of a task. Runs on a thread."""
    return replace(report, results={**report.results, task.name: checked(student, task)})
