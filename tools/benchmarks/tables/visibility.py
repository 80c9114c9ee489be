"""Primary visibility: ray parameter, primitive and normal of every pixel, rays' making included.

Three tables: the usual views of meshes of three sizes, hard views, and images full of scene: a
scanned surface, machine parts, a hall, a soup.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from tools.benchmarks.cameras import (
    View,
    dense_view,
    easy_views,
    facing,
    hard_views,
    interior_views,
    look,
    within,
)
from tools.benchmarks.embree import NativeEmbree
from tools.benchmarks.peers import Mitsuba, Open3D
from tools.benchmarks.report import Table, short
from tools.benchmarks.run import HD, Run, share_that_differs, size_text
from tools.benchmarks.scenes import Subject

AT_LEAST_MITSUBA = {"small": 2.0, "70k": 3.0, "1M": 2.5}  # ratios of times
AT_LEAST_OPEN3D = 8.0
AT_LEAST_FINE = {Mitsuba.name: 2.0, NativeEmbree.name: 1.5}  # in every view
FINE = ("scan", "parts")  # the first words of scenes with a triangle a pixel and more
ALIKE = 0.002  # a larger part of the pixels with another primitive is mentioned
# Triangles a pixel; quick: with a third of the triangles, from farther away.
DENSITIES = {"scan 66k": (0.1,), "scan 660k": (1.0,), "scan 2M": (3.0, 10.0, 30.0)}
QUICK_DENSITIES = {"scan 66k": (0.1,), "scan 660k": (1.0, 3.0, 10.0, 30.0)}

Ratios = dict[tuple[str, str], list[float]]  # by scene and peer
Cases = list[tuple[Subject, list[View]]]


def measure(run: Run) -> list[Table]:
    easy, ratios = _measured(
        run, "visibility", "t, primitive and normal of each pixel",
        [
            (subject, [view for size in run.sizes for view in easy_views(subject, size)])
            for subject in run.subjects("small", "70k", "1M")
        ],
    )  # fmt: skip
    for scene, bound in AT_LEAST_MITSUBA.items():
        if own := ratios.get((scene, Mitsuba.name)):
            easy.target(f"{scene}: slowest view, against Mitsuba", min(own), bound, "x")
            easy.target(f"{scene}: median of the views", float(np.median(own)), bound, "x")
    if of_open3d := [min(own) for (_, name), own in ratios.items() if name == Open3D.name]:
        easy.target("slowest view, against Open3D", min(of_open3d), AT_LEAST_OPEN3D, "x")

    cases = [(s, hard_views(s, HD)) for s in run.subjects("small", "1M", "ball 70k", "ball 1M")]
    if run.file is None:
        for subject in run.subjects("4M"):
            cases.append((subject, [View("triangles below a pixel", look(subject, HD), HD)]))
    hard, ratios = _measured(run, "hard views", "hard views", cases)
    if of_mitsuba := [min(own) for (_, name), own in ratios.items() if name == Mitsuba.name]:
        hard.target("worst view, against Mitsuba", min(of_mitsuba), 1.0, "x")
    if run.file is not None:
        return [easy, hard]

    title = "scans, seen whole and from within; machine parts; a hall; a soup"
    full, ratios = _measured(run, "scans", title, _full_cases(run))
    others: dict[str, float] = {}
    for (scene, peer), own in ratios.items():
        if not scene.startswith(FINE):
            others[peer] = min(*own, others.get(peer, np.inf))
    for peer, bound in AT_LEAST_FINE.items():
        for kind in FINE:
            own = [r for (s, name), r in ratios.items() if name == peer and s.startswith(kind)]
            if own:
                full.target(f"{kind}: slowest view, against {peer}", min(map(min, own)), bound, "x")
    if others:
        fastest = min(others, key=lambda peer: others[peer])
        name = f"hall and soup: slowest view, against the fastest ({fastest})"
        full.target(name, others[fastest], 1.0, "x")
    return [easy, hard, full]


def _full_cases(run: Run) -> Cases:
    cases = []
    for name, densities in (QUICK_DENSITIES if run.quick else DENSITIES).items():
        subject = run.subject(name)
        views = [dense_view(subject, d, size) for size in run.sizes for d in densities]
        cases.append((subject, views))
    cases[-1][1].extend(within(subject, size) for size in run.sizes)
    for subject in run.subjects("parts 760k", "parts 3M"):
        whole = View("whole", look(subject, HD, radii=4.5), HD)
        cases.append((subject, [*easy_views(subject, HD), whole]))
    cases.append((run.subject("interior"), interior_views(HD)))
    cases.append((run.subject("soup"), easy_views(run.subject("soup"), HD)[:2]))
    return cases


def _measured(run: Run, name: str, title: str, cases: Cases) -> tuple[Table, Ratios]:
    own = ("scene", "view", "size", "triangles a hit pixel", "Lucida ms (quartiles)", "Mrays/s")
    table = Table(name, f"Primary visibility: {title}", own + run.peer_columns())
    ratios: Ratios = defaultdict(list)
    for subject, views in cases:
        with run.tracers(subject) as tracers:
            for view in views:
                case = f"{subject.name}, {view.name}, {size_text(view.size)}"
                run.say(f"{name}: {case}")
                for tracer in tracers:
                    tracer.image(view.camera, view.size)
                timings = run.time(tracers)
                ours, *peers = tracers
                seen = ours.hits()
                for peer in peers:
                    share = share_that_differs(seen, peer.hits())
                    if share > ALIKE:
                        percent = f"{100 * share:.2g} % of the pixels"
                        table.notes.append(
                            f"{case}: {peer.name} sees another triangle in {percent}"
                        )
                hit = int(np.count_nonzero(seen.primitive >= 0))
                density = facing(subject, view.camera, view.size) / max(1, hit)
                found = table.compare(
                    subject.name, view.name, size_text(view.size), short(density),
                    timings=timings, rays=view.size[0] * view.size[1], hits=hit,
                    triangles=subject.triangles,
                )  # fmt: skip
                for peer_name, ratio in found.items():
                    ratios[subject.name, peer_name].append(ratio)
    return table, ratios
