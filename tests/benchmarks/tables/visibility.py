"""Primary visibility: ray parameter, primitive and normal of every pixel, rays' making included."""

from __future__ import annotations

import numpy as np

from tests.benchmarks.cameras import View, easy_views, facing, hard_views, look
from tests.benchmarks.measure import Timing
from tests.benchmarks.peers import Mitsuba, Open3D, Peer, Trimesh
from tests.benchmarks.processes import TracerProcess
from tests.benchmarks.report import Table, ms, short, times
from tests.benchmarks.run import HD, Run, share_that_differs, size_text
from tests.benchmarks.scenes import Subject

AT_LEAST_MITSUBA = {"small": 2.0, "70k": 3.0, "1M": 2.5}  # ratios of times
AT_LEAST_OPEN3D = AT_LEAST_TRIMESH = 8.0
ALIKE = 0.002  # a larger part of the pixels with another primitive is mentioned


def measure(run: Run) -> list[Table]:
    """Two tables: the usual views of meshes of three sizes, and the hard views."""
    title = "Primary visibility: t, primitive and normal of each pixel"
    easy = Table("visibility", title, header(run.kinds))
    ratios: dict[tuple[str, str], list[float]] = {}
    for subject in run.subjects("small", "70k", "1M"):
        with run.tracers(subject) as tracers:
            for size in run.sizes:
                for view in easy_views(subject, size):
                    for peer, ratio in add_view(run, easy, subject, view, tracers).items():
                        ratios.setdefault((subject.name, peer), []).append(ratio)
    _easy_targets(easy, ratios)

    fast = tuple(kind for kind in run.kinds if kind is not Trimesh)
    hard = Table("hard views", "Primary visibility in hard views", header(fast))
    worst: dict[str, list[float]] = {}
    for subject, views in _hard_cases(run):
        with run.tracers(subject, Trimesh) as tracers:
            for view in views:
                for peer, ratio in add_view(run, hard, subject, view, tracers).items():
                    worst.setdefault(peer, []).append(ratio)
    if Mitsuba.name in worst:
        hard.target("worst view, against Mitsuba", min(worst[Mitsuba.name]), 1.0, "x")
    return [easy, hard]


def header(kinds: tuple[type[Peer], ...]) -> tuple[str, ...]:
    """Of the tables that add_view fills."""
    own = ("scene", "view", "size", "triangles a hit pixel", "Lucida ms (quartiles)", "Mrays/s")
    return own + tuple(f"{kind.name} ms (times ours)" for kind in kinds)


def add_view(
    run: Run, table: Table, subject: Subject, view: View, tracers: list[TracerProcess]
) -> dict[str, float]:
    """Measures one view, adds its row; gives each peer's time over ours."""
    case = f"{subject.name}, {view.name}, {size_text(view.size)}"
    run.say(f"{table.name}: {case}")
    for tracer in tracers:
        tracer.image(view.camera, view.size)
    timings = run.time(tracers)
    ours, *peers = tracers
    seen = ours.hits()
    differs = {peer.name: share_that_differs(seen, peer.hits()) for peer in peers}
    for name, share in differs.items():
        if share > ALIKE:
            percent = f"{100 * share:.2g} % of the pixels"
            table.notes.append(f"{case}: {name} sees another triangle in {percent}")
    own = timings[ours.name]
    hit = int(np.count_nonzero(seen.primitive >= 0))
    pixels = view.size[0] * view.size[1]
    density = facing(subject, view.camera, view.size) / max(1, hit)
    ratios = {peer.name: timings[peer.name].median_s / own.median_s for peer in peers}
    table.add(
        subject.name,
        view.name,
        size_text(view.size),
        short(density),
        ms(own),
        short(pixels / own.median_s / 1e6),
        *(_beside(timings[name], ratio) for name, ratio in ratios.items()),
        scene=subject.name,
        triangles=subject.triangles,
        view=view.name,
        size=list(view.size),
        hit_share=hit / pixels,
        triangles_a_hit_pixel=density,
        differs=differs,
        times={name: timing.numbers() for name, timing in timings.items()},
    )
    return ratios


def _hard_cases(run: Run) -> list[tuple[Subject, list[View]]]:
    cases = [(s, hard_views(s, HD)) for s in run.subjects("small", "1M", "ball 70k", "ball 1M")]
    if run.file is None:
        for subject in run.subjects("4M"):
            tiny = View("triangles below a pixel", look(subject, HD), HD)
            cases.append((subject, [tiny]))
    return cases


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
