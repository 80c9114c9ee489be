"""Checks for oddities in a scene's meshes, by trimesh: open, inside out, degenerate faces.

All of them are legal: the renderers draw them as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import trimesh

from lucida.renderer.files.schema import DiskTable, RectangleTable
from lucida.renderer.scene.model import Mesh, Scene
from lucida.renderer.scene.normals import merge_positions

_LEAST_HEIGHT = 1e-9  # of a triangle, relative to its mesh's size
_SURFACES = (RectangleTable, DiskTable)  # open by design


@dataclass(frozen=True)
class Oddity:
    """An oddity of a scene.

    kind: one word, for programs. text: for people, without the object's name. object: its id.
    """

    kind: str
    text: str
    object: int


def oddities(scene: Scene) -> tuple[Oddity, ...]:
    found: list[Oddity] = []
    surfaces = _surfaces(scene)
    known: dict[tuple[int, int], list[tuple[str, str]]] = {}
    for number, entry in enumerate(scene.objects):
        if isinstance(mesh := entry.shape, Mesh):
            key = id(mesh.vertices), id(mesh.faces)  # copies share them
            if key not in known:
                known[key] = list(_of_mesh(mesh))
            is_surface = number in surfaces
            found += [
                Oddity(kind, text, number)
                for kind, text in known[key]
                if not (is_surface and kind == "open")
            ]
    return tuple(found)


def _of_mesh(mesh: Mesh) -> Iterator[tuple[str, str]]:
    """Yield kind and text of each oddity of a mesh."""
    faces = merge_positions(mesh.vertices)[mesh.faces]
    checked = trimesh.Trimesh(mesh.vertices, faces, process=False)
    flat = ~checked.nondegenerate_faces(height=_LEAST_HEIGHT * checked.scale)
    repeated = len(faces) - int(np.count_nonzero(checked.unique_faces()))
    if flat.any():
        yield "flat-faces", f"has {_counted(int(flat.sum()), 'face')} without an area"
    if repeated:
        yield "repeated-faces", f"has {_counted(repeated, 'face')} with another one's corners"
    if not checked.is_winding_consistent:
        yield "turned-differently", "has neighbouring faces that are turned differently"
    if not checked.is_watertight:
        yield "open", "is open: some edges do not join two faces"
    elif checked.is_winding_consistent and checked.volume < 0:
        yield "inside-out", "is closed, and its faces are turned inwards"


def _surfaces(scene: Scene) -> set[int]:
    """Return the ids of objects that are open by design."""
    found: set[int] = set()
    number = 0
    for entry in scene.origin.entries if scene.origin is not None else ():
        if isinstance(entry.fields, _SURFACES):
            found.add(number)
        number += len(entry.objects)
    return found


def _counted(count: int, one: str) -> str:
    return f"{count} {one}{'' if count == 1 else 's'}"
