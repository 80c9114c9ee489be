"""The benchmark's scenes: meshes by name, a mesh from a file, and scenes made of them.

Knows nothing of cameras and of who traces.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files import load_scene
from lucida.renderer.scene import Mesh, Scene, SceneObject, flatten
from lucida.renderer.scene.positions import world_vertices
from tools.benchmarks.interior import interior
from tools.benchmarks.meshes import (
    Faces,
    Vertices,
    bumpy_sphere,
    knot,
    machine_parts,
    scanned_sphere,
    soup,
    table_top,
)


@dataclass(frozen=True, eq=False)
class Subject:
    """A mesh under a name. vertices: float32 (n, 3). faces: int32 (m, 3).

    inside: a point from which every ray hits, or None if none is known.
    """

    name: str
    vertices: Vertices
    faces: Faces
    inside: tuple[float, float, float] | None = None

    @property
    def triangles(self) -> int:
        return len(self.faces)

    @property
    def centre(self) -> NDArray[np.float64]:
        return (self.vertices.min(0) + self.vertices.max(0)).astype(float) / 2

    @property
    def radius(self) -> float:
        """Half of the bounding box's diagonal."""
        return float(np.linalg.norm(self.vertices.max(0) - self.vertices.min(0))) / 2


def _ball(name: str, triangles: int) -> Subject:
    return Subject(name, *bumpy_sphere(triangles), inside=(0.0, 0.0, 0.0))


def _scan(name: str, triangles: int) -> Subject:
    return Subject(name, *scanned_sphere(triangles), inside=(0.0, 0.0, 0.0))


SUBJECTS: dict[str, Callable[[], Subject]] = {
    "small": lambda: Subject("small", *table_top(4_100)),
    "70k": lambda: Subject("70k", *knot(70_000)),
    "1M": lambda: Subject("1M", *knot(1_000_000)),
    "4M": lambda: Subject("4M", *knot(4_000_000)),
    "ball 4k": lambda: _ball("ball 4k", 4_000),
    "ball 70k": lambda: _ball("ball 70k", 70_000),
    "ball 1M": lambda: _ball("ball 1M", 1_000_000),
    "interior": lambda: Subject("interior", *interior()),
    "soup": lambda: Subject("soup", *soup(200_000)),
    "scan 66k": lambda: _scan("scan 66k", 66_000),
    "scan 660k": lambda: _scan("scan 660k", 660_000),
    "scan 2M": lambda: _scan("scan 2M", 2_000_000),
    "parts 760k": lambda: Subject("parts 760k", *machine_parts(4)),
    "parts 3M": lambda: Subject("parts 3M", *machine_parts(5)),
}


def model(path: str | Path) -> Subject:
    """All triangles of a model or scene file, as one mesh. Raises LucidaError."""
    flat = flatten(load_scene(path))
    vertices = world_vertices(flat).astype(np.float32)
    return Subject(Path(path).name, vertices, np.array(flat.faces))


def scene_of(subject: Subject) -> Scene:
    """The mesh as a scene of one object."""
    return Scene((SceneObject(Mesh(subject.vertices, subject.faces)),), name=subject.name)
