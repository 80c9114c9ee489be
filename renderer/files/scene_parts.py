"""The shapes, models and images of a scene file, before its objects are placed.

Each is made or read once, or taken from the scene before a change. Errors name the file's field.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from lucida.renderer.scene import shapes
from lucida.renderer.scene.limits import SEGMENTS, TEXTURES
from lucida.renderer.scene.metal import EVERYWHERE, Metal
from lucida.renderer.scene.model import Mesh, SceneObject
from lucida.renderer.scene.origin import FileEntry
from lucida.renderer.scene.shape_coordinates import on_box, on_cylinder, on_plane, on_torus
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.errors import LucidaError, under

from .models.models import ModelFile, load_model
from .schema import (
    BoxTable,
    ConeTable,
    CylinderTable,
    DiskTable,
    MeshTable,
    MetalTable,
    ModelTable,
    ObjectTable,
    RectangleTable,
    TextureTable,
    TorusTable,
)
from .texture_images import FoundImage, inner_path, read_image

# The function that makes each shape, the one that adds texture coordinates, and the number of
# triangles per segment (and side of a tube).
_SHAPES: dict[type[ObjectTable], tuple[Callable[..., Mesh], Callable[..., Mesh], int]] = {
    BoxTable: (shapes.box, on_box, 12),
    RectangleTable: (shapes.rectangle, on_plane, 2),
    DiskTable: (shapes.disk, on_plane, 1),
    CylinderTable: (shapes.cylinder, on_cylinder, 4),
    ConeTable: (shapes.cone, on_cylinder, 2),
    TorusTable: (shapes.torus, on_torus, 2),
}
Image = TypeVar("Image", bound=Texture | Metal)


class SceneParts:
    """The parts of one scene file in a folder.

    entries: of the scene before a change. Equal parts stay the same values, so that renderers
    detect only real changes.
    """

    def __init__(self, folder: Path, entries: tuple[FileEntry, ...]) -> None:
        self._folder = folder
        self._models: dict[str, ModelFile] = {}  # by path
        self._meshes: dict[Hashable, tuple[SceneObject, ...]] = {}
        self._images: dict[Hashable, Any] = {}
        self._pixels: dict[tuple[Path | None, bool], FoundImage] = {}
        for entry in entries:
            if isinstance(entry.fields, ModelTable):
                found = ModelFile(entry.made, notes=entry.notes)
                self._models.setdefault(entry.path, found)
            elif entry.made:
                is_mapped = unmapped(entry.made) is None
                self._meshes.setdefault(_key(entry.fields, is_mapped), entry.made)
            if (known := entry.material) is not None:
                for image in (known.texture, known.metal):
                    if image is not None:
                        self._kept(image)
                        pixels = FoundImage(image.texels, image.file)
                        self._pixels[image.file, image.texels.shape[2] == 4] = pixels

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

    def mesh(self, table: MeshTable, is_mapped: bool) -> tuple[SceneObject, ...]:
        """Return a shape. is_mapped: with texture coordinates."""
        key = _key(table, is_mapped)
        if key not in self._meshes:
            make, mapped, _ = _SHAPES[type(table)]
            mesh = make(**_own_fields(table))
            if is_mapped:
                mesh = mapped(mesh, table.radius) if isinstance(table, TorusTable) else mapped(mesh)
            self._meshes[key] = (SceneObject(mesh),)
        return self._meshes[key]

    def texture(self, given: str | TextureTable, has_opacity: bool = False) -> Texture:
        """Return a texture. Raises LucidaError with a field below a material."""
        table = TextureTable(file=given) if isinstance(given, str) else given
        wrap = (table.wrap,) * 2 if isinstance(table.wrap, str) else table.wrap
        scale = (table.scale,) * 2 if isinstance(table.scale, int | float) else table.scale
        with under("texture"):
            pixels, file = self._image(table.file, has_opacity)
            return self._kept(Texture(pixels, wrap, scale, table.offset, file, table.rotate_deg))

    def metal(self, given: str | MetalTable) -> Metal:
        """Return a metal. Raises LucidaError with a field below a material."""
        table = MetalTable(file=given) if isinstance(given, str) else given
        with under("metal"):
            pixels, file = self._image(table.file) if table.file else (EVERYWHERE, None)
            return self._kept(Metal(pixels, table.metalness, table.roughness, file))

    def _kept(self, image: Image) -> Image:
        """Return the known image that is equal, or else this one."""
        values = (id(v) if isinstance(v, np.ndarray) else v for v in vars(image).values())
        kept: Image = self._images.setdefault((type(image), *values), image)
        return kept

    def _image(self, name: str, has_opacity: bool = False) -> FoundImage:
        key = inner_path(name, self._folder).absolute(), has_opacity
        if key not in self._pixels:
            if len(self._pixels) >= TEXTURES:
                raise LucidaError("", f"the scene has more than {TEXTURES} images", "use fewer")
            self._pixels[key] = read_image(name, self._folder, has_opacity)
        return self._pixels[key]


def made_triangles(table: ObjectTable) -> int:
    """Return a shape's number of triangles; 0 for a sphere or a model.

    Invalid numbers of segments, which the shape rejects, are clamped to valid ones.
    """
    count = _SHAPES[type(table)][2] if type(table) in _SHAPES else 0
    for name in ("segments", "sides"):
        count *= min(max(getattr(table, name, 1), 0), SEGMENTS)
    return count


def unmapped(made: tuple[SceneObject, ...]) -> SceneObject | None:
    """Return the first part without texture coordinates; None if all have them."""
    meshes = (part for part in made if isinstance(part.shape, Mesh) and part.shape.uv is None)
    return next(meshes, None)


def _own_fields(table: MeshTable) -> dict[str, Any]:
    """Return the fields of the table's kind of shape, which are the parameters of its function."""
    common = MeshTable.__struct_fields__
    return {name: getattr(table, name) for name in table.__struct_fields__ if name not in common}


def _key(table: MeshTable, is_mapped: bool) -> Hashable:
    """Return a key that is equal for tables of the same shape."""
    return type(table), is_mapped, *_own_fields(table).values()
