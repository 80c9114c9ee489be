"""The textures of a scene file's materials: the tables of schema.py into textures.

A fault in one is a mistake in the file, which names its field. Knows nothing of objects.
"""

from __future__ import annotations

import os
from collections.abc import Hashable, Iterable, Sequence
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.images import FoundImage, read_image
from renderer.scene.limits import TEXTURES
from renderer.scene.reading import suggestion
from renderer.scene.schema import TextureTable
from renderer.scene.texture import WRAPS, Texture


class SceneImages:
    """The images of one scene file, in its folder or below it, each read once. known: textures of
    the scene as it was before it was changed, which are taken where they are wanted again."""

    def __init__(self, folder: Path, known: Iterable[Texture] = ()) -> None:
        self._folder = folder
        self._read: dict[str, FoundImage] = {}
        self._known = {_key(t.file, t.wrap, t.scale, t.offset): t for t in known}

    def texture(self, given: str | TextureTable) -> Texture:
        """Raises LucidaError, whose field is below a material."""
        table = TextureTable(file=given) if isinstance(given, str) else given
        wrap = (table.wrap,) * 2 if isinstance(table.wrap, str) else table.wrap
        for way in wrap:
            if way not in WRAPS:
                raise LucidaError(
                    "texture.wrap", f"{way[:40]!r} is unknown", suggestion(way, WRAPS)
                )
        scale = (table.scale,) * 2 if isinstance(table.scale, int | float) else table.scale
        name = table.file.replace("\\", "/")
        key = _key((self._folder / name).absolute(), wrap, scale, table.offset)
        if key in self._known and not os.path.isabs(name):  # such are in no scene file
            return self._known[key]
        if table.file not in self._read:
            if len(self._read) >= TEXTURES:
                problem = f"the scene has more than {TEXTURES} images"
                raise LucidaError("texture", problem, "use fewer")
            try:
                self._read[table.file] = read_image(table.file, self._folder)
            except LucidaError as error:
                raise LucidaError("texture", error.problem, error.remedy) from None
        found = self._read[table.file]
        try:
            texture = Texture(found.pixels, wrap, scale, table.offset, found.file)
        except LucidaError as error:
            raise error.within("texture") from None
        self._known[key] = texture
        return texture


def _key(
    file: Path | None, wrap: Sequence[str], scale: Sequence[float], offset: Sequence[float]
) -> Hashable:
    return file, tuple(wrap), tuple(map(float, scale)), tuple(map(float, offset))
