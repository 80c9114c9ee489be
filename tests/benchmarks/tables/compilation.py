"""How long the first image takes: kernels compiled anew, and kernels from the cache.

Each start is a process of its own. `python -m tests.benchmarks.tables.compilation` is such a
process: it prints what it measured.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time

from tests.benchmarks.measure import Timing
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import HD, Run

COLD_AT_MOST_S, WARM_AT_MOST_S = 6.0, 0.2
PARTS = ("process_s", "numba_s", "image_s", "second_s")


def measure(run: Run) -> list[Table]:
    """One table: a cold start, and the median of warm ones."""
    header = ("start", "whole process s", "import numba s", "first image s", "second image s")
    title = "Start: to the first traced image (1280x720, the built-in scene, shaded)"
    table = Table("compilation", title, header)
    with tempfile.TemporaryDirectory() as folder:
        run.say("compilation: cold")
        cold = _start(folder)
        run.say("compilation: warm")
        warm = [_start(folder) for _ in range(3 if run.quick else 7)]
    for name, starts in (("cold", [cold]), ("warm", warm)):
        parts = {part: Timing(tuple(start[part] for start in starts)) for part in PARTS}
        cells = (short(timing.median_s) for timing in parts.values())
        numbers = {part: timing.numbers() for part, timing in parts.items()}
        table.add(name, *cells, start=name, **numbers)
    image_s = Timing(tuple(start["image_s"] for start in warm)).median_s
    table.target("cold: first image", cold["image_s"], COLD_AT_MOST_S, "s", at_least=False)
    table.target("warm: first image", image_s, WARM_AT_MOST_S, "s", at_least=False)
    table.notes.append("First image: from Tracer(scene) to its frame, numba being imported.")
    return [table]


def _start(cache_folder: str) -> dict[str, float]:
    """Runs one process with that cache folder; gives the parts' times."""
    environment = dict(os.environ, NUMBA_CACHE_DIR=cache_folder)
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installation keeps its modules' byte code
    begin = time.perf_counter()
    output = subprocess.run(
        [sys.executable, "-m", __name__],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    whole_s = time.perf_counter() - begin
    return {"process_s": whole_s, **json.loads(output)}


def _worker() -> None:
    begin = time.perf_counter()
    import numba  # noqa: F401

    numba_s = time.perf_counter() - begin
    from renderer.scene import BUILTIN_SCENES, load_scene
    from renderer.trace import Tracer

    scene = load_scene(BUILTIN_SCENES[0])
    camera = scene.view.for_size(HD)
    begin = time.perf_counter()
    with Tracer(scene) as tracer:
        tracer.render(camera, HD)
        image_s = time.perf_counter() - begin
        begin = time.perf_counter()
        tracer.render(camera, HD)
        second_s = time.perf_counter() - begin
    print(json.dumps({"numba_s": numba_s, "image_s": image_s, "second_s": second_s}))


if __name__ == "__main__":
    _worker()
