"""Processor time of one thread: other programs on the machine hardly change it.

Wall-clock times are what a user waits for, but on a busy machine they depend on the other programs.
These ratios do not.
"""

from __future__ import annotations

from dataclasses import replace

from tools.benchmarks.cameras import easy_views
from tools.benchmarks.measure import Plan, processor_seconds
from tools.benchmarks.report import Table
from tools.benchmarks.run import HD, Run

PLAN = Plan(rounds=5, pause_s=0.0, repeats=3, slow_s=1.0)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene and a view."""
    header = ("scene", "view", "Lucida ms (quartiles)", *run.peer_columns())
    title = "Processor time of one thread: visibility at 1280x720"
    table = Table("processor", title, header)
    plan = replace(PLAN, rounds=2) if run.quick else PLAN
    for subject in run.subjects("small", "70k", "1M"):
        run.say(f"processor: {subject.name}")
        with run.tracers(subject, threads=1) as tracers:
            for view in easy_views(subject, HD)[: 1 if run.quick else 3]:
                for tracer in tracers:
                    tracer.image(view.camera, view.size)
                timings = run.time(tracers, plan, processor_seconds)
                table.compare(subject.name, view.name, timings=timings)
    return [table]
