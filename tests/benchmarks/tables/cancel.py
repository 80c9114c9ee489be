"""The time from cancel() to the end of the job."""

from __future__ import annotations

import time

import numpy as np

from renderer.trace import Tracer
from tests.benchmarks.cameras import easy_views
from tests.benchmarks.measure import Timing
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import scene_of

AT_MOST_MS = 2.0
SIZE = (3840, 2160)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene. Images are cancelled a little after they began, at any pixel."""
    header = ("scene", "cancelled", "median ms", "95 % ms", "longest ms")
    table = Table("cancel", "Cancelling an image of 3840x2160 pixels", header)
    rng = np.random.default_rng(5)
    worst = 0.0
    for subject in run.subjects("small", "1M"):
        run.say(f"cancel: {subject.name}")
        camera = easy_views(subject, SIZE)[0].camera
        with Tracer(scene_of(subject)) as tracer:
            tracer.render(camera, (64, 36))
            samples = []
            for _ in range(20 if run.quick else 60):
                job = tracer.start(camera, SIZE)
                while not job.progress and not job.done:
                    time.sleep(0.0002)
                time.sleep(rng.uniform(0, 0.01))
                begin = time.perf_counter()
                job.cancel()
                job.wait()
                elapsed = time.perf_counter() - begin
                if not job.result().complete:
                    samples.append(elapsed)
        if not samples:
            continue  # every image was complete before it could be cancelled
        late_ms = 1e3 * float(np.quantile(samples, 0.95))
        worst = max(worst, late_ms)
        timing = Timing(tuple(samples))
        table.add(
            subject.name,
            str(len(samples)),
            short(1e3 * timing.median_s),
            short(late_ms),
            short(1e3 * max(samples)),
            scene=subject.name,
            **timing.numbers(),
        )
    table.target("95 % of the cancelled images end within", worst, AT_MOST_MS, "ms", at_least=False)
    return [table]
