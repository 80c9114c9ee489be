"""Primary visibility where the image is full of scene: a scanned surface, a hall, a soup."""

from __future__ import annotations

from tests.benchmarks.cameras import View, dense_view, easy_views, interior_views, within
from tests.benchmarks.embree import NativeEmbree
from tests.benchmarks.peers import Embreex, Mitsuba, Trimesh
from tests.benchmarks.report import Table
from tests.benchmarks.run import HD, Run
from tests.benchmarks.scenes import Subject
from tests.benchmarks.tables.visibility import add_view, header

AT_LEAST = {Mitsuba.name: 2.0, NativeEmbree.name: 1.5}  # every view of a scan
WITHOUT = (Embreex, Trimesh)  # the same Embree, at a fraction of its speed
# Triangles a pixel; quick: with a third of the triangles, from farther away.
DENSITIES = {"scan 66k": (0.1,), "scan 660k": (1.0,), "scan 2M": (3.0, 10.0, 30.0)}
QUICK_DENSITIES = {"scan 66k": (0.1,), "scan 660k": (1.0, 3.0, 10.0, 30.0)}


def measure(run: Run) -> list[Table]:
    """One table: a row a scene, view and size; none for a model from a file."""
    if run.file is not None:
        return []
    kinds = tuple(kind for kind in run.kinds if kind not in WITHOUT)
    title = "Primary visibility: scans, seen whole and from within; a hall; a soup"
    table = Table("scans", title, header(kinds))
    ratios: dict[tuple[bool, str], list[float]] = {}
    for subject, views in _cases(run):
        with run.tracers(subject, *WITHOUT) as tracers:
            for view in views:
                scan = subject.name.startswith("scan")
                for peer, ratio in add_view(run, table, subject, view, tracers).items():
                    ratios.setdefault((scan, peer), []).append(ratio)
    for peer, bound in AT_LEAST.items():
        if (True, peer) in ratios:
            name = f"scans: slowest view, against {peer}"
            table.target(name, min(ratios[True, peer]), bound, "x")
    others = {peer: min(own) for (scan, peer), own in ratios.items() if not scan}
    if others:
        fastest = min(others, key=lambda peer: others[peer])
        name = f"hall and soup: slowest view, against the fastest ({fastest})"
        table.target(name, others[fastest], 1.0, "x")
    return [table]


def _cases(run: Run) -> list[tuple[Subject, list[View]]]:
    cases = []
    for name, densities in (QUICK_DENSITIES if run.quick else DENSITIES).items():
        subject = run.subject(name)
        views = [dense_view(subject, d, size) for size in run.sizes for d in densities]
        cases.append((subject, views))
    cases[-1][1].extend(within(subject, size) for size in run.sizes)
    cases.append((run.subject("interior"), interior_views(HD)))
    cases.append((run.subject("soup"), easy_views(run.subject("soup"), HD)[:2]))
    return cases
