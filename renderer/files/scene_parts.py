"""A scene file's objects before they are placed: shapes, and models' parts.

Each is built or read once, or taken from the scene before a change.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any

from lucida.renderer.files.models.models import ModelFile, load_model
from lucida.renderer.files.schema import (
    BoxTable,
    ConeTable,
    CylinderTable,
    DiskTable,
    MeshTable,
    ModelTable,
    ObjectTable,
    RectangleTable,
    TorusTable,
)
from lucida.renderer.scene import shapes
from lucida.renderer.scene.limits import SEGMENTS
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, SceneObject
from lucida.renderer.scene.origin import FileEntry
from lucida.renderer.scene.shape_coordinates import on_box, on_cylinder, on_plane, on_torus
from lucida.renderer.system.errors import LucidaError

# For each shape the function that makes it, the one that adds texture coordinates, and its number
# of triangles per segment (and side of a tube).
_SHAPES: dict[type[ObjectTable], tuple[Callable[..., Mesh], Callable[[Mesh], Mesh], int]] = {
    BoxTable: (shapes.box, on_box, 12),
    RectangleTable: (shapes.rectangle, on_plane, 2),
    DiskTable: (shapes.disk, on_plane, 1),
    CylinderTable: (shapes.cylinder, on_cylinder, 4),
    ConeTable: (shapes.cone, on_cylinder, 2),
    TorusTable: (shapes.torus, on_plane, 2),
}


class SceneParts:
    """Shapes and models before they are placed. entries: of the scene before a change."""

    def __init__(self, folder: Path, entries: tuple[FileEntry, ...]) -> None:
        self._folder = folder
        self._models: dict[str, ModelFile] = {}  # by path
        self._meshes: dict[Hashable, tuple[SceneObject, ...]] = {}
        for entry in entries:
            if isinstance(entry.fields, ModelTable):
                found = ModelFile(entry.made, entry.views, entry.notes)
                self._models.setdefault(entry.path, found)
            elif entry.made:
                is_mapped = _unmapped(entry.made) is None
                self._meshes.setdefault(_key(entry.fields, is_mapped), entry.made)

    def path(self, file: str) -> str:
        return os.path.abspath(self._folder / file)

    def model(self, file: str) -> ModelFile:
        path = self.path(file)
        if path not in self._models:
            try:
                self._models[path] = load_model(self._folder / file)
            except LucidaError as error:
                where = ": ".join(part for part in (str(self._folder / file), error.field) if part)
                raise LucidaError("file", f"{where}: {error.problem}", error.remedy) from None
        return self._models[path]

    def mesh(self, table: MeshTable, material: Material | None) -> tuple[SceneObject, ...]:
        """Return a shape, with texture coordinates if the material has a texture."""
        is_mapped = is_textured(material)
        key = _key(table, is_mapped)
        if key not in self._meshes:
            make, mapped, _ = _SHAPES[type(table)]
            mesh = make(**_own_fields(table))
            if is_mapped:
                if isinstance(table, TorusTable):
                    mesh = on_torus(mesh, table.radius)
                else:
                    mesh = mapped(mesh)
            self._meshes[key] = (SceneObject(mesh),)
        return self._meshes[key]


def made_triangles(table: ObjectTable) -> int:
    """Return a shape's number of triangles; 0 for a sphere or a model.

    Illegal numbers of segments, which the shape refuses, count as the nearest legal one.
    """
    count = _SHAPES[type(table)][2] if type(table) in _SHAPES else 0
    for name in ("segments", "sides"):
        count *= min(max(getattr(table, name, 1), 0), SEGMENTS)
    return count


def is_textured(material: Material | None) -> bool:
    return material is not None and material.image is not None


def check_mapped(table: ModelTable, made: tuple[SceneObject, ...]) -> None:
    """Check that a model's parts can show a texture."""
    if (part := _unmapped(made)) is not None:
        name = f"{table.name}/{part.name}" if table.name and part.name else table.name
        raise LucidaError(
            "material",
            f"has a texture, and {name or part.name!r} of {table.file!r} no texture coordinates",
            "export the model with them (UVs), or give a material without texture",
        )


def _own_fields(table: MeshTable) -> dict[str, Any]:
    """Return the fields of the table's kind of shape, which are the parameters of its function."""
    common = MeshTable.__struct_fields__
    return {name: getattr(table, name) for name in table.__struct_fields__ if name not in common}


def _key(table: MeshTable, is_mapped: bool) -> Hashable:
    """Return a key that is equal for tables of the same shape."""
    return type(table), is_mapped, *_own_fields(table).values()


def _unmapped(made: tuple[SceneObject, ...]) -> SceneObject | None:
    """Return the first part without texture coordinates."""
    meshes = (part for part in made if isinstance(part.shape, Mesh) and part.shape.uv is None)
    return next(meshes, None)
