"""The first image after a pause, as a viewer's are, against images one after the other."""

from __future__ import annotations

from dataclasses import replace

from tests.benchmarks.cameras import easy_views
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.measure import Plan, seconds
from tests.benchmarks.peers import Trimesh
from tests.benchmarks.report import Table, short, times
from tests.benchmarks.run import HD, Run

AT_MOST = 1.2
AFTER = Plan(rounds=15, repeats=1)  # a pause before each image
LOOP = Plan(rounds=15, pause_s=0.0, repeats=15)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene."""
    kinds = run.all_kinds(Trimesh)
    header = ("scene", "triangles", *(f"{kind.name} ms (times in a loop)" for kind in kinds))
    title = f"The first image after {1e3 * AFTER.pause_s:.0f} ms without one, 1280x720"
    table = Table("pause", title, header)
    rounds = 5 if run.quick else AFTER.rounds
    for subject in run.subjects("small", "70k", "1M"):
        run.say(f"pause: {subject.name}")
        camera = easy_views(subject, HD)[0].camera
        with run.tracers(subject, Trimesh) as tracers:
            turns = {}
            for tracer in tracers:
                tracer.image(camera, HD)
                for what, plan in (("after", AFTER), ("loop", LOOP)):
                    turns[f"{what} {tracer.name}"] = tracer.turn(plan, seconds)
            timings = run.time_turns(turns, replace(AFTER, rounds=rounds))
        cells, ratios = [], {}
        for kind in kinds:
            after, loop = (timings[f"{what} {kind.name}"].median_s for what in ("after", "loop"))
            ratios[kind.name] = after / loop
            cells.append(f"{short(1e3 * after)} ({times(after / loop)})")
        table.add(
            subject.name,
            f"{subject.triangles:,}",
            *cells,
            scene=subject.name,
            triangles=subject.triangles,
            ratios=ratios,
            times={kind.name: timings[f"after {kind.name}"].numbers() for kind in kinds},
        )
        name = f"{subject.name}: first image after a pause, times one in a loop"
        table.target(name, ratios[Lucida.name], AT_MOST, "x", at_least=False)
    return [table]
