"""Processor time of one thread: what other programs on the machine do hardly counts.

Clocks on the wall tell what a user waits for, but on a busy machine more about the others. These
ratios can be trusted there too.
"""

from __future__ import annotations

from functools import partial

from tests.benchmarks.cameras import easy_views
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.measure import Call, Plan, interleaved, processor_seconds
from tests.benchmarks.peers import Mitsuba, Open3D, Peer
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import HD, Run
from tests.benchmarks.scenes import Subject
from tests.benchmarks.tables.secondary import secondary_rays

PEERS: tuple[type[Peer], ...] = (Mitsuba, Open3D)  # which can be told to use one thread
PLAN = Plan(rounds=5, quiet_s=0.0, warm_s=0.0, repeats=3, slow_s=1.0)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene and a view, or a kind of single rays."""
    kinds = [kind for kind in run.kinds if kind in PEERS]
    header: tuple[str, ...] = ("scene", "what", "Lucida ms (quartiles)")
    header += tuple(f"{kind.name} ms (times ours)" for kind in kinds)
    title = "Processor time of one thread: visibility at 1280x720, and single rays"
    table = Table("processor", title, header)
    for subject in run.subjects("small", "70k", "1M"):
        run.say(f"processor: {subject.name}")
        tracers: dict[str, Peer] = {kind.name: kind(threads=1) for kind in (Lucida, *kinds)}
        for tracer in tracers.values():
            tracer.prepare(subject.vertices, subject.faces)
        for what, calls in _cases(subject, tracers).items():
            timings = interleaved(calls, PLAN, processor_seconds)
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
        for tracer in tracers.values():
            tracer.close()
    return [table]


def _cases(subject: Subject, tracers: dict[str, Peer]) -> dict[str, dict[str, Call]]:
    """What is measured, and each tracer's call for it."""
    cases: dict[str, dict[str, Call]] = {}
    for view in easy_views(subject, HD):
        cases[view.name] = {
            name: partial(tracer.trace, view.camera, view.size) for name, tracer in tracers.items()
        }
    for what, rays in secondary_rays(subject).items():
        cases[f"{what} rays"] = {
            name: partial(
                tracer.any_hits if what == "shadow" else tracer.closest_hits, tracer.batch(*rays)
            )
            for name, tracer in tracers.items()
        }
    return cases
