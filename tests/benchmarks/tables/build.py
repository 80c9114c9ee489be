"""From a mesh in memory to being ready for the first ray: the building of the BVH."""

from __future__ import annotations

from tests.benchmarks.lucida import Lucida
from tests.benchmarks.peers import Open3D
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import Run

AT_LEAST_OPEN3D, AT_LEAST_FASTEST = 2.5, 1.0
SMALLEST, LARGEST = "small", "1M"


def measure(run: Run) -> list[Table]:
    """One table: a row a mesh. What a tracer builds is freed before the next one builds."""
    header: tuple[str, ...] = ("scene", "triangles", "Lucida ms (quartiles)")
    header += tuple(f"{kind.name} ms (times ours)" for kind in run.kinds)
    table = Table("build", "Building: from vertices and faces to the first ray", header)
    for subject in run.subjects(SMALLEST, "70k", LARGEST):
        run.say(f"build: {subject.name}")
        tracers = [run.process(kind) for kind in run.all_kinds()]
        for tracer in tracers:
            tracer.building(subject)
        timings = run.time(tracers)
        for tracer in tracers:
            tracer.release()
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
            table.target(
                f"building {LARGEST}, against {Open3D.name}",
                ratios[Open3D.name],
                AT_LEAST_OPEN3D,
                "x",
            )
        if subject.name == SMALLEST and ratios:
            fastest = min(ratios, key=lambda name: ratios[name])
            name = f"building {SMALLEST}, against the fastest ({fastest})"
            table.target(name, ratios[fastest], AT_LEAST_FASTEST, "x")
    return [table]
