"""The time of the first image, with kernels compiled anew and with kernels from the cache.

Each start is a process of its own. `python -m tests.benchmarks.tables.compilation` is such a
process: it prints what it measured. `lucida render`, the whole command, is measured with both
renderers in turn.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

from renderer.scene import BUILTIN_SCENES, load_scene
from tests.benchmarks.measure import Plan, Timing, interleaved, turn
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import HD, Run

COLD_AT_MOST_S, WARM_AT_MOST_S, OVER_RASTER_AT_MOST_S = 3.0, 0.2, 0.25
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
        run.say("compilation: the whole command")
        commands = _whole_commands(folder, 3 if run.quick else 9)
    for name, starts in (("cold", [cold]), ("warm", warm)):
        parts = {part: Timing(tuple(start[part] for start in starts)) for part in PARTS}
        cells = (short(timing.median_s) for timing in parts.values())
        numbers = {part: timing.numbers() for part, timing in parts.items()}
        table.add(name, *cells, start=name, **numbers)
    image_s = Timing(tuple(start["image_s"] for start in warm)).median_s
    table.target("cold: first image", cold["image_s"], COLD_AT_MOST_S, "s", at_least=False)
    table.target("warm: first image", image_s, WARM_AT_MOST_S, "s", at_least=False)
    for name, timing in commands.items():
        cells = (f"lucida render, {name}", short(timing.median_s), "-", "-", "-")
        table.add(*cells, start=name, process_s=timing.numbers())
    over_s = commands["ray"].median_s - commands["raster"].median_s if commands else math.nan
    name = "lucida render: ray's whole process over raster's"
    table.target(name, over_s, OVER_RASTER_AT_MOST_S, "s", at_least=False)
    table.notes.append("First image: from Tracer(scene) to its frame, numba being imported.")
    return [table]


def _start(cache_folder: str) -> dict[str, float]:
    """Runs one process with that cache folder; gives the parts' times."""
    begin = time.perf_counter()
    output = subprocess.run(
        [sys.executable, "-m", __name__],
        env=_environment(cache_folder),
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    whole_s = time.perf_counter() - begin
    return {"process_s": whole_s, **json.loads(output)}


def _environment(cache_folder: str) -> dict[str, str]:
    environment = dict(os.environ, NUMBA_CACHE_DIR=cache_folder)
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installation keeps its modules' byte code
    return environment


def _whole_commands(cache_folder: str, rounds: int) -> dict[str, Timing]:
    """The seconds of `lucida render` with each renderer, warm; none where there is no OpenGL."""
    out = Path(cache_folder) / "image.npy"
    plan = Plan(rounds=rounds, repeats=1)

    def render(renderer: str) -> None:
        command = [sys.executable, "-m", "app", "render", BUILTIN_SCENES[0], "-o", str(out)]
        size = ["--size", "x".join(map(str, HD))]
        done = subprocess.run(
            [*command, "--renderer", renderer, *size],
            env=_environment(cache_folder),
            capture_output=True,
        )
        done.check_returncode()

    try:
        render("raster")
    except subprocess.CalledProcessError:
        return {}
    turns = {name: partial(turn, partial(render, name), plan) for name in ("raster", "ray")}
    return interleaved(turns, plan)


def _worker() -> None:
    begin = time.perf_counter()
    import numba  # noqa: F401

    numba_s = time.perf_counter() - begin
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
