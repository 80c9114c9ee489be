"""Runs a student's file in the background: for the window's camera, then for all of its tasks.

The newest question wins. An overtaken one is given up, and its process ended if it takes long. The
slow work, tasks and diagnosis, waits until the camera rests.
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
    CodeRays,
    CodeReport,
    asked_of,
    cases_for,
    chosen_of,
    diagnosis_of,
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
CLOSING_S = 2.0


@dataclass(frozen=True, eq=False)
class _Opened:
    """One version of a file and of its tasks."""

    content: CodeContent
    student: FileStudent
    asked: TaskSet


class CodeRuns:
    """The runs of a file. Methods are for the window's thread, except tick().

    wake: called from the thread when there is news.
    make: makes the student for a file.
    report: the newest; None before the first.
    files: the modules that the file imported, or failed to import, when it was last read.
    read_s: the start of that reading, on time.time()'s clock.
    """

    def __init__(
        self, wake: Callable[[], None], make: Callable[[Path, Limits], FileStudent] = FileStudent
    ) -> None:
        self._wake, self._make = wake, make
        self._background: Background[None] = Background("lucida-your-code", wake)
        self._lock = threading.Lock()  # of the opened file, and of the report
        self._opened: _Opened | None = None
        self._newest: CodeQuestion | None = None
        self._asked = threading.Event()  # something newer, or the end
        self._ending = threading.Lock()  # while a run is ended, no other follows it
        self._run: tuple[CodeQuestion, float] | None = None  # what for, since when
        self._stopped = self._closed = False  # by the user; for good
        self.report: CodeReport | None = None
        self.files: tuple[str, ...] = ()
        self.read_s = 0.0

    def follow(self, question: CodeQuestion) -> None:
        """Ask a question. Call once a frame.

        A file that has run endlessly is not run again for another camera, but only for something
        that the user asks for here: another version, task, or size.
        """
        report = self.report
        if question == self._newest or self._closed:
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
        """Notice the end of the work. Call once a frame."""
        self._background.poll()

    @property
    def running_s(self) -> float:
        """The time that the file has been running, in seconds; 0 if it is not."""
        run = self._run
        return time.monotonic() - run[1] if run is not None else 0.0

    def stop(self) -> None:
        """End the current run, at the next tick(). Its report says so."""
        self._stopped = True

    def forget(self) -> None:
        """Discard all results, because there is no file any more, or to start over."""
        with self._lock:
            self._newest = self.report = None
        self._asked.set()
        self._close_student()

    def tick(self) -> None:
        """End a run that was overtaken or stopped. Call now and then, from any thread but the
        window's.

        May take a while.
        """
        with self._ending:
            opened, run = self._opened, self._run
            if opened is None or run is None:
                return
            is_late = time.monotonic() - run[1] > OVERTAKEN_S
            if self._stopped or (is_late and not self._is_wanted(run[0])):
                opened.student.stop()

    def close(self) -> None:
        """End the file's process."""
        self._newest, self._closed = None, True
        self._asked.set()
        closing = self._close_student()
        if closing is not None:
            closing.join(CLOSING_S)
        self._background.close()

    def _close_student(self) -> threading.Thread | None:
        """End the process on a thread, because reading the file may delay it."""
        with self._lock:
            opened, self._opened = self._opened, None
        if opened is None:
            return None
        closing = threading.Thread(target=opened.student.close, daemon=True)
        closing.start()
        return closing

    # On the thread.

    @contextmanager
    def _running(self, question: CodeQuestion) -> Iterator[float]:
        """Note that the process works on a question. Yield the starting time."""
        begin = time.monotonic()
        self._run = question, begin
        try:
            yield begin
        finally:
            with self._ending:
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

    def _open(self, question: CodeQuestion) -> _Opened:
        """Return the opened file, opened anew for another version. Raises LucidaError."""
        opened = self._opened
        if opened is not None and opened.content == question.content:
            return opened
        asked = asked_of(question.content.tasks, question.content.notation)
        with self._lock:
            old, self._opened = self._opened, None
            if self._is_wanted(question):
                self.read_s = time.time()
                student = self._make(Path(question.content.path), asked.limits)
                self._opened = _Opened(question.content, student, asked)
            made = self._opened
        if old is not None:
            old.student.close()
        if made is None:
            raise LucidaError("", "nobody waits for it")
        return made

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
            self._publish(replace(report, seconds=time.monotonic() - begin, at=time.time()))
            self._check(question)
        except NotRunnableError as error:
            self._publish(CodeReport(question, failure=error.failure, output=error.output))
        except LucidaError as error:
            self._publish(CodeReport(question, failure=Failure("missing", describe(error))))
        except Exception as error:
            self._publish(CodeReport(question, failure=Failure("ended", describe(error))))

    def _report(self, question: CodeQuestion, before: CodeReport | None) -> CodeReport:
        """Return the file's answer for the camera. Raises LucidaError."""
        opened = self._open(question)
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
        task = for_camera(chosen, question.camera, asked)
        if problem := why_not_asked(task, question.camera, question.size):
            return replace(report, not_asked=problem)
        rays = _rays(question, task, student)
        return replace(report, rays=rays, output=rays.result.output)

    def _check(self, question: CodeQuestion) -> None:
        """Check the tasks that have not been tried, then find out why the picture is wrong."""
        opened, report = self._opened, self.report
        if opened is None or report is None or not self._rests(question):
            return
        results: dict[str, TaskResult] = dict(report.results)
        for task in report.tasks:
            if self._stopped or not self._is_wanted(question):
                return
            if task.name not in results:
                with self._running(question):
                    result = _tried(opened.student, task, report)
                if not self._is_wanted(question):  # it may have been ended on purpose
                    return
                results[task.name] = result
                report = replace(report, results=dict(results))
                self._publish(report)
        rays = report.rays
        if rays and rays.result.status == "wrong" and rays.task.feedback == "diagnosis":
            self._publish(replace(report, diagnosis=diagnosis_of(rays)))


def _rays(question: CodeQuestion, task: CheckTask, student: FileStudent) -> CodeRays:
    camera, size = question.camera, question.size
    cases = cases_for(task, camera, size)
    return rays_of(task, size, cases, student.call(KINDS[task.kind].calls(task, cases)))


def _tried(student: FileStudent, task: CheckTask, report: CodeReport) -> TaskResult:
    """Return the result of a task. It is known already if the function runs endlessly."""
    rays = report.rays
    if rays is not None and report.halted and rays.task.function == task.function:
        assert rays.result.failure is not None
        return failed(task, rays.result.failure)
    return checked(student, task)
