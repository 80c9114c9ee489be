"""From a mesh in memory to being ready for the first ray: the building of the BVH."""

from __future__ import annotations

from functools import partial

from tests.benchmarks.lucida import Lucida
from tests.benchmarks.peers import Open3D, Peer
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import Subject

AT_LEAST_OPEN3D = 1.0
LARGEST = "1M"


def measure(run: Run) -> list[Table]:
    """One table: a row a mesh. What a tracer builds is freed before the next one builds."""
    header: tuple[str, ...] = ("scene", "triangles", "Lucida ms (quartiles)")
    header += tuple(f"{kind.name} ms (times ours)" for kind in run.kinds)
    table = Table("build", "Building: from vertices and faces to the first ray", header)
    for subject in run.subjects("small", "70k", LARGEST):
        run.say(f"build: {subject.name}")
        kinds = run.all_kinds()
        timings = run.time({kind.name: partial(_build, kind, subject) for kind in kinds})
        own = timings[Lucida.name]
        ratios = {kind.name: timings[kind.name].median_s / own.median_s for kind in run.kinds}
        cells = [f"{short(1e3 * timings[n].median_s)} ({times(r)})" for n, r in ratios.items()]
        table.add(
            subject.name,
            f"{subject.triangles:,}",
            ms(own),
            *cells,
            scene=subject.name,
            triangles=subject.triangles,
            times={name: timing.numbers() for name, timing in timings.items()},
        )
        if subject.name == LARGEST and Open3D.name in ratios:
            table.target("1M, against Open3D", ratios[Open3D.name], AT_LEAST_OPEN3D, "x")
    return [table]


def _build(kind: type[Peer], subject: Subject) -> None:
    tracer = kind()
    tracer.prepare(subject.vertices, subject.faces)
    tracer.close()
