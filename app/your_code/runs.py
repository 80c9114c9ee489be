"""Runs a student's file in the background: for the window's camera, then for the built-in tasks.

Owns the thread that waits for the file's process, the newest question, and which answers are kept.
The newest question wins; one that is overtaken is given up, and its process ended where it takes
long. Knows nothing of windows.
"""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from app.checking.calls import Call, Failure, Limits, Run
from app.checking.checked import TaskResult, checked, failed
from app.checking.kinds import KINDS
from app.checking.running.file import FileStudent, NotRunnableError
from app.checking.tasks import CheckTask
from app.widgets.background import Background
from app.your_code.model import (
    CodeRays,
    cases_for,
    chosen_of,
    for_camera,
    is_of_camera,
    rays_of,
    tasks_of,
)
from app.your_code.report import CodeQuestion, CodeReport
from renderer.errors import LucidaError, describe

LIMITS = Limits(seconds=10.0)
OVERTAKEN_S = 0.3  # what has run for so long, and is not wanted any more, is ended
SLOW_S = 0.25  # a file whose run took longer is run once the camera has rested as long
KEPT = 16  # answers for cameras that undo may come back to


class CodeStudent(Protocol):
    """FileStudent, as far as it is used."""

    @property
    def answered(self) -> int: ...
    def functions(self) -> frozenset[str] | None: ...
    def call(self, calls: Sequence[Call]) -> Run: ...
    def stop(self) -> None: ...
    def close(self) -> None: ...


def file_student(path: Path) -> CodeStudent:
    return FileStudent(path, LIMITS)


