"""The thread that runs a file: the newest question wins, what is endless is not run again."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from right_code import right_ray
from waiting import wait_for

from lucida.app.checking.running.file import NotRunnableError
from lucida.app.checking.tasks import Call, Failure, Limits, Run
from lucida.app.checking.your_code import runs as runs_module
from lucida.app.checking.your_code.model import CodeQuestion
from lucida.app.checking.your_code.runs import CodeRuns
from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

QUESTION = CodeQuestion("rays.py", 1, Camera.canonical(), (4, 3))
NEWER = replace(QUESTION, version=2)
OTHER = replace(QUESTION, camera=replace(QUESTION.camera, distance=2.0))


class FakeStudent:
    """Answers right, unless it is told to hang, to fail, to be none."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.names = frozenset(("viewing_ray",))
        self.gate: threading.Event | None = None  # a run waits for it
        self.error: Exception | None = None
        self.ended = threading.Event()
        self.runs: list[Sequence[Call]] = []
        self.closed = False
        self.hanging = False

    def functions(self) -> frozenset[str] | None:
        if self.error is not None:
            raise self.error
        return self.names

    def call(self, calls: Sequence[Call]) -> Run:
        self.runs.append(calls)
        self.ended.clear()
        if self.gate is not None:
            gate, self.gate = self.gate, None
            self.hanging = True
            while not gate.is_set() and not self.ended.is_set():
                gate.wait(0.001)
            if self.ended.is_set():
                return Run((), "", Failure("ended", "rays.py: was stopped", call=0))
        return Run(tuple(self.answer(call) for call in calls), "printed")

    def answer(self, call: Call) -> Any:
        return right_ray(dict(call.arguments))

    def stop(self) -> None:
        self.ended.set()

    def close(self) -> None:
        self.closed = True
        self.ended.set()


class Desk:
    """Runs, and the students that they have made."""

    def __init__(self) -> None:
        self.made: list[FakeStudent] = []
        self.prepare = lambda student: None
        self.runs = CodeRuns(self._make)

    def _make(self, path: Path, limits: Limits) -> FakeStudent:
        student = FakeStudent(path)
        self.prepare(student)
        self.made.append(student)
        return student

    def told(self, question: CodeQuestion):
        """Return the last report of a question."""

        def is_done() -> bool:
            self.runs.follow(question)
            return not self.runs.busy

        wait_for(is_done)
        return self.runs.report

    def hangs(self) -> threading.Event:
        gate = threading.Event()
        self.prepare = lambda student: setattr(student, "gate", gate)
        return gate


@pytest.fixture
def desk():
    one = Desk()
    yield one
    one.runs.close()


def test_the_camera_s_rays_come_first_then_other_cameras(desk):
    report = desk.told(QUESTION)
    assert report.question == QUESTION
    assert report.rays.result.status == "right"
    assert report.output == "printed"
    assert report.results.keys() == {"viewing-ray"}
    (student,) = desk.made
    assert student.path == Path("rays.py")
    assert len(student.runs[0]) == 12  # pixels of the canvas
    assert len(student.runs) == 2


def test_the_same_question_is_asked_once(desk):
    desk.told(QUESTION)
    desk.told(QUESTION)
    assert len(desk.made[0].runs) == 2
    other = desk.told(OTHER)
    assert other.rays.result.status == "right"
    assert len(desk.made[0].runs) == 3  # other cameras are tried once
    parallel = replace(QUESTION, camera=replace(QUESTION.camera, projection="parallel"))
    assert desk.told(parallel).results.keys() == {"viewing-ray", "viewing-ray-parallel"}
    assert len(desk.made[0].runs) == 5
    assert len(desk.made) == 1


def test_a_saved_file_is_run_anew_in_another_process(desk):
    desk.told(QUESTION)
    assert desk.told(NEWER).question == NEWER
    assert len(desk.made) == 2
    assert desk.made[0].closed
    assert len(desk.made[1].runs) == 2


