"""Primary visibility: ray parameter, primitive and normal of every pixel, rays' making included."""

from __future__ import annotations

from functools import partial

import numpy as np

from tests.benchmarks.cameras import View, easy_views, hard_views, look
from tests.benchmarks.measure import Timing
from tests.benchmarks.peers import Mitsuba, Open3D, Peer, Trimesh
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import HD, Run, share_that_differs, size_text
from tests.benchmarks.scenes import Subject

AT_LEAST_MITSUBA = {"small": 2.0, "70k": 3.0, "1M": 2.5}  # issue of the tracer: ratios of times
AT_LEAST_OPEN3D = AT_LEAST_TRIMESH = 8.0
ALIKE = 0.002  # a larger part of the pixels with another primitive is mentioned


def measure(run: Run) -> list[Table]:
    """Two tables: the usual views of meshes of three sizes, and the hard views."""
    kinds = run.kinds
    header: tuple[str, ...] = ("scene", "view", "size", "Lucida ms (quartiles)", "Mrays/s")
    header += tuple(f"{kind.name} ms (times ours)" for kind in kinds)
    easy = Table("visibility", "Primary visibility: t, primitive and normal of each pixel", header)
    ratios: dict[tuple[str, str], list[float]] = {}
    for subject in run.subjects("small", "70k", "1M"):
        with run.tracers(subject) as tracers:
            for size in run.sizes:
                for view in easy_views(subject, size):
                    run.say(f"visibility: {subject.name}, {view.name}, {size_text(size)}")
                    for peer, ratio in _case(run, easy, subject, view, tracers).items():
                        ratios.setdefault((subject.name, peer), []).append(ratio)
    _easy_targets(easy, ratios)

    fast = tuple(kind for kind in kinds if kind is not Trimesh)
    header = header[:5] + tuple(f"{kind.name} ms (times ours)" for kind in fast)
    hard = Table("hard views", "Primary visibility in hard views", header)
    worst: dict[str, list[float]] = {}
    for subject, views in _hard_cases(run):
        with run.tracers(subject, Trimesh) as tracers:
            for view in views:
                run.say(f"hard views: {subject.name}, {view.name}")
                for peer, ratio in _case(run, hard, subject, view, tracers).items():
                    worst.setdefault(peer, []).append(ratio)
    if Mitsuba.name in worst:
        hard.target("worst view, against Mitsuba", min(worst[Mitsuba.name]), 1.0, "x")
    return [easy, hard]


def _hard_cases(run: Run) -> list[tuple[Subject, list[View]]]:
    cases = [(s, hard_views(s, HD)) for s in run.subjects("small", "1M", "ball 70k", "ball 1M")]
    if run.file is None:
        for subject in run.subjects("4M"):
            tiny = View("triangles below a pixel", look(subject, HD), HD)
            cases.append((subject, [tiny]))
    return cases


def _case(
    run: Run, table: Table, subject: Subject, view: View, tracers: list[Peer]
) -> dict[str, float]:
    """Measures one view, adds its row; gives each peer's time over ours."""
    calls = {t.name: partial(t.trace, view.camera, view.size) for t in tracers}
    timings = run.time(calls)
    ours, *peers = tracers
    seen = ours.read(ours.trace(view.camera, view.size))
    differs = {}
    for peer in peers:
        share = share_that_differs(seen, peer.read(peer.trace(view.camera, view.size)))
        differs[peer.name] = share
        if share > ALIKE:
            table.notes.append(
                f"{subject.name}, {view.name}, {size_text(view.size)}: {peer.name} sees another "
                f"triangle in {100 * share:.2g} % of the pixels"
            )
    own = timings[ours.name]
    pixels = view.size[0] * view.size[1]
    cells = [subject.name, view.name, size_text(view.size), ms(own)]
    cells.append(short(pixels / own.median_s / 1e6))
    ratios = {peer.name: timings[peer.name].median_s / own.median_s for peer in peers}
    cells += [_beside(timings[name], ratio) for name, ratio in ratios.items()]
    table.add(
        *cells,
        scene=subject.name,
        triangles=subject.triangles,
        view=view.name,
        size=list(view.size),
        hit_share=float(np.mean(seen.primitive >= 0)),
        differs=differs,
        times={name: timing.numbers() for name, timing in timings.items()},
    )
    return ratios


def _beside(timing: Timing, ratio: float) -> str:
    return f"{short(1e3 * timing.median_s)} ({times(ratio)})"


def _easy_targets(table: Table, ratios: dict[tuple[str, str], list[float]]) -> None:
    for scene, bound in AT_LEAST_MITSUBA.items():
        own = ratios.get((scene, Mitsuba.name))
        if own:
            table.target(f"{scene}: slowest view, against Mitsuba", min(own), bound, "x")
            table.target(f"{scene}: median of the views", float(np.median(own)), bound, "x")
    for kind, bound in ((Open3D, AT_LEAST_OPEN3D), (Trimesh, AT_LEAST_TRIMESH)):
        all_of = [r for (_, name), own in ratios.items() if name == kind.name for r in own]
        if all_of:
            table.target(f"slowest view, against {kind.name}", min(all_of), bound, "x")
