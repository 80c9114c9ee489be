"""The tracer in a process of its own: the same images, the same errors, and nothing left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import IO, Any

import numpy as np
import pytest

from app.images import tracing_process as apart
from app.images.request import MIRROR_DEPTH, ImageRequest
from app.images.scene_tracer import tracer_for
from app.images.tracer_apart import ImageApart, Questions, TracerApart, tracers_of
from app.images.tracing_process import NOTE, Process, tracing_process
from renderer import compile_note
from renderer.child import end_child
from renderer.errors import LucidaError
from renderer.frame import CHANNELS, Frame
from renderer.scene import load_scene
from renderer.scene.packing import read_value, write_value
from renderer.trace import Tracer

SIZE = (48, 32)
PATIENT_S = 200.0  # only a hang takes this long: all may have to be compiled
SPHERES = load_scene("spheres")
REQUEST = ImageRequest(SPHERES, SPHERES.view.for_size(SIZE), SIZE)
OTHER = load_scene("still-life")


@pytest.fixture
def process() -> Iterator[Process]:
    with tracing_process(True) as process:
        assert process is not None
        yield process
    assert process.poll() is not None


@pytest.mark.parametrize("effects", [{}, {"shadows": True, "mirrors": True}])
def test_images_and_rays_are_those_of_a_tracer_here(process: Process, effects: dict) -> None:
    request = replace(REQUEST, **effects)
    make = tracers_of(process)
    with Tracer(
        SPHERES, shadows=bool(effects), mirror_depth=MIRROR_DEPTH if effects else 0
    ) as here:
        there = make(request)
        assert isinstance(there, TracerApart)
        for scene in (SPHERES, OTHER):
            if scene is OTHER:
                here.set_scene(scene)
                there.set_scene(scene)
                assert (there.scene, there.scenes) == (scene, 2)
            camera = scene.view.for_size(SIZE)
            job = there.start(camera, SIZE, CHANNELS)
            assert job.wait(PATIENT_S) and job.progress == 1.0
            ours, theirs = here.render(camera, SIZE, CHANNELS), job.result()
            assert theirs.complete and theirs.size == SIZE
            for name in CHANNELS:
                np.testing.assert_array_equal(ours.channel(name), theirs.channel(name))
            rays = camera.ray(np.arange(9), np.arange(9), SIZE)
            if not effects:
                for hits in ("closest_hits", "any_hits"):
                    asked = rays.origin, rays.direction, 0.0, 50.0
                    ours, theirs = (getattr(tracer, hits)(*asked) for tracer in (here, there))
                    np.testing.assert_array_equal(ours, theirs)
        there.close()
    assert make(request).start(REQUEST.camera, (2, 2), ("depth",)).result().depth is not None


def test_a_mistake_comes_back_as_it_is_with_its_traceback(process: Process) -> None:
    tracer = tracers_of(process)(REQUEST)
    with pytest.raises(LucidaError, match="0x4 has no pixels") as told:
        tracer.start(REQUEST.camera, (0, 4)).result()
    assert "check_size" in "".join(told.value.__notes__)
    assert tracer.start(REQUEST.camera, (4, 4), ("depth",)).result().complete


class HeldJob:
    """Ends when it is cancelled; the first, by which the process prepares, at once."""

    def __init__(self, is_first: bool) -> None:
        self.ended = threading.Event()
        if is_first:
            self.ended.set()

    def wait(self, timeout_s: float | None = None) -> bool:
        return self.ended.wait(timeout_s)

    def cancel(self) -> None:
        self.ended.set()

    def result(self) -> Frame:
        return Frame((1, 1), complete=False)


def next_answer(answers: IO[bytes]) -> tuple[int, Any]:
    """But for what this process has compiled before, which is told first."""
    number, value = read_value(answers)
    return (number, value) if number != NOTE else next_answer(answers)


def test_what_is_cancelled_there_is_not_traced() -> None:
    jobs: list[HeldJob] = []

    def start(*_: object) -> HeldJob:
        jobs.append(HeldJob(is_first=not jobs))
        return jobs[-1]

    tracer = SimpleNamespace(start=start, any_hits=lambda: "none")
    answers_out, answers_in = os.pipe()
    with open(answers_out, "rb") as answers, open(answers_in, "wb") as answered:
        server = apart.TracingServer(answered, lambda *_: tracer)  # type: ignore[arg-type,return-value]
        server.take("start", 1)
        server.take("any_hits", 2)
        server.take("cancel", 3)  # which nobody has asked for, or which is done
        assert not jobs[1].ended.is_set()
        server.take("cancel", 1)
        number, frame = next_answer(answers)
        assert (number, frame.complete) == (1, False)
        assert next_answer(answers) == (2, "none")  # in the order of the questions


def test_when_the_process_dies_it_is_told_and_the_next_tracer_is_here(process: Process) -> None:
    if hasattr(signal, "SIGSTOP"):
        process.send_signal(signal.SIGSTOP)  # so that it cannot answer before
    make = tracers_of(process)
    tracer = make(REQUEST)
    job = tracer.start(REQUEST.camera, SIZE)
    process.kill()
    with pytest.raises(LucidaError, match=r"ray tracer: its process ended .*; close other"):
        job.result()
    with pytest.raises(LucidaError, match="its process ended"):
        tracer.start(REQUEST.camera, SIZE).result()
    with make(REQUEST) as here:  # type: ignore[attr-defined]
        assert isinstance(here, Tracer)


def test_no_process_where_none_is_wanted_or_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    with tracing_process(False) as process:
        assert process is None

    def fails(*_: object, **__: object) -> None:
        raise BlockingIOError("too many processes")

    monkeypatch.setattr(apart, "start_child", fails)
    with tracing_process(True) as process:
        assert process is None
    monkeypatch.setattr(apart, "interpreter", lambda: None)
    with tracing_process(True) as process:
        assert process is None


def test_the_process_ends_with_whoever_wants_it() -> None:
    with ExitStack() as stack:
        process = stack.enter_context(tracing_process(True))
        assert process is not None and process.stdin is not None
        assert not stack.__exit__(KeyboardInterrupt, KeyboardInterrupt(), None)
    assert process.poll() is not None and process.stdin.closed
    assert end_child(process) == process.returncode  # once more


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's processes")
def test_the_process_ends_with_one_that_is_killed() -> None:
    script = (
        "import os, signal\n"
        "from app.images.tracing_process import tracing_process\n"
        "with tracing_process(True) as process:\n"
        "    print(process.pid, flush=True)\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=Path(__file__).parents[2], capture_output=True
    )
    end_s = time.monotonic() + PATIENT_S
    while _is_there(int(done.stdout)):
        assert time.monotonic() < end_s, "it is still there"
        time.sleep(0.02)


def _is_there(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    status = Path(f"/proc/{pid}/stat")  # one that nobody has waited for has ended too
    return not status.exists() or status.read_text().rpartition(")")[2].split()[0] != "Z"


def test_that_something_is_compiled_there_is_told_here(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[bool] = []
    monkeypatch.setattr(compile_note, "begin", lambda kept: told.append(kept))
    (questions_out, questions_in), (answers_out, answers_in) = os.pipe(), os.pipe()
    with (
        open(questions_out, "rb") as asked,
        open(questions_in, "wb") as stdin,
        open(answers_out, "rb") as stdout,
        open(answers_in, "wb") as answers,
    ):
        pipes = SimpleNamespace(
            stdin=stdin, stdout=stdout, kill=answers.close, wait=lambda: -9, poll=lambda: -9
        )
        questions = Questions(pipes)  # type: ignore[arg-type]
        number, answer = questions.ask("closest_hits", 1, 2)
        assert read_value(asked) == ("closest_hits", number, 1, 2)
        write_value(answers, (NOTE, compile_note.ONCE))
        write_value(answers, (number, ValueError("no rays")))
        with pytest.raises(ValueError, match="no rays"):
            answer.result()
        assert told == [True]
        ImageApart(questions, number, answer).cancel()
        assert read_value(asked) == ("cancel", number)
        assert not questions.ended
        answers.close()
        assert questions.ask("any_hits")[1].wait(PATIENT_S)
        assert questions.ended


def test_a_request_gets_the_tracer_that_it_needs() -> None:
    with tracer_for(replace(REQUEST, shadows=True)) as tracer:
        assert (tracer.shadows, tracer.mirror_depth) == (True, 0)
    with tracer_for(replace(REQUEST, mirrors=True)) as tracer:
        assert (tracer.shadows, tracer.mirror_depth) == (False, MIRROR_DEPTH)
