"""A run of the loops is recorded: to its end, to the most steps, until it is cancelled or fails."""

from __future__ import annotations

import sys
import threading

import pytest
from recorded_runs import SIZE, TWO_BALLS, last, recorded

from lucida.app.instruments.stepper import loops, recording
from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.model import moment_at
from lucida.app.instruments.stepper.recording import Order, Recording
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError


def test_a_run_in_the_background_can_be_watched_and_cancelled() -> None:
    scene = load_scene("columns")
    run = Recording(Model(scene), scene.view.for_size((64, 48)), (64, 48), Order.IMAGE)
    wanted = threading.Event()
    wanted.set()
    thread = threading.Thread(target=run.run, args=(wanted.is_set,), daemon=True)
    thread.start()
    while len(run) < 2000:
        assert thread.is_alive()
    for step in range(0, len(run), 97):
        assert moment_at(run, step).step == step
    wanted.clear()
    thread.join()
    assert not run.complete and not run.truncated
    assert len(run) < 400_000
    assert not moment_at(run, len(run)).finished


def test_a_run_ends_at_the_most_steps(monkeypatch) -> None:
    monkeypatch.setattr(recording, "MOST_STEPS", 100)
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, Order.IMAGE)
    run.run()
    assert run.truncated and not run.complete and len(run) == 100


def test_a_failing_run_says_why(monkeypatch) -> None:
    monkeypatch.setattr(loops, "intersect", lambda *_: 1 / 0)
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, Order.IMAGE)
    with pytest.raises(ZeroDivisionError):
        run.run()
    assert "intersect(object, ray)" in run.source.lines[moment_at(run, len(run)).line]


def test_recording_leaves_tracing_as_it_was() -> None:
    def watching(frame, event, argument):
        return None

    before = sys.gettrace()
    sys.settrace(watching)
    try:
        recorded(TWO_BALLS, Order.IMAGE, size=(2, 2))
        assert sys.gettrace() is watching
    finally:
        sys.settrace(before)


@pytest.mark.parametrize("size", [(0, 3), (65, 3), (4, 49)])
def test_canvases_are_small(size: tuple[int, int]) -> None:
    with pytest.raises(
        LucidaError, match=r"canvas\[[01]\]: \d+ is out of range; give 1 to (64|48)"
    ):
        Recording(Model(TWO_BALLS), Camera.canonical(), size, Order.IMAGE)


@pytest.mark.parametrize("order", Order)
def test_an_empty_scene_and_a_single_pixel(order: Order) -> None:
    run = recorded(Scene((), background=(0.5, 0.5, 0.5)), order, size=(1, 1))
    assert (last(run).canvas == 0.5).all()
    one = recorded(TWO_BALLS, order, size=(1, 3))
    for step in range(len(one)):
        moment = moment_at(one, step)
        if moment.ray is not None:
            assert moment.pixel is not None
            assert moment.ray.direction[1] == pytest.approx(-((moment.pixel[0] + 0.5) / 3 - 0.5))