def test_a_file_without_the_function_is_told_what_tries_the_others(desk):
    desk.prepare = lambda student: setattr(student, "names", frozenset(("basis",)))
    report = desk.told(QUESTION)
    assert report.failure.text.startswith("it has no function viewing_ray; `lucida check`")
    assert report.rays is None and not report.halted and not desk.made[0].runs


def test_an_overtaken_run_is_ended_and_the_newest_answered(desk, monkeypatch):
    monkeypatch.setattr(runs_module, "OVERTAKEN_S", 0.0)
    desk.hangs()
    desk.runs.follow(QUESTION)
    wait_for(lambda: desk.made and desk.made[0].hanging)
    wait_for(lambda: desk.runs.running_s)
    desk.runs.follow(QUESTION)
    assert not desk.made[0].ended.is_set()  # it is still wanted
    report = desk.told(OTHER)
    assert desk.made[0].runs[1] and report.question == OTHER
    assert report.rays.result.status == "right"
    assert desk.runs.running_s == 0


def test_what_was_stopped_is_not_run_again_by_itself(desk):
    desk.hangs()
    desk.runs.follow(QUESTION)
    wait_for(lambda: desk.made and desk.made[0].hanging)
    desk.runs.stop()
    report = desk.told(QUESTION)
    assert report.rays.result.failure.text == "rays.py: was stopped"
    assert report.halted
    assert not report.results  # nor other cameras
    assert desk.told(OTHER).question == QUESTION
    assert len(desk.made[0].runs) == 1
    desk.prepare = lambda student: None
    assert desk.told(NEWER).rays.result.status == "right"


def test_fewer_pixels_run_a_file_that_took_too_long(desk):
    def call(calls):
        if len(calls) > 2:
            return Run((), "", Failure("time", "the time limit is over", call=0))
        return Run(tuple(right_ray(dict(one.arguments)) for one in calls), "")

    desk.prepare = lambda student: setattr(student, "call", call)
    report = desk.told(QUESTION)
    assert report.halted and not report.results  # it is not tried with other cameras
    assert desk.told(OTHER).question == QUESTION  # not for another camera
    assert not desk.told(replace(QUESTION, size=(2, 1))).halted


@pytest.mark.parametrize(
    ("error", "text", "output"),
    [
        (
            NotRunnableError(Failure("exception", "rays.py, line 3: SyntaxError"), "said"),
            "line 3",
            "said",
        ),
        (LucidaError("", "Python files need Python"), "need Python", ""),
        (ZeroDivisionError("of our own"), "ZeroDivisionError", ""),
    ],
)
def test_a_file_that_cannot_be_run_is_told(desk, error, text, output):
    desk.prepare = lambda student: setattr(student, "error", error)
    report = desk.told(QUESTION)
    assert text in report.failure.text
    assert report.output == output
    assert report.rays is None
    desk.prepare = lambda student: None
    assert desk.told(NEWER).rays.result.status == "right"


def test_forgetting_ends_the_process(desk):
    desk.told(QUESTION)
    desk.runs.forget()
    assert desk.runs.report is None
    assert desk.made[0].ended.is_set() and not desk.runs.busy
    assert desk.told(QUESTION).rays.result.status == "right"
    assert desk.made[0].closed and len(desk.made) == 2
    assert len(desk.made[1].runs) == 2  # nothing of before is taken for an answer


def test_wrong_rays_are_told_first_then_why(desk):
    def mirrored(student):
        def answer(call):
            known = dict(call.arguments)
            return right_ray({**known, "j": known["width"] - 1 - known["j"]})

        student.answer = answer

    desk.prepare = mirrored
    seen = []

    def is_done():
        desk.runs.follow(QUESTION)
        seen.append(desk.runs.report)
        return not desk.runs.busy

    wait_for(is_done)
    first = next(report for report in seen if report is not None)
    assert first.rays.result.status == "wrong"
    assert not first.results
    assert seen[-1].results["viewing-ray"].diagnosis is not None
    assert seen[-1].rays is first.rays  # the pictures stay
