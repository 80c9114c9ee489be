"""Processor time of one thread: what other programs on the machine do hardly counts.

Clocks on the wall tell what a user waits for, but on a busy machine more about the others. These
ratios can be trusted there too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from tests.benchmarks.cameras import Rays, View, easy_views
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.measure import Plan, processor_seconds
from tests.benchmarks.peers import Embreex, Trimesh
from tests.benchmarks.processes import TracerProcess
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import HD, Run
from tests.benchmarks.scenes import Subject
from tests.benchmarks.tables.secondary import secondary_rays

WITHOUT = (Embreex, Trimesh)  # which cannot be told to use one thread
PLAN = Plan(rounds=5, pause_s=0.0, repeats=3, slow_s=1.0)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene and a view, or a kind of single rays."""
    kinds = [kind for kind in run.kinds if kind not in WITHOUT]
    header: tuple[str, ...] = ("scene", "what", "Lucida ms (quartiles)")
    header += tuple(f"{kind.name} ms (times ours)" for kind in kinds)
    title = "Processor time of one thread: visibility at 1280x720, and single rays"
    table = Table("processor", title, header)
    plan = replace(PLAN, rounds=2) if run.quick else PLAN
    for subject in run.subjects("small", "70k", "1M"):
        run.say(f"processor: {subject.name}")
        with run.tracers(subject, *WITHOUT, threads=1) as tracers:
            for what, set_up in _cases(subject, 1 if run.quick else 3).items():
                for tracer in tracers:
                    set_up(tracer)
                timings = run.time(tracers, plan, processor_seconds)
                own = timings[Lucida.name]
                cells = [subject.name, what, ms(own)]
                for kind in kinds:
                    peer_s = timings[kind.name].median_s
                    cells.append(f"{short(1e3 * peer_s)} ({times(peer_s / own.median_s)})")
                table.add(
                    *cells,
                    scene=subject.name,
                    what=what,
                    times={name: timing.numbers() for name, timing in timings.items()},
                )
    return [table]


def _cases(subject: Subject, views: int) -> dict[str, Callable[[TracerProcess], None]]:
    """What is measured, and what sets a tracer up for it."""
    cases: dict[str, Callable[[TracerProcess], None]] = {}
    for view in easy_views(subject, HD)[:views]:
        cases[view.name] = partial(_image, view)
    for what, rays in secondary_rays(subject).items():
        cases[f"{what} rays"] = partial(_batch, *rays, what == "shadow")
    return cases


def _image(view: View, tracer: TracerProcess) -> None:
    tracer.image(view.camera, view.size)


def _batch(origins: Rays, directions: Rays, any_hit: bool, tracer: TracerProcess) -> None:
    tracer.batch(origins, directions, any_hit)
