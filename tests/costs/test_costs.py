"""The cost plot's counting and measuring: which cases, in which order, what is kept. Never how long
it took. test_work.py has what is counted, and what is said of it."""

from __future__ import annotations

import math
import threading
import time

import pytest

from app.costs import model
from app.costs.model import (
    COUNTING,
    RENDERERS,
    ROUNDS,
    Case,
    Meter,
    Sample,
    cases,
    count,
    measure,
    steps,
    torus_of,
)
from app.costs.options import CostOptions
from app.costs.panel import CostReport, said
from app.costs.work import Work
from app.state.bounds import whole_range_of
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.raster import Rasterizer
from renderer.scene.model import Scene
from renderer.trace import Tracer

LEAST_TRIANGLES, MOST_TRIANGLES = whole_range_of(CostOptions, "triangles")


class Fake:
    """Draws nothing, and takes as long as its loop would."""

    def __init__(self, per_triangle: float, per_pixel: float) -> None:
        self.per_triangle, self.per_pixel = per_triangle, per_pixel
        self.scene = Scene(())
        self.drawn = 0
        self.released = False

    def set_scene(self, scene: Scene) -> None:
        self.scene = scene

    def render(self, camera: Camera, size, channels) -> Frame:
        self.drawn += 1
        time_s = self.per_triangle * count(self.scene) + self.per_pixel * size[0] * size[1]
        # The first is the slowest, and would be the worst measure.
        return Frame(size=size, time_s=time_s + (10 if self.drawn % (ROUNDS + 1) == 1 else 0))

    def release(self) -> None:
        self.released = True


class FakeCounter:
    """Counts nothing, and says which images it was asked for."""

    def __init__(self) -> None:
        self.asked: list[tuple[int, tuple[int, int]]] = []

    def work(self, scene: Scene, camera: Camera, size) -> Work:
        n, pixels = count(scene), size[0] * size[1]
        self.asked.append((n, size))
        return Work(n, pixels, n, 2 * pixels, pixels, int(pixels * (3 + math.log2(n))), pixels)


@pytest.mark.parametrize("triangles", [18, 100, 1000, 12345, 100_000, MOST_TRIANGLES])
def test_a_torus_of_so_many_triangles(triangles: int) -> None:
    assert count(torus_of(triangles)) == pytest.approx(triangles, rel=0.1)


def test_the_torus_fills_the_image() -> None:
    """Three fifths of it: how many pixels are shaded is a part of the costs."""
    with Tracer(torus_of(5000)) as tracer:
        frame = tracer.render(Camera.canonical(), (40, 40), ("id",))
    assert (frame.id >= 0).mean() == pytest.approx(0.6, abs=0.02)


def test_sizes_have_about_so_many_pixels() -> None:
    for pixels in (64, 1000, 76_800, 1 << 20):
        width, height = Case("ray", 100, pixels).size
        assert width * height == pytest.approx(pixels, rel=0.1)
        assert width / height == pytest.approx(4 / 3, rel=0.15)


@pytest.mark.parametrize(
    ("triangles", "pixels"), [(LEAST_TRIANGLES - 1, 100), (MOST_TRIANGLES + 1, 100), (100, 1)]
)
def test_cases_that_cannot_be(triangles: int, pixels: int) -> None:
    with pytest.raises(LucidaError, match="is out of range"):
        Case("raster", triangles, pixels)


def test_steps_grow_by_a_factor() -> None:
    assert steps(10, 10_000, 4) == [10, 100, 1000, 10_000]
    assert steps(7, 7, 5) == [7]
    assert steps(10, 10_000, 2) == steps(10, 10_000, 1) == [10, 10_000]


def test_a_measure_is_the_least_time_after_warming_up() -> None:
    fake = Fake(1e-6, 0)
    sample = measure(Case("raster", 1000, 4800), fake)
    assert fake.drawn == 1 + ROUNDS
    assert sample.time_s == pytest.approx(1e-6 * sample.triangles)
    assert sample.pixels == 80 * 60


@pytest.mark.parametrize("fastest", range(1, 1 + ROUNDS))
def test_a_measure_takes_the_fastest_wherever_it_is(fastest: int) -> None:
    class Uneven(Fake):
        def render(self, camera: Camera, size, channels) -> Frame:
            self.drawn += 1
            return Frame(size=size, time_s=1.0 if self.drawn == 1 + fastest else 2.0)

    assert measure(Case("ray", 100, 1200), Uneven(0, 0)).time_s == 1.0


