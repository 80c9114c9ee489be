"""Memory a triangle: what the tracers' structures take beyond the mesh itself.

Lucida's arrays are counted by tracemalloc, which sees every NumPy array. Beside it, for all
tracers, how a fresh process grows by preparing the mesh.
"""

from __future__ import annotations

import math
import tracemalloc

from renderer.scene import Mesh, Scene, SceneObject
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.meshes import bumpy_sphere
from tests.benchmarks.peers import Peer, Trimesh
from tests.benchmarks.processes import TracerProcess
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import Subject

AT_MOST_BYTES = 120


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
        growth = _process_bytes(kind, subject)
        grown = growth / subject.triangles if growth >= 0 else math.nan
        ours = kind is Lucida
        table.add(
            kind.name,
            f"{subject.triangles:,}",
            short(own) if ours else "-",
            short(top) if ours else "-",
            short(grown),
            tracer=kind.name,
            triangles=subject.triangles,
            process_bytes=growth if growth >= 0 else None,
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


def _process_bytes(kind: type[Peer], subject: Subject) -> int:
    """How much a process grows by preparing that mesh; -1 where the system does not say."""
    process = TracerProcess(kind)
    try:
        process.prepare(Subject("warm", *bumpy_sphere(100)), key="warm")
        return process.prepare(subject)
    finally:
        process.close()
