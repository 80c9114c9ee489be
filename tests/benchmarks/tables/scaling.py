"""The growth of times: with the threads, with the pixels, with the triangles."""

from __future__ import annotations

from tests.benchmarks.cameras import easy_views
from tests.benchmarks.measure import Timing, Turn, interleaved, seconds
from tests.benchmarks.meshes import knot
from tests.benchmarks.peers import Peer, processors
from tests.benchmarks.report import Table, short, times
from tests.benchmarks.run import HD, Run, size_text
from tests.benchmarks.scenes import Subject

SIZES = ((640, 360), (1280, 720), (2560, 1440))
TRIANGLES = (10_000, 100_000, 1_000_000)


def measure(run: Run) -> list[Table]:
    """One table: a row a number of threads, of pixels, of triangles; the knot, perspective."""
    kinds = run.all_kinds
    header = ("what grows", "to", *(f"{kind.name} ms (times the row above)" for kind in kinds))
    table = Table("scaling", "Scaling: threads, pixels x4, triangles x10; visibility", header)
    middle = Subject("100k", *knot(100_000))
    counts = sorted({1, 2, processors()} & set(range(1, processors() + 1)))
    _grow(run, table, kinds, "threads", [(str(n), middle, HD, n) for n in counts])
    _grow(run, table, kinds, "pixels", [(size_text(s), middle, s, None) for s in SIZES])
    if not run.quick:
        meshes = [Subject(f"{n:,}", *knot(n)) for n in TRIANGLES]
        _grow(run, table, kinds, "triangles", [(m.name, m, HD, None) for m in meshes])
    return [table]


def _grow(
    run: Run,
    table: Table,
    kinds: tuple[type[Peer], ...],
    axis: str,
    steps: list[tuple[str, Subject, tuple[int, int], int | None]],
) -> None:
    """Measures all steps of one axis in the same rounds."""
    run.say(f"scaling: {axis}")
    turns: dict[str, Turn] = {}
    processes = [run.process(kind) for kind in kinds]
    try:
        for step, subject, size, threads in steps:
            for process in processes:
                process.prepare(subject, threads, key=step)
                process.image(easy_views(subject, size)[0].camera, size, key=step)
                turns[f"{step} {process.name}"] = process.turn(run.plan, seconds, key=step)
        timings = interleaved(turns, run.plan)
    finally:
        for process in processes:
            process.release()
    above: dict[str, Timing] = {}
    for step, subject, size, threads in steps:
        own = {kind.name: timings[f"{step} {kind.name}"] for kind in kinds}
        cells = []
        for name, timing in own.items():
            growth = timing.median_s / above[name].median_s if above else float("nan")
            cells.append(short(1e3 * timing.median_s) + (f" ({times(growth)})" if above else ""))
        above = own
        table.add(
            axis,
            step,
            *cells,
            axis=axis,
            threads=threads or processors(),
            size=list(size),
            triangles=subject.triangles,
            times={name: timing.numbers() for name, timing in own.items()},
        )
