"""From a mesh in memory to being ready for the first ray: the building of the BVH."""

from __future__ import annotations

from tools.benchmarks.peers import Open3D
from tools.benchmarks.report import Table
from tools.benchmarks.run import Run

AT_LEAST_OPEN3D, AT_LEAST_FASTEST = 2.5, 1.0
SMALLEST, LARGEST = "small", "1M"


def measure(run: Run) -> list[Table]:
    """One table: a row a mesh. What a tracer builds is freed before the next one builds."""
    header = ("scene", "triangles", "Lucida ms (quartiles)", *run.peer_columns())
    table = Table("build", "Building: from vertices and faces to the first ray", header)
    for subject in run.subjects(SMALLEST, "70k", LARGEST):
        run.say(f"build: {subject.name}")
        tracers = [run.process(kind) for kind in run.all_kinds]
        for tracer in tracers:
            tracer.building(subject)
        timings = run.time(tracers)
        for tracer in tracers:
            tracer.release()
        ratios = table.compare(subject.name, f"{subject.triangles:,}", timings=timings)
        if subject.name == LARGEST and Open3D.name in ratios:
            name = f"building {LARGEST}, against {Open3D.name}"
            table.target(name, ratios[Open3D.name], AT_LEAST_OPEN3D, "x")
        if subject.name == SMALLEST and ratios:
            fastest = min(ratios, key=lambda name: ratios[name])
            name = f"building {SMALLEST}, against the fastest ({fastest})"
            table.target(name, ratios[fastest], AT_LEAST_FASTEST, "x")
    return [table]
