"""The thread that counts and measures: in which order, what is kept, what it survives."""

from __future__ import annotations

import math
import threading
import time

import pytest
from fake_renderers import Fake, FakeCounter, gathered

from app.costs import model
from app.costs.model import (
    COUNTING,
    ROUNDS,
    Case,
    Meter,
    cases,
    count,
    torus_of,
)
from renderer.errors import LucidaError


def test_a_meter_measures_what_is_asked_and_once() -> None:
    done, made = threading.Event(), []

    def make(renderer):
        made.append((renderer, Fake(1e-6, 1e-9)))
        return made[-1][1]

    wanted = cases((100, 1000), (1200, 4800))
    assert len(wanted) == 8
    meter = Meter(lambda: len(meter.samples) == 8 and done.set(), make, FakeCounter)
    meter.ask(wanted)
    samples = gathered(meter, done)
    assert [sample.case for sample in samples] == wanted
    meter.close(60)
    assert not meter.busy
    assert [renderer for renderer, _ in made] == ["raster", "ray"]
    assert all(fake.released for _, fake in made)
    assert all(fake.drawn == 4 * (1 + ROUNDS) for _, fake in made)
    meter.ask(cases((500,), (1200,)))
    assert not meter.busy  # it is closed


def test_a_meter_goes_on_with_the_renderer_that_works() -> None:
    done = threading.Event()

    def make(renderer):
        if renderer == "raster":
            raise LucidaError("OpenGL", "is missing", "install it")
        return Fake(0, 1e-9)

    meter = Meter(lambda: meter.waiting == 0 and done.set(), make, FakeCounter)
    meter.ask(cases((100,), (1200, 4800)))
    samples = gathered(meter, done)
    assert [sample.case.renderer for sample in samples] == ["ray", "ray"]
    assert "OpenGL" in meter.problems["raster"]
    meter.clear()
    assert meter.samples == () and meter.problems == {}
    meter.close(60)


def test_other_cases_take_the_place_of_waiting_ones() -> None:
    go, begun, done = threading.Event(), threading.Event(), threading.Event()
    threads = set()

    class Slow(Fake):
        def render(self, camera, size, channels):
            threads.add(threading.current_thread())
            begun.set()
            assert go.wait(60)
            return super().render(camera, size, channels)

    meter = Meter(lambda: meter.waiting == 0 and done.set(), lambda _: Slow(0, 1e-9), FakeCounter)
    meter.ask(cases((100, 1000, 10_000), (1200,), ("ray",)))
    assert begun.wait(60)
    meter.ask(cases((500,), (1200,), ("ray",)))
    go.set()
    samples = gathered(meter, done)
    # The case under way was taken back too: its sample is not kept.
    assert [sample.case.triangles for sample in samples] == [500]
    assert [thread.daemon for thread in threads] == [True]  # one, which no exit waits for
    meter.close(60)


def test_watching_draws_again_and_again() -> None:
    made = {"raster": Fake(1e-6, 0), "ray": Fake(0, 1e-9)}
    enough, again, more = threading.Event(), threading.Event(), threading.Event()

    def changed() -> None:
        if len(meter.history) >= 3:
            enough.set()
        if made["raster"].scene is torus_of(100) and len(meter.samples) == 2:
            again.set()
        if made["raster"].scene is torus_of(1000) and len(meter.history) >= 5:
            more.set()

    meter = Meter(changed, made.__getitem__, FakeCounter)
    with pytest.raises(LucidaError, match="is out of range"):
        meter.watch(100, 0)
    assert not meter.busy
    meter.watch(100, 1200)
    assert enough.wait(60)
    assert meter.busy
    raster, ray = meter.history[0]  # what prepares a scene is drawn, and not told
    assert raster == pytest.approx(1e-6 * count(torus_of(100)))
    assert ray == pytest.approx(1e-9 * 1200, rel=0.1)
    meter.ask(cases((500,), (1200,)))  # between two frames, with another scene
    assert again.wait(60)
    meter.watch(1000, 1200)
    assert more.wait(60)
    meter.close(60)
    assert not meter.busy
    assert all(fake.released for fake in made.values())