class CodeRuns:
    """wake: called from the thread when there is news. make: what answers for a file.

    report: the newest; None before the first. Methods are for the window's thread, but for tick().
    """

    def __init__(
        self, wake: Callable[[], None], make: Callable[[Path], CodeStudent] = file_student
    ) -> None:
        self._wake, self._make = wake, make
        self._background: Background[None] = Background("lucida-your-code", wake)
        self._lock = threading.Lock()
        self._student: tuple[tuple[str, int], CodeStudent] | None = None
        self._newest: CodeQuestion | None = None
        self._calls = 0  # that are being made for a picture
        self._begun: tuple[CodeQuestion, float] | None = None  # what runs, since when
        self._stopped = False  # by the user
        self._closed = threading.Event()
        self._kept: OrderedDict[CodeQuestion, CodeRays] = OrderedDict()  # used in the thread
        self.report: CodeReport | None = None

    def follow(self, question: CodeQuestion | None) -> None:
        """Once a frame: what is to be known; None for nothing. A file that has run endlessly is not
        run again until it is another version."""
        report = self.report
        if question is None or question == self._newest:
            return
        if report is not None and report.halted and _version(report.question) == _version(question):
            return
        self._newest = question
        self._background.submit(lambda: self._work(question))

    @property
    def busy(self) -> bool:
        return self._background.busy

    def poll(self) -> None:
        """Once a frame: takes note of the thread's end."""
        outcome = self._background.poll()
        if outcome is not None and outcome.error is not None and self._newest is not None:
            failure = Failure("ended", describe(outcome.error))
            self.report = CodeReport(self._newest, failure=failure)

    @property
    def running_s(self) -> float:
        """How long the file has been running for the present question; 0 where it is not."""
        begun = self._begun
        return time.monotonic() - begun[1] if begun is not None else 0.0

    @property
    def progress(self) -> float:
        """How much of the picture is there, 0 to 1."""
        student, calls = self._student, self._calls
        return min(1.0, student[1].answered / calls) if student is not None and calls else 0.0

    def stop(self) -> None:
        """Ends what runs; its report says so."""
        self._stopped = True
        self._end_run()

    def forget(self) -> None:
        """Another file, or none: what was known is of no use."""
        self._newest = self.report = None
        self._end_run()

    def tick(self) -> None:
        """From any thread, now and then: ends what is overtaken."""
        begun = self._begun
        if begun is None or begun[0] is self._newest:
            return
        if time.monotonic() - begun[1] > OVERTAKEN_S:
            self._end_run()

    def _end_run(self) -> None:
        student = self._student
        if student is not None and self._begun is not None:
            student[1].stop()

    def close(self) -> None:
        """Ends the file's process."""
        self._newest = None
        self._closed.set()
        with self._lock:
            student, self._student = self._student, None
        if student is not None:
            closing = threading.Thread(target=student[1].close, daemon=True)
            closing.start()
            closing.join(2.0)
        self._background.close()

    # In the thread.

    def _is_wanted(self, question: CodeQuestion) -> bool:
        return question is self._newest

    def _publish(self, report: CodeReport) -> CodeReport:
        if self._is_wanted(report.question):
            self.report = report
            self._wake()
        return report

    def _student_of(self, question: CodeQuestion) -> CodeStudent:
        """The file's process, or a new one for another version."""
        version = _version(question)
        with self._lock:
            if self._student is not None and self._student[0] == version:
                return self._student[1]
            old, self._student = self._student, None
            if not self._closed.is_set():
                self._student = version, self._make(Path(question.path))
            made = self._student
        if old is not None:
            old[1].close()
        if made is None:
            raise LucidaError("", "the window is closed")
        return made[1]

    def _work(self, question: CodeQuestion) -> None:
        before = self.report
        if before is not None and _version(before.question) != _version(question):
            before = None
            self._kept.clear()
        if before is not None and before.seconds > SLOW_S and question not in self._kept:
            self._closed.wait(SLOW_S)  # the camera may move on
        if not self._is_wanted(question) or self._closed.is_set():
            return
        begin = time.monotonic()
        self._begun, self._stopped = (question, begin), False
        try:
            self._tell(question, before, begin)
        finally:
            self._begun, self._calls = None, 0

    def _tell(self, question: CodeQuestion, before: CodeReport | None, begin: float) -> None:
        try:
            student = self._student_of(question)
            functions = student.functions()
        except NotRunnableError as error:
            report = CodeReport(question, failure=error.failure, output=error.output)
            self._publish(_timed(report, begin))
            return
        except LucidaError as error:
            self._publish(_timed(CodeReport(question, failure=_missing(error)), begin))
            return
        tasks = tasks_of(functions)
        chosen = chosen_of(tasks, question.task)
        report = CodeReport(
            question,
            tuple(tasks),
            chosen,
            results=before.results if before is not None else {},
            at=time.time(),
        )
        if chosen is not None and is_of_camera(chosen):
            rays = self._rays(question, for_camera(chosen, question.camera), student)
            report = replace(report, rays=rays, output=rays.result.output, seconds=rays.seconds)
        report = self._publish(report)
        for task in tasks:
            if self._stopped or not self._is_wanted(question):
                return
            if task.name not in report.results:
                results = {**report.results, task.name: _tried(student, task, report)}
                report = self._publish(replace(report, results=results))

    def _rays(self, question: CodeQuestion, task: CheckTask, student: CodeStudent) -> CodeRays:
        if question in self._kept:
            return self._kept[question]
        camera, size = question.camera, question.size
        cases = cases_for(task, camera, size)
        calls = KINDS[task.kind].calls(task, cases)
        begin, self._calls = time.monotonic(), len(calls)
        run = student.call(calls)
        self._calls = 0
        rays = rays_of(task, camera, size, cases, run, time.monotonic() - begin)
        if run.failure is None:
            self._kept[question] = rays
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        return rays


def _version(question: CodeQuestion) -> tuple[str, int]:
    return question.path, question.version


def _timed(report: CodeReport, begin: float) -> CodeReport:
    return replace(report, seconds=time.monotonic() - begin, at=time.time())


def _missing(error: LucidaError) -> Failure:
    return Failure("missing", describe(error))


def _tried(student: CodeStudent, task: CheckTask, report: CodeReport) -> TaskResult:
    """The result of a task; of a function that runs endlessly it is known already."""
    rays = report.rays
    if rays is not None and report.halted and rays.task.function == task.function:
        assert rays.result.failure is not None
        return failed(task, rays.result.failure)
    return checked(student, task)
