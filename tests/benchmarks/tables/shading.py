"""The shaded image against visibility alone: spheres, checker, highlights and three lights."""

from __future__ import annotations

from functools import partial

from renderer.trace import Tracer
from tests.benchmarks.cameras import easy_views
from tests.benchmarks.measure import interleaved, turn
from tests.benchmarks.report import Table, ms, times
from tests.benchmarks.run import Run, size_text
from tests.benchmarks.scenes import shaded_scene

AT_MOST = 1.5
ALONE = ("depth", "normal", "id")


def measure(run: Run) -> list[Table]:
    """One table: a row a scene, view and size."""
    header = ("scene", "view", "size", "visibility ms", "with colour ms", "times")
    table = Table("shading", "The fully shaded image against visibility alone", header)
    worst = 0.0
    for subject in run.subjects("small", "70k", "1M"):
        with Tracer(shaded_scene(subject)) as tracer:
            for size in run.sizes:
                for view in easy_views(subject, size)[:2]:
                    run.say(f"shading: {subject.name}, {view.name}, {size_text(size)}")
                    calls = {
                        "visibility": partial(tracer.render, view.camera, size, ALONE),
                        "shaded": partial(tracer.render, view.camera, size, ("color", *ALONE)),
                    }
                    turns = {name: partial(turn, call, run.plan) for name, call in calls.items()}
                    timings = interleaved(turns, run.plan)
                    alone, shaded = timings["visibility"], timings["shaded"]
                    ratio = shaded.median_s / alone.median_s
                    worst = max(worst, ratio)
                    table.add(
                        subject.name,
                        view.name,
                        size_text(size),
                        ms(alone),
                        ms(shaded),
                        times(ratio),
                        scene=subject.name,
                        triangles=subject.triangles,
                        view=view.name,
                        size=list(size),
                        times={name: timing.numbers() for name, timing in timings.items()},
                    )
    table.target("shaded over visibility, worst", worst, AT_MOST, "x", at_least=False)
    return [table]
