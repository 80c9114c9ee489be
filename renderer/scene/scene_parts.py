"""A scene file's objects before they are placed: shapes, and models' parts.

Each is built and read once, or taken from the scene as it was before a change.
"""

from __future__ import annotations

import os
from collections.abc import Hashable
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.model import FileEntry, Material, Mesh, SceneObject
from renderer.scene.models import ModelFile, load_model, read_model
from renderer.scene.procedural import mapped, mesh_of, shape_of
from renderer.scene.repairs import repairs
from renderer.scene.schema import MeshTable, ModelTable


class SceneParts:
    """Shapes before they are put where they are: each is built once, each model read once. entries:
    those of the scene before, which has some."""

    def __init__(self, folder: Path, entries: tuple[FileEntry, ...]) -> None:
        self._folder = folder
        self._models: dict[tuple[str, bool], ModelFile] = {}  # by path and is_mapped
        self._meshes: dict[tuple[Hashable, bool], tuple[SceneObject, ...]] = {}
        for entry in entries:
            if isinstance(entry.fields, ModelTable):
                found = ModelFile(entry.made, entry.views, entry.notes)
                self._models.setdefault((entry.path, False), found)
                if not _unmapped(entry.made):
                    self._models.setdefault((entry.path, True), found)
            elif entry.made:
                is_mapped = getattr(entry.made[0].shape, "uv", None) is not None
                self._meshes.setdefault((shape_of(entry.fields), is_mapped), entry.made)

    def path(self, file: str) -> str:
        return os.path.abspath(self._folder / file)

    def model(self, file: str, is_mapped: bool) -> ModelFile:
        """is_mapped: with texture coordinates, where the file has any; it is read again if that
        was not known before."""
        key = self.path(file), is_mapped
        if key not in self._models:
            found = self.model(file, False) if is_mapped else _model(self._folder / file)
            if is_mapped and _unmapped(found.objects):
                with repairs():  # they are told already
                    found = _model(self._folder / file, is_mapped)
            self._models[key] = found
        return self._models[key]

    def mesh(self, table: MeshTable, is_mapped: bool) -> tuple[SceneObject, ...]:
        """is_mapped: with texture coordinates."""
        key = shape_of(table), is_mapped
        if key not in self._meshes:
            mesh = mesh_of(table)
            self._meshes[key] = (SceneObject(mapped(mesh, table) if is_mapped else mesh),)
        return self._meshes[key]


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


def _unmapped(made: tuple[SceneObject, ...]) -> SceneObject | None:
    """The first part without texture coordinates."""
    meshes = (part for part in made if isinstance(part.shape, Mesh) and part.shape.uv is None)
    return next(meshes, None)


def _model(path: Path, is_mapped: bool = False) -> ModelFile:
    """A model's parts and views."""
    try:
        return read_model(path, is_mapped) if is_mapped else load_model(path)
    except LucidaError as error:
        where = ": ".join(part for part in (str(path), error.field) if part)
        raise LucidaError("file", f"{where}: {error.problem}", error.remedy) from None
