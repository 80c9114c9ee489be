"""The cost plot's measuring: which cases, in which order, what is kept. Never how long it took."""

from __future__ import annotations

import math
import threading
import time

import pytest

from app.bounds import whole_range_of
from app.options import CostOptions
from app.teach.costs import (
    ROUNDS,
    Case,
    Meter,
    Sample,
    cases,
    count,
    growth,
    growth_text,
    measure,
    steps,
    torus_of,
)
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


@pytest.mark.parametrize("triangles", [18, 100, 1000, 12345, 100_000, MOST_TRIANGLES])
def test_a_torus_of_so_many_triangles(triangles: int) -> None:
    assert count(torus_of(triangles)) == pytest.approx(triangles, rel=0.1)


def test_the_torus_fills_the_image() -> None:
    with Tracer(torus_of(5000)) as tracer:
        frame = tracer.render(Camera.canonical(), (40, 40), ("id",))
    assert 0.3 < (frame.id >= 0).mean() < 0.9


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


def test_a_measure_is_the_least_time_after_warming_up() -> None:
    fake = Fake(1e-6, 0)
    sample = measure(Case("raster", 1000, 4800), fake)
    assert fake.drawn == 1 + ROUNDS
    assert sample.time_s == pytest.approx(1e-6 * sample.triangles)
    assert sample.pixels == 80 * 60


def test_growth_tells_the_loops_apart() -> None:
    by_triangles, by_pixels = Fake(1e-6, 0), Fake(0, 1e-6)
    counts = steps(100, 100_000, 5)
    for fake, exponent in ((by_triangles, 1.0), (by_pixels, 0.0)):
        samples = [measure(Case("ray", n, 4800), fake) for n in counts]
        assert growth(samples, "triangles") == pytest.approx(exponent, abs=1e-6)
    assert growth_text(samples, "triangles") == "~ triangles^0"
    assert growth(samples[:1], "triangles") is None
    assert growth_text(samples[:1], "triangles") == ""


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
    meter = Meter(lambda: len(meter.samples) == 8 and done.set(), make)
    meter.ask(wanted)
    samples = gathered(meter, done)
    assert [sample.case for sample in samples] == wanted
    meter.close()
    assert not meter.busy
    assert [renderer for renderer, _ in made] == ["raster", "ray"]
    assert all(fake.released for _, fake in made)
    assert all(fake.drawn == 4 * (1 + ROUNDS) for _, fake in made)


def test_a_meter_goes_on_with_the_renderer_that_works() -> None:
    done = threading.Event()

    def make(renderer):
        if renderer == "raster":
            raise LucidaError("OpenGL", "is missing", "install it")
        return Fake(0, 1e-9)

    meter = Meter(lambda: meter.waiting == 0 and done.set(), make)
    meter.ask(cases((100,), (1200, 4800)))
    samples = gathered(meter, done)
    assert [sample.case.renderer for sample in samples] == ["ray", "ray"]
    assert "OpenGL" in meter.problems["raster"]
    meter.clear()
    assert meter.samples == () and meter.problems == {}
    meter.close()


def test_other_cases_take_the_place_of_waiting_ones() -> None:
    go, begun, done = threading.Event(), threading.Event(), threading.Event()

    class Slow(Fake):
        def render(self, camera, size, channels):
            begun.set()
            assert go.wait(60)
            return super().render(camera, size, channels)

    meter = Meter(lambda: meter.waiting == 0 and done.set(), lambda _: Slow(0, 1e-9))
    meter.ask(cases((100, 1000, 10_000), (1200,), ("ray",)))
    assert begun.wait(60)
    meter.ask(cases((500,), (1200,), ("ray",)))
    go.set()
    samples = gathered(meter, done)
    # The case under way was taken back too: its sample is not kept.
    assert [sample.case.triangles for sample in samples] == [500]
    meter.close()


def test_watching_draws_again_and_again() -> None:
    made = {"raster": Fake(1e-6, 0), "ray": Fake(0, 1e-9)}
    enough, more = threading.Event(), threading.Event()

    def changed() -> None:
        if len(meter.history) >= 3:
            enough.set()
        if made["raster"].scene is torus_of(1000) and len(meter.history) >= 5:
            more.set()

    meter = Meter(changed, made.__getitem__)
    meter.watch(100, 1200)
    assert enough.wait(60)
    assert meter.busy
    raster, ray = meter.history[0]  # what prepares a scene is drawn, and not told
    assert raster == pytest.approx(1e-6 * count(torus_of(100)))
    assert ray == pytest.approx(1e-9 * 1200, rel=0.1)
    meter.watch(1000, 1200)
    assert more.wait(60)
    meter.close()
    assert not meter.busy
    assert all(fake.released for fake in made.values())


def test_watching_goes_on_without_a_renderer() -> None:
    enough = threading.Event()

    def make(renderer):
        if renderer == "raster":
            raise LucidaError("OpenGL", "is missing", "install it")
        return Fake(0, 1e-9)

    meter = Meter(lambda: len(meter.history) >= 2 and enough.set(), make)
    meter.watch(100, 1200)
    assert enough.wait(60)
    meter.unwatch()
    meter.close()
    assert all(math.isnan(raster) and ray > 0 for raster, ray in meter.history)
    assert list(meter.problems) == ["raster"]


def test_what_cannot_be_watched_is_told_and_the_meter_goes_on() -> None:
    enough = threading.Event()
    meter = Meter(lambda: len(meter.history) >= 2 and enough.set(), lambda _: Fake(0, 1e-9))
    for triangles, pixels in ((1, 1200), (100, 0), (10**9, 1200)):
        with pytest.raises(LucidaError, match="is out of range"):
            meter.watch(triangles, pixels)
    assert not meter.busy
    meter.watch(100, 1200)
    assert enough.wait(60)
    meter.close()
    assert meter.problems == {}


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_thread_that_fell_leaves_its_place_to_another() -> None:
    fell, done, made = [], threading.Event(), []

    def changed() -> None:
        if not fell:
            fell.append(threading.current_thread())
            raise RuntimeError("the window is gone")
        if meter.waiting == 0:
            done.set()

    def make(renderer):
        made.append(Fake(0, 1e-9))
        return made[-1]

    meter = Meter(changed, make)
    meter.ask(cases((100,), (1200,)))
    while not fell:
        time.sleep(0.01)
    fell[0].join(60)
    assert not meter.busy and made[0].released
    meter.ask(cases((100, 1000), (1200,)))
    assert done.wait(60)
    assert len(meter.samples) == 4
    meter.close()


def test_both_renderers_are_measured(gl_backend) -> None:
    def make(renderer):
        return Tracer(Scene(())) if renderer == "ray" else Rasterizer(Scene(()), gl_backend)

    done = threading.Event()
    meter = Meter(lambda: meter.waiting == 0 and done.set(), make)
    meter.ask(cases((100, 1000), (1200,)))
    assert done.wait(200)
    assert meter.problems == {}
    assert {sample.case.renderer for sample in meter.samples} == {"raster", "ray"}
    assert all(sample.time_s > 0 for sample in meter.samples)
    meter.close()
