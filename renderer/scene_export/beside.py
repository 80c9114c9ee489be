"""The PLY files beside a scene: one for each mesh that differs, however often it is placed."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from renderer.scene.model import Color, Mesh
from renderer.scene_export.meshes import Triangles, is_mirrored, ply_bytes, triangles

LONGEST = 40  # letters of an object's name in a file's


class MeshFiles:
    """stem: of the scene's file."""

    def __init__(self, stem: str) -> None:
        self._folder = f"{stem}_meshes"
        self._names: dict[tuple[object, ...], str] = {}
        self.contents: dict[str, Callable[[], bytes]] = {}

    def file_of(
        self, mesh: Mesh, name: str, color: Color = (1.0, 1.0, 1.0), made: Triangles | None = None
    ) -> str:
        """The path, from the scene's folder, of a file of this mesh. color: multiplies the
        vertices' own. made: other triangles that stand for it."""
        mirrored = is_mirrored(mesh.transform)
        arrays = (mesh.vertices, mesh.faces, mesh.normals, mesh.colors)
        key: tuple[object, ...] = (*map(id, arrays), mirrored)
        key += (color if mesh.colors is not None else None, id(made) if made else None)
        if key not in self._names:
            plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", name).strip("-.")[:LONGEST]
            number = len(self._names)
            file = f"{self._folder}/{number}{f'-{plain}' if plain else ''}.ply"
            self._names[key] = file
            self.contents[file] = partial(_content, mesh, color, mirrored, made)
        return self._names[key]


def _content(mesh: Mesh, color: Color, mirrored: bool, made: Triangles | None) -> bytes:
    return ply_bytes(made or triangles(mesh), color, mirrored)
