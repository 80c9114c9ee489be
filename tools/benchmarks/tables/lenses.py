"""Processor time of one thread: images through lenses, beside the pinhole's and native Embree.

Embree gets its rays ready-made, in the order of the pixels; of the other peers, none takes a lens.
"""

from __future__ import annotations

import numpy as np

from tools.benchmarks.cameras import lens_views
from tools.benchmarks.embree import NativeEmbree
from tools.benchmarks.lucida import Lucida
from tools.benchmarks.measure import processor_seconds
from tools.benchmarks.report import Table, short
from tools.benchmarks.run import HD, Run
from tools.benchmarks.tables.processor import PLAN

MOST_OF_PINHOLE = 3.0


def measure(run: Run) -> list[Table]:
    """One table: a row a scene and a lens. The pinhole of a row is the one above it."""
    kinds = [kind for kind in run.all_kinds if kind in (Lucida, NativeEmbree)]
    columns = [f"{kind.name} ms (times ours)" for kind in kinds[1:]]
    header = ("scene", "lens", "hit pixels", "Lucida ms (quartiles)", *columns)
    title = "Lenses: t, primitive and normal at 1280x720, processor time of one thread"
    table = Table("lenses", title, header)
    of_pinhole, of_embree, seconds = [], [], 0.0
    for subject in run.subjects("small", "70k", "1M"):
        run.say(f"lenses: {subject.name}")
        tracers = [run.process(kind) for kind in kinds]
        try:
            for tracer in tracers:
                tracer.prepare(subject, 1)
            for view in lens_views(subject, HD):
                for tracer in tracers:
                    tracer.image(view.camera, view.size)
                timings = run.time(tracers, PLAN, processor_seconds)
                hit = float(np.mean(tracers[0].hits().primitive >= 0))
                percent = f"{short(100 * hit)} %"
                found = table.compare(subject.name, view.name, percent, timings=timings)
                own = timings[Lucida.name].median_s
                if view.camera.lens is None:
                    seconds = own
                    continue
                of_pinhole.append(own / seconds)
                of_embree += found.values()
        finally:
            for tracer in tracers:
                tracer.release()
    name = "slowest lens, times the pinhole"
    table.target(name, max(of_pinhole), MOST_OF_PINHOLE, "x", at_least=False)
    if of_embree:
        table.target(f"slowest lens, against {NativeEmbree.name}", min(of_embree), 1.0, "x")
    return [table]
