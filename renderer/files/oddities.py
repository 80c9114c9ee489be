"""Checks of a model's mesh by trimesh: legal, but perhaps not intended."""

from __future__ import annotations

import trimesh

from lucida.renderer.scene.model import Mesh
from lucida.renderer.scene.normals import merge_positions


def oddities(mesh: Mesh) -> list[str]:
    """Return what is odd about a mesh, in words."""
    joined = merge_positions(mesh.vertices)[mesh.faces]
    checked = trimesh.Trimesh(mesh.vertices, joined, process=False)
    if not checked.is_winding_consistent:
        return ["has neighbouring faces that are turned differently"]
    if not checked.is_watertight:
        return ["is open: some edges do not join two faces"]
    return ["is closed, and its faces are turned inwards"] if checked.volume < 0 else []
