"""Runs a student's file in the background: for the window's camera, then for all of its tasks.

The newest question wins. An overtaken one is given up, and its process ended if it takes long. The
slow work, the tasks, waits until the camera rests.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from lucida.app.checking.checked import TaskResult, checked, failed
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.running.file import FileStudent, NotRunnableError
from lucida.app.checking.task_file import TaskSet
from lucida.app.checking.tasks import CheckTask, Failure, Limits
from lucida.app.checking.your_code.model import (
    CodeContent,
    CodeQuestion,
    CodeReport,
    asked_of,
    cases_for,
    chosen_of,
    for_camera,
    is_of_camera,
    rays_of,
    tasks_of,
    why_not_asked,
)
from lucida.app.ui.background import Background
from lucida.renderer.system.errors import LucidaError, describe

OVERTAKEN_S = 0.3  # what has run for so long, and is not wanted any more, is ended
REST_S = 0.25  # the camera rests; a file whose run took longer is not run before


@dataclass(frozen=True, eq=False)
class _Opened:
    """One version of a file and of its tasks."""

    content: CodeContent
    student: FileStudent
    asked: TaskSet


class CodeRuns:
    """The runs of a file. Methods are for the window's thread.

    wake: called from the thread when there is news.
    make: makes the student for a file.
    report: the newest; None before the first.
    files: the modules that the file imported, or failed to import, when it was last read.
    """

    def __init__(
        self, wake: Callable[[], None], make: Callable[[Path, Limits], FileStudent] = FileStudent
    ) -> None:
        self._wake, self._make = wake, make
        self._background: Background[None] = Background("lucida-your-code", wake)
        self._lock = threading.Lock()  # while a run is ended, no other follows it
        self._opened: _Opened | None = None
        self._is_stale = False  # the opened file is to be opened anew
        self._newest: CodeQuestion | None = None
        self._asked = threading.Event()  # something newer, or the end
        self._run: tuple[CodeQuestion, float] | None = None  # what for, since when
        self._stopped = False  # by the user
        self.report: CodeReport | None = None
        self.files: tuple[str, ...] = ()

    def follow(self, question: CodeQuestion) -> None:
        """Ask a question. Call once a frame.

        A file that has run endlessly is not run again for another camera, but only for something
        that the user asks for here: another version, task, or size.
        """
        report = self.report
        if question == self._newest:
            return
        if report is not None and report.halted and question.differs_in_camera(report.question):
            return
        self._newest = question
        self._asked.set()
        self._background.submit(lambda: self._answer(question))

    @property
    def busy(self) -> bool:
        return self._background.busy

    def poll(self) -> None:
        """Notice the end of the work, and end a run that was overtaken or stopped. Call once a
        frame.
        """
        self._background.poll()
        with self._lock:
            if self._run is None or self._opened is None:
                return
            is_late = self.running_s > OVERTAKEN_S and not self._is_wanted(self._run[0])
            if self._stopped or is_late:
                self._opened.student.stop()

    @property
    def running_s(self) -> float:
        """The time that the file has been running, in seconds; 0 if it is not."""
        run = self._run
        return time.monotonic() - run[1] if run is not None else 0.0

    def stop(self) -> None:
        """End the current run, at the next poll(). Its report says so."""
        self._stopped = True

    def forget(self) -> None:
        """Discard all results and end the process, because there is no file any more, or to start
        over.
        """
        with self._lock:
            self._newest = self.report = None
            self._is_stale = True
            if self._opened is not None:
                self._opened.student.stop()
        self._asked.set()

    def close(self) -> None:
        """End the file's process."""
        self.forget()
        self._background.close()

    # On the thread.

    @contextmanager
    def _running(self, question: CodeQuestion) -> Iterator[None]:
        """Note that the process works on a question."""
        self._run = question, time.monotonic()
        try:
            yield
        finally:
            with self._lock:
                self._run = None

    def _is_wanted(self, question: CodeQuestion) -> bool:
        return question is self._newest

    def _rests(self, question: CodeQuestion) -> bool:
        """Wait until the camera rests. Return True if the question is still wanted then."""
        self._asked.clear()
        if self._is_wanted(question):
            self._asked.wait(REST_S)
        return self._is_wanted(question)

    def _publish(self, report: CodeReport) -> None:
        with self._lock:
            if not self._is_wanted(report.question):
                return
            self.report = report
        self._wake()

    def _open(self, content: CodeContent) -> _Opened:
        """Return the opened file, opened anew for another version. Raises LucidaError."""
        opened = self._opened
        if opened is not None and opened.content == content and not self._is_stale:
            return opened
        if opened is not None:
            opened.student.close()
        self._is_stale = False
        asked = asked_of(content.tasks)
        self._opened = _Opened(content, self._make(Path(content.path), asked.limits), asked)
        return self._opened

    def _answer(self, question: CodeQuestion) -> None:
        before = self.report
        if before is not None and before.question.content != question.content:
            before = None
        is_slow = before is not None and before.seconds > REST_S
        if is_slow and not self._rests(question):
            return
        if not self._is_wanted(question):
            return
        self._stopped = False
        begin = time.monotonic()
        try:
            with self._running(question):
                report = self._report(question, before)
            self._publish(replace(report, seconds=time.monotonic() - begin))
            self._check(question)
        except NotRunnableError as error:
            self._publish(CodeReport(question, failure=error.failure, output=error.output))
        except LucidaError as error:
            self._publish(CodeReport(question, failure=Failure("missing", describe(error))))
        except Exception as error:
            self._publish(CodeReport(question, failure=Failure("ended", describe(error))))

    def _report(self, question: CodeQuestion, before: CodeReport | None) -> CodeReport:
        """Return the file's answer for the camera. Raises LucidaError."""
        opened = self._open(question.content)
        student, asked = opened.student, opened.asked.tasks
        try:
            functions = student.functions()
        finally:
            self.files = student.files
        tasks = tuple(tasks_of(functions, asked))
        chosen = chosen_of(tasks, question.task)
        results = before.results if before is not None else {}
        report = CodeReport(question, tasks, chosen, results=results, asked=asked)
        if chosen is None or not is_of_camera(chosen):
            return report
        camera, size = question.camera, question.size
        task = for_camera(chosen, camera, asked)
        if problem := why_not_asked(task, camera, size):
            return replace(report, not_asked=problem)
        cases = cases_for(task, camera, size)
        rays = rays_of(task, size, cases, student.call(KINDS[task.kind].calls(task, cases)))
        return replace(report, rays=rays, output=rays.result.output)

    def _check(self, question: CodeQuestion) -> None:
        """Check the tasks that have not been tried."""
        opened, report = self._opened, self.report
        if opened is None or report is None or not self._rests(question):
            return
        results: dict[str, TaskResult] = dict(report.results)
        for task in report.tasks:
            if self._stopped or not self._is_wanted(question):
                return
            if task.name not in results:
                with self._running(question):
                    results[task.name] = _tried(opened.student, task, report)
                report = replace(report, results=dict(results))
                self._publish(report)  # unless it was ended on purpose: nobody wants it then


def _tried(student: FileStudent, task: CheckTask, report: CodeReport) -> TaskResult:
    """Return the result of a task. It is known already if the function runs endlessly."""
    rays = report.rays
    if rays is not None and report.halted and rays.task.function == task.function:
        assert rays.result.failure is not None
        return failed(task, rays.result.failure)
    return checked(student, task)