def gathered(meter: Meter, done: threading.Event) -> tuple[Sample, ...]:
    assert done.wait(60)
    return meter.samples


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
    meter.close()
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
    meter.close()


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
    meter.close()


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
    meter.close()
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
    meter.close()
    assert all(math.isnan(raster) and ray > 0 for raster, ray in meter.history)
    assert list(meter.problems) == ["raster"]
    assert tried == ["raster", "ray"]
    meter.clear()
    assert meter.history == []


def test_closing_ends_the_pause_between_two_frames(monkeypatch) -> None:
    monkeypatch.setattr(model, "WATCH_S", 1000.0)
    meter = Meter(lambda: None, lambda _: Fake(0, 1e-9), FakeCounter)
    meter.watch(100, 1200)
    while not meter.history:
        time.sleep(0.001)
    meter.close(60)
    assert not meter.busy
    assert len(meter.history) == 1


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_thread_that_ends_early_is_followed_by_another() -> None:
    done, threads = threading.Event(), []

    class Leaves(Fake):
        def render(self, camera, size, channels):
            threads.append(threading.current_thread())
            if len(threads) == 1:
                raise SystemExit
            return super().render(camera, size, channels)

    meter = Meter(
        lambda: len(meter.samples) == 1 and done.set(), lambda _: Leaves(0, 1e-9), FakeCounter
    )
    meter.ask(cases((100,), (1200,), ("ray",)))
    while meter.busy:
        time.sleep(0.001)
    threads[0].join()
    meter.ask(cases((100,), (1200,), ("ray",)))
    assert done.wait(60)
    assert threads[1] is not threads[0]
    meter.close()


def test_what_the_meter_draws_with(monkeypatch) -> None:
    """Made where they are wanted: what they load takes long."""
    monkeypatch.setattr("renderer.raster.Rasterizer", lambda scene: ("raster", scene.objects))
    monkeypatch.setattr("renderer.trace.Tracer", lambda scene: ("ray", scene.objects))
    assert [model._make(name) for name in RENDERERS] == [(name, ()) for name in RENDERERS]


def test_what_cannot_be_watched_is_told_and_the_meter_goes_on() -> None:
    enough = threading.Event()
    meter = Meter(
        lambda: len(meter.history) >= 2 and enough.set(), lambda _: Fake(0, 1e-9), FakeCounter
    )
    for triangles, pixels in ((1, 1200), (100, 0), (10**9, 1200)):
        with pytest.raises(LucidaError, match="is out of range"):
            meter.watch(triangles, pixels)
    assert not meter.busy
    meter.watch(100, 1200)
    assert enough.wait(60)
    meter.close()
    assert meter.problems == {}


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
    meter.close()
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
    meter.close()


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
    meter.close()
    assert not meter.busy
    assert "was not told of a sample" in caplog.text
    assert "was not released" in caplog.text


def test_nothing_is_said_of_times_while_they_are_measured_nor_of_flat_ones() -> None:
    options = CostOptions("triangles")
    counts = steps(100, 1_000_000, 6)
    raster, ray = Fake(1e-6, 0), Fake(0, 1e-6)
    wanted = cases(counts, (4800,))
    fakes = {"raster": raster, "ray": ray}
    samples = [measure(case, fakes[case.renderer]) for case in wanted]
    work = [FakeCounter().work(torus_of(n), Camera.canonical(), (80, 60)) for n in counts]
    of_object, of_image = said(options, CostReport(work, samples, (), 0, {}))
    assert of_object == (
        "raster",
        "Object order: triangles set up ~ triangles; pixels tested: the same;"
        " time ~ triangles where its line is steep.",
    )
    assert of_image[1].startswith(
        "Image order: rays: the same; nodes visited ~ log triangles (+1.0"
    )
    assert "time" not in of_image[1]
    assert "time" not in said(options, CostReport(work, samples, (), 3, {}))[0][1]
    for few in range(4):
        assert said(options, CostReport(work[:few], samples[: 2 * few], (), 12, {})) == []


def test_both_renderers_are_measured(gl_backend) -> None:
    def make(renderer):
        return Tracer(Scene(())) if renderer == "ray" else Rasterizer(Scene(()), gl_backend)

    done = threading.Event()
    meter = Meter(lambda: meter.waiting == 0 and done.set(), make, FakeCounter)
    meter.ask(cases((100, 1000), (1200,)))
    assert done.wait(200)
    assert meter.problems == {}
    assert {sample.case.renderer for sample in meter.samples} == {"raster", "ray"}
    assert meter.work[1000, 1200].rays == 1200
    assert all(sample.time_s > 0 for sample in meter.samples)
    meter.close()