def test_watching_goes_on_without_a_renderer() -> None:
    enough, tried = threading.Event(), []

    def make(renderer):
        tried.append(renderer)
        if renderer == "raster":
            raise LucidaError("OpenGL", "is missing", "install it")
        return Fake(0, 1e-9)

    meter = Meter(lambda: len(meter.history) >= 2 and enough.set(), make, FakeCounter)
    meter.watch(100, 1200)
    assert enough.wait(60)
    meter.unwatch()
    meter.close(60)
    assert all(math.isnan(raster) and ray > 0 for raster, ray in meter.history)
    assert list(meter.problems) == ["raster"]
    assert tried == ["raster", "ray"]
    meter.clear()
    assert meter.history == ()


def test_closing_ends_the_pause_between_two_frames(monkeypatch) -> None:
    monkeypatch.setattr(model, "WATCH_S", 1000.0)
    meter = Meter(lambda: None, lambda _: Fake(0, 1e-9), FakeCounter)
    meter.watch(100, 1200)
    while not meter.history:
        time.sleep(0.001)
    meter.close(60)
    assert not meter.busy
    assert len(meter.history) == 1


def test_the_steps_are_counted_before_anything_is_timed_and_once() -> None:
    done, seen, counters = threading.Event(), [], []

    def changed() -> None:
        seen.append((len(meter.work), len(meter.samples), meter.waiting))
        if meter.waiting == 0:
            done.set()

    def counter() -> FakeCounter:
        counters.append(FakeCounter())
        return counters[-1]

    meter = Meter(changed, lambda _: Fake(1e-6, 1e-9), counter)
    meter.ask(cases((100, 1000), (1200, 4800)))
    assert done.wait(60)
    assert seen[0] == (1, 0, 3 + 8)
    assert seen[3] == (4, 0, 8) and seen[-1] == (4, 8, 0)
    assert set(meter.work) == {(100, 1200), (100, 4800), (1000, 1200), (1000, 4800)}
    done.clear()
    meter.clear()
    assert len(meter.work) == 4  # exact: nothing to count again
    meter.ask(cases((100,), (1200, 4800)))
    assert done.wait(60)
    meter.close(60)
    sizes = [Case("ray", 100, pixels).size for pixels in (1200, 4800)]
    assert [asked for one in counters for asked in one.asked] == [
        (count(torus_of(triangles)), size) for triangles in (100, 1000) for size in sizes
    ]


def test_times_are_measured_where_counting_fails() -> None:
    done = threading.Event()

    class Fails:
        def work(self, scene, camera, size):
            raise MemoryError

    meter = Meter(lambda: meter.waiting == 0 and done.set(), lambda _: Fake(0, 1e-9), Fails)
    meter.ask(cases((100, 1000), (1200,)))
    assert len(gathered(meter, done)) == 4
    assert meter.problems == {COUNTING: "MemoryError"}
    assert meter.work == {}
    meter.close(60)


def test_the_meter_survives_whoever_listens_and_whatever_is_released(caplog) -> None:
    done, threads = threading.Event(), set()

    class Stuck(Fake):
        def release(self) -> None:
            raise RuntimeError("the context is gone")

    def changed() -> None:
        threads.add(threading.current_thread())
        if meter.waiting == 0:
            done.set()
        raise RuntimeError("the window is gone")

    meter = Meter(changed, lambda _: Stuck(0, 1e-9), FakeCounter)
    meter.ask(cases((100, 1000), (1200,)))
    assert len(gathered(meter, done)) == 4
    assert len(threads) == 1  # the same to the end
    done.clear()
    meter.ask(cases((500,), (1200,)))
    assert done.wait(60)
    assert len(meter.samples) == 6
    meter.close(60)
    assert not meter.busy
    assert "could not be updated" in caplog.text
    assert "was not released" in caplog.text
