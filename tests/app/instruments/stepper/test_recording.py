"""A run of the loops is recorded: to its end, to the most steps, until it is cancelled or fails."""

from __future__ import annotations

import sys

import pytest
from recorded_runs import SIZE, TWO_BALLS, last, recorded

from lucida.app.instruments.stepper import loops, recording
from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.loops import PROGRAMS, image_order
from lucida.app.instruments.stepper.model import moment_at
from lucida.app.instruments.stepper.recording import Recording
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError


def test_a_run_ends_when_it_is_no_longer_wanted() -> None:
    asked = iter((True, True, False))
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, image_order, lambda: next(asked))
    assert not run.truncated and 0 < len(run) < len(recorded(TWO_BALLS, image_order))
    assert "return" not in run.source.lines[moment_at(run, len(run)).line]


def test_a_run_ends_at_the_most_steps(monkeypatch) -> None:
    monkeypatch.setattr(recording, "MOST_STEPS", 100)
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, image_order)
    assert run.truncated and len(run) == 100


def test_a_failing_run_says_why(monkeypatch) -> None:
    monkeypatch.setattr(loops, "intersect", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, image_order)


def test_recording_leaves_tracing_as_it_was() -> None:
    def watching(frame, event, argument):
        return None

    before = sys.gettrace()
    sys.settrace(watching)
    try:
        recorded(TWO_BALLS, image_order, size=(2, 2))
        assert sys.gettrace() is watching
    finally:
        sys.settrace(before)


@pytest.mark.parametrize("size", [(0, 3), (65, 3), (4, 49)])
def test_a_canvas_too_large_is_refused(size: tuple[int, int]) -> None:
    with pytest.raises(
        LucidaError, match=r"canvas\[[01]\]: \d+ is out of range; give 1 to (64|48)"
    ):
        Recording(Model(TWO_BALLS), Camera.canonical(), size, image_order)


@pytest.mark.parametrize("program", PROGRAMS)
def test_an_empty_scene_and_a_single_pixel(program) -> None:
    run = recorded(Scene((), background=(0.5, 0.5, 0.5)), program, size=(1, 1))
    assert (last(run).canvas == 0.5).all()
    one = recorded(TWO_BALLS, program, size=(1, 3))
    for step in range(len(one)):
        moment = moment_at(one, step)
        if moment.ray is not None:
            assert moment.pixel is not None
            assert moment.ray.direction[1] == pytest.approx(-((moment.pixel[0] + 0.5) / 3 - 0.5))
