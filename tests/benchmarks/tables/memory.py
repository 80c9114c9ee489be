"""Memory a triangle: what the tracers' structures take beyond the mesh itself.

Lucida's arrays are counted by tracemalloc, which sees every NumPy array. Beside it, for all
tracers, how a process grows by preparing the mesh: `python -m tests.benchmarks.tables.memory
NAME MESH` is such a process.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tracemalloc
from pathlib import Path

from renderer.scene import Mesh, Scene, SceneObject
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.peers import PEERS, Peer, Trimesh
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import SUBJECTS, Subject, bumpy_sphere, model

AT_MOST_BYTES = 120
STATM = Path("/proc/self/statm")


def measure(run: Run) -> list[Table]:
    """One table: arrays, and the process's growth, in bytes a triangle."""
    header = ("tracer", "triangles", "beyond vertices and indices", "peak of arrays", "process")
    table = Table("memory", "Memory, bytes a triangle", header)
    subject = run.subjects("70k" if run.quick else "1M")[0]
    run.say("memory: arrays")
    kept, peak = array_bytes(subject)
    own = (kept - mesh_bytes(subject)) / subject.triangles
    top = peak / subject.triangles
    for kind in run.all_kinds(Trimesh):
        run.say(f"memory: process of {kind.name}")
        growth = _process_bytes(kind, str(run.file or subject.name))
        grown = growth / subject.triangles
        ours = kind is Lucida
        table.add(
            kind.name,
            f"{subject.triangles:,}",
            short(own) if ours else "-",
            short(top) if ours else "-",
            short(grown),
            tracer=kind.name,
            triangles=subject.triangles,
            process_bytes=growth if math.isfinite(growth) else None,
            **({"array_bytes": kept, "peak_bytes": peak} if ours else {}),
        )
    table.target("beyond the mesh", own, AT_MOST_BYTES, "bytes a triangle", at_least=False)
    return [table]


def mesh_bytes(subject: Subject) -> int:
    """float32 vertices and int32 indices."""
    return subject.vertices.nbytes + subject.faces.nbytes


def array_bytes(subject: Subject) -> tuple[int, int]:
    """Bytes of Python's and NumPy's memory that a prepared Tracer keeps, and its peak before."""
    scene = Scene((SceneObject(Mesh(subject.vertices, subject.faces)),))
    warm = Lucida()
    warm.prepare(*bumpy_sphere(100))  # compiled, imported
    warm.close()
    lucida = Lucida()
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        lucida.prepare_scene(scene)
        after, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
        lucida.close()
    return after - before, peak - before


def _process_bytes(kind: type[Peer], wanted: str) -> float:
    """How much a process grows by preparing that mesh; NaN where the system does not say."""
    if not STATM.exists():
        return float("nan")
    command = [sys.executable, "-m", __name__, kind.name, wanted]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return float(json.loads(output.splitlines()[-1]))


def _worker(tracer: str, wanted: str) -> None:
    kinds: tuple[type[Peer], ...] = (Lucida, *PEERS)
    kind = next(kind for kind in kinds if kind.name == tracer)
    subject = SUBJECTS[wanted]() if wanted in SUBJECTS else model(wanted)
    warm, measured = kind(), kind()
    warm.prepare(*bumpy_sphere(100))
    before = _resident_bytes()
    measured.prepare(subject.vertices, subject.faces)
    print(json.dumps(_resident_bytes() - before))
    measured.close()
    warm.close()


def _resident_bytes() -> int:
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


if __name__ == "__main__":
    _worker(*sys.argv[1:])
