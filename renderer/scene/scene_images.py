"""The images of a scene file's materials: the tables of schema.py into textures and metals.

A fault in one is a mistake in the file, which names its field. Knows nothing of objects.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Iterable
from pathlib import Path
from typing import Any, TypeVar, cast

import msgspec

from renderer.errors import LucidaError
from renderer.scene.images import FoundImage, read_image
from renderer.scene.limits import TEXTURES
from renderer.scene.metal import EVERYWHERE, Metal
from renderer.scene.model import Material
from renderer.scene.reading import suggestion
from renderer.scene.schema import MetalTable, TextureTable
from renderer.scene.texture import WRAPS, Texture

Made = TypeVar("Made", Texture, Metal)


class SceneImages:
    """The images of one scene file, in its folder or below it, each read once. known: materials of
    the scene as it was before it was changed, whose images are taken where they are wanted again.
    """

    def __init__(self, folder: Path, known: Iterable[Material] = ()) -> None:
        self._folder = folder
        self._read: dict[tuple[str, bool], FoundImage] = {}
        self._known: dict[Hashable, Texture | Metal] = {}
        for material in known:
            if (texture := material.texture) is not None:
                self._known[_texture_key(texture, texture.file, texture.texels.shape[2] == 4)] = (
                    texture
                )
            metal = material.metal
            if metal is not None and (metal.file is not None or metal.is_everywhere):
                self._known[_metal_key(metal, metal.file)] = metal

    def texture(self, given: str | TextureTable, has_opacity: bool = False) -> Texture:
        """Return a texture, with its opacity if that is wanted. Raises LucidaError, whose field is
        below a material."""
        table = TextureTable(file=given) if isinstance(given, str) else given
        wrap = (table.wrap,) * 2 if isinstance(table.wrap, str) else table.wrap
        for way in wrap:
            if way not in WRAPS:
                raise LucidaError(
                    "texture.wrap", f"{way[:40]!r} is unknown", suggestion(way, WRAPS)
                )
        scale = (table.scale,) * 2 if isinstance(table.scale, int | float) else table.scale

        def made(found: FoundImage) -> Texture:
            place = wrap, scale, table.offset
            return Texture(found.pixels, *place, found.file, table.rotate_deg)

        wanted = msgspec.structs.replace(table, wrap=wrap, scale=scale)
        file = self._path(table.file)
        key = _texture_key(wanted, file, has_opacity)
        return self._image("texture", table.file, key, has_opacity, made)

    def metal(self, given: str | MetalTable) -> Metal:
        """Return a metal. Raises LucidaError, whose field is below a material."""
        table = MetalTable(file=given) if isinstance(given, str) else given

        def made(found: FoundImage) -> Metal:
            return Metal(found.pixels, table.metalness, table.roughness, found.file)

        if table.file:
            key = _metal_key(table, self._path(table.file))
            return self._image("metal", table.file, key, False, made)
        key = _metal_key(table, None)
        if key not in self._known:
            self._known[key] = self._made("metal", FoundImage(EVERYWHERE), made)
        return cast(Metal, self._known[key])

    def _path(self, name: str) -> Path:
        return (self._folder / name.replace("\\", "/")).absolute()

    def _image(
        self,
        field: str,
        name: str,
        key: Hashable,
        has_opacity: bool,
        made: Callable[[FoundImage], Made],
    ) -> Made:
        """Return what an image makes; what is known by the key already, where there is that."""
        if key in self._known and not os.path.isabs(name):  # such are in no scene file
            return cast(Made, self._known[key])
        if (name, has_opacity) not in self._read:
            if len(self._read) >= TEXTURES:
                problem = f"the scene has more than {TEXTURES} images"
                raise LucidaError(field, problem, "use fewer")
            try:
                self._read[name, has_opacity] = read_image(name, self._folder, has_opacity)
            except LucidaError as error:
                raise LucidaError(field, error.problem, error.remedy) from None
        image = self._made(field, self._read[name, has_opacity], made)
        self._known[key] = image
        return image

    def _made(self, field: str, found: FoundImage, made: Callable[[FoundImage], Made]) -> Made:
        try:
            return made(found)
        except LucidaError as error:
            raise error.within(field) from None


def _texture_key(image: Any, file: Path | None, has_opacity: bool) -> Hashable:
    """Return all that a Texture, or a TextureTable, depends on."""
    numbers = map(float, (*image.scale, *image.offset, image.rotate_deg))
    return file, has_opacity, tuple(image.wrap), *numbers


def _metal_key(image: Metal | MetalTable, file: Path | None) -> Hashable:
    return file, float(image.metalness), float(image.roughness)
