"""The cost plot's cases, and what is measured and said of one. Never how long it took.
test_meter.py has the thread that measures, test_work.py what is counted."""

from __future__ import annotations

import threading
from itertools import pairwise

import pytest
from fake_renderers import Fake, FakeCounter

from app.costs import panel, recorded
from app.costs.model import (
    ROUNDS,
    Case,
    Meter,
    cases,
    count,
    measure,
    steps,
    torus_of,
)
from app.costs.options import CostOptions
from app.costs.panel import CostReport, said
from app.costs.work import Counter
from app.state.bounds import whole_range_of
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.raster import Rasterizer
from renderer.scene.model import Scene
from renderer.trace import Tracer

LEAST_TRIANGLES, MOST_TRIANGLES = whole_range_of(CostOptions, "triangles")


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


@pytest.mark.parametrize("fastest", range(1, 1 + ROUNDS))
def test_a_measure_takes_the_fastest_wherever_it_is(fastest: int) -> None:
    class Uneven(Fake):
        def render(self, camera: Camera, size, channels) -> Frame:
            self.drawn += 1
            return Frame(size=size, time_s=1.0 if self.drawn == 1 + fastest else 2.0)

    fake = Uneven(0, 0)
    sample = measure(Case("ray", 100, 4800), fake)
    assert (sample.time_s, sample.pixels) == (1.0, 80 * 60)
    assert fake.drawn == 1 + ROUNDS


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


def test_the_recorded_counts_are_those_of_its_images():
    counter = Counter()
    for work, sample in zip(recorded.WORK[:2], recorded.SAMPLES[::2], strict=False):
        case = sample.case
        camera = Camera.canonical().fitted(case.size)
        assert counter.work(torus_of(case.triangles), camera, case.size) == work


@pytest.mark.parametrize("wanted", [[5.0], [1, 2, 3, 4], [30, 30, 30, 30], [-9, 0, 90, 99]])
def test_titles_of_lines_do_not_overlap_and_stay_inside(wanted):
    places = panel.apart(wanted, 8.0, 0.0, 32.0)
    assert len(places) == len(wanted)
    assert all(0 <= place <= 32 for place in places)
    assert all(b - a >= 8 for a, b in pairwise(places))
