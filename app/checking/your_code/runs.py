"""Runs a student's file in the background: for the window's camera, then for the built-in tasks.

The newest question wins. An overtaken one is given up, and its process ended if it takes long. The
slow work, diagnosis and tasks, waits until the camera rests, and runs on a separate thread so that
pictures can follow the camera.
"""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from lucida.app.checking.calls import Failure, Limits
from lucida.app.checking.checked import TaskResult, checked, failed
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.running.file import FileStudent, NotRunnableError
from lucida.app.checking.task_file import TaskSet
from lucida.app.checking.tasks import CheckTask
from lucida.app.checking.your_code.model import (
    CodeRays,
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
from lucida.app.checking.your_code.report import CodeQuestion, CodeReport
from lucida.app.ui.background import Background
from lucida.renderer.system.errors import LucidaError, describe

OVERTAKEN_S = 0.3  # what has run for so long, and is not wanted any more, is ended
REST_S = 0.25  # the camera rests; a file whose run took longer is not run before
CLOSING_S = 2.0
KEPT = 16  # answers for cameras that undo may come back to


class CodeRuns:
    """The runs of a file. Methods are for the window's thread, except tick().

    wake: called from the threads when there is news.
    make: makes the student for a file.
    report: the newest; None before the first.
    files: the modules that the file imported, or failed to import, when it was last read.
    read_s: the start of that reading, on time.time()'s clock.
    """

    def __init__(
        self, wake: Callable[[], None], make: Callable[[Path, Limits], FileStudent] = FileStudent
    ) -> None:
        self._wake, self._make = wake, make
        self._pictures: Background[None] = Background("lucida-your-code", wake)
        self._checks: Background[None] = Background("lucida-your-checks", wake)
        self._lock = threading.Lock()  # of the student, and of the report
        self._student: tuple[tuple[str, str, int, str], FileStudent] | None = None
        self._newest: CodeQuestion | None = None
        self._asked = threading.Event()  # something newer, or the end
        self._calls = 0  # that are being made for a picture
        self._turn = threading.Lock()  # one thread at a time has the process
        self._ending = threading.Lock()  # while a run is ended, no other follows it
        self._run: tuple[CodeQuestion, float] | None = None  # what for, since when
        self._stopped = self._closed = False  # by the user; for good
        self._kept: OrderedDict[CodeQuestion, CodeRays] = OrderedDict()  # of one version
        self._tasks: tuple[tuple[str, str, int, str], TaskSet] | None = None  # of one version
        self.report: CodeReport | None = None
        self.files: tuple[str, ...] = ()
        self.read_s = 0.0

    def follow(self, question: CodeQuestion | None) -> None:
        """Ask a question, or None for nothing. Call once a frame.

        A file that has run endlessly is not run again for another camera, but only for something
        that the user asks for here: another version, task, or size.
        """
        report = self.report
        if question is None or question == self._newest or self._closed:
            return
        if report is not None and report.halted and question.differs_in_camera(report.question):
            return
        self._newest = question
        self._asked.set()
        self._pictures.submit(lambda: self._told(question, lambda: self._work(question)))

    @property
    def busy(self) -> bool:
        return self._pictures.busy or self._checks.busy

    def poll(self) -> None:
        """Notice the ends of threads. Call once a frame."""
        self._pictures.poll()
        self._checks.poll()

    @property
    def running_s(self) -> float:
        """The time that the file has been running, in seconds; 0 if it is not."""
        run = self._run
        return time.monotonic() - run[1] if run is not None else 0.0

    @property
    def progress(self) -> float:
        """The finished part of the picture, 0 to 1."""
        student, calls = self._student, self._calls
        return min(1.0, student[1].answered / calls) if student is not None and calls else 0.0

    def stop(self) -> None:
        """End the current run, at the next tick(). Its report says so."""
        self._stopped = True

    def forget(self) -> None:
        """Discard all results, because there is no file any more, or to start over."""
        with self._lock:
            self._newest = self.report = None
        self._kept = OrderedDict()
        self._asked.set()
        self._close_student()

    def tick(self) -> None:
        """End a run that was overtaken or stopped. Call now and then, from any thread but the
        window's.

        May take a while.
        """
        with self._ending:
            student, run = self._student, self._run
            if student is None or run is None:
                return
            is_late = time.monotonic() - run[1] > OVERTAKEN_S
            if self._stopped or (is_late and not self._is_wanted(run[0])):
                student[1].stop()

    def close(self) -> None:
        """End the file's process."""
        self._newest, self._closed = None, True
        self._asked.set()
        closing = self._close_student()
        if closing is not None:
            closing.join(CLOSING_S)
        self._pictures.close()
        self._checks.close()

    def _close_student(self) -> threading.Thread | None:
        """End the process on a thread, because reading the file may delay it."""
        with self._lock:
            student, self._student = self._student, None
        if student is None:
            return None
        closing = threading.Thread(target=student[1].close, daemon=True)
        closing.start()
        return closing

    # In the threads.

    @contextmanager
    def _running(self, question: CodeQuestion) -> Iterator[float]:
        """Note that the process works on a question, on this thread. Yield the starting time."""
        with self._turn:
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

    def _told(self, question: CodeQuestion, work: Callable[[], None]) -> None:
        """Run `work`. Report its error with this question, unless that was overtaken."""
        try:
            work()
        except Exception as error:
            self._publish(CodeReport(question, failure=Failure("ended", describe(error))))

    def _publish(self, report: CodeReport) -> None:
        with self._lock:
            if not self._is_wanted(report.question):
                return
            self.report = report
        self._wake()

    def _add(self, question: CodeQuestion, **changes: Any) -> None:
        """Find out more about a question."""
        with self._lock:
            report = self.report
            if report is None or report.question is not question:
                return
            self.report = replace(report, **changes)
        self._wake()

    def _asked_of(self, question: CodeQuestion) -> TaskSet:
        """Return the tasks, read once per version."""
        if self._tasks is None or self._tasks[0] != question.of:
            self._tasks = question.of, asked_of(question.tasks, question.notation)
        return self._tasks[1]

    def _student_of(self, question: CodeQuestion, limits: Limits) -> FileStudent:
        """Return the file's process, or a new one for another version."""
        with self._lock:
            if self._student is not None and self._student[0] == question.of:
                return self._student[1]
            old, self._student = self._student, None
            if not self._closed and self._is_wanted(question):
                self.read_s = time.time()
                self._student = question.of, self._make(Path(question.path), limits)
            made = self._student
        if old is not None:
            old[1].close()
        if made is None:
            raise LucidaError("", "nobody waits for it")
        return made[1]

    def _work(self, question: CodeQuestion) -> None:
        before = self.report
        if before is not None and before.question.of != question.of:
            before = None
            self._kept.clear()
        is_slow = before is not None and before.seconds > REST_S
        if is_slow and question not in self._kept and not self._rests(question):
            return
        if not self._is_wanted(question):
            return
        self._stopped = False
        try:
            with self._running(question) as begin:
                report, student = self._report(question, before, begin)
        finally:
            self._calls = 0
        self._publish(report)
        if student is not None and self._is_wanted(question):
            self._checks.submit(
                lambda: self._told(question, lambda: self._check(question, student))
            )

    def _report(
        self, question: CodeQuestion, before: CodeReport | None, begin: float
    ) -> tuple[CodeReport, FileStudent | None]:
        """Return the file's answer for the camera, and the student for further questions."""
        try:
            asked = self._asked_of(question)
            student = self._student_of(question, asked.limits)
            try:
                functions = student.functions()
            finally:
                self.files = student.files
        except NotRunnableError as error:
            report = CodeReport(question, failure=error.failure, output=error.output)
            return _timed(report, begin), None
        except LucidaError as error:
            failure = Failure("missing", describe(error))
            return _timed(CodeReport(question, failure=failure), begin), None
        tasks = tasks_of(functions, asked.tasks)
        chosen = chosen_of(tasks, question.task)
        results = before.results if before is not None else {}
        report = CodeReport(
            question,
            tuple(tasks),
            chosen,
            results=results,
            at=time.time(),
            asked=asked.tasks,
        )
        if chosen is None or not is_of_camera(chosen):
            return report, student
        task = for_camera(chosen, question.camera, asked.tasks)
        problem = why_not_asked(task, question.camera, question.size)
        if problem:
            return replace(report, not_asked=problem), student
        rays = self._rays(question, task, student)
        output, diagnosis = rays.result.output, None
        if before is not None and before.rays is rays:
            diagnosis = before.diagnosis
        report = replace(
            report, rays=rays, output=output, seconds=rays.seconds, diagnosis=diagnosis
        )
        return report, student

    def _rays(self, question: CodeQuestion, task: CheckTask, student: FileStudent) -> CodeRays:
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

    def _check(self, question: CodeQuestion, student: FileStudent) -> None:
        """Check the tasks that have not been tried, then find out why the picture is wrong."""
        report = self.report
        if not self._rests(question) or report is None or report.question is not question:
            return
        results: dict[str, TaskResult] = dict(report.results)
        for task in report.tasks:
            if self._stopped or not self._is_wanted(question):
                return
            if task.name not in results:
                with self._running(question):
                    result = _tried(student, task, report)
                if self._is_wanted(question):  # otherwise it may have been ended on purpose
                    results[task.name] = result
                    self._add(question, results=dict(results))
        rays = report.rays
        if rays is None or report.diagnosis is not None or rays.task.feedback != "diagnosis":
            return
        if rays.result.status == "wrong":
            self._add(question, diagnosis=diagnosis_of(rays))


def _timed(report: CodeReport, begin: float) -> CodeReport:
    return replace(report, seconds=time.monotonic() - begin, at=time.time())


def _tried(student: FileStudent, task: CheckTask, report: CodeReport) -> TaskResult:
    """Return the result of a task. It is known already if the function runs endlessly."""
    rays = report.rays
    if rays is not None and report.halted and rays.task.function == task.function:
        assert rays.result.failure is not None
        return failed(task, rays.result.failure)
    return checked(student, task)
