"""The images of a scene file's materials: the tables of schema.py as textures and metals.

A fault in an image is an error of the file, which names the field.
"""

from __future__ import annotations

import os
from collections.abc import Hashable, Iterable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from lucida.renderer.files.reading import suggestion
from lucida.renderer.files.schema import MetalTable, TextureTable
from lucida.renderer.files.texture_images import Bytes, read_image
from lucida.renderer.scene.limits import TEXTURES
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import EVERYWHERE, Metal
from lucida.renderer.scene.texture import WRAPS, Texture
from lucida.renderer.system.errors import LucidaError, under

Made = TypeVar("Made", bound=Texture | Metal)


class SceneImages:
    """The images of one scene file, in its folder or below it, each read once.

    known: the materials of the scene before a change. Their images are not read again, and equal
    textures and metals stay the same objects.
    """

    def __init__(self, folder: Path, known: Iterable[Material] = ()) -> None:
        self._folder, self._read_count = folder, 0
        self._made: dict[Hashable, Any] = {}
        self._pixels: dict[tuple[Path | None, bool], Bytes] = {}
        for material in known:
            for image in (material.texture, material.metal):
                if image is not None:
                    self._kept(image)
                    self._pixels[image.file, image.texels.shape[2] == 4] = image.texels

    def texture(self, given: str | TextureTable, has_opacity: bool = False) -> Texture:
        """Return a texture. Raises LucidaError, whose field is below a material."""
        table = TextureTable(file=given) if isinstance(given, str) else given
        wrap = (table.wrap,) * 2 if isinstance(table.wrap, str) else table.wrap
        for way in wrap:
            if way not in WRAPS:
                problem = f"{way[:40]!r} is unknown"
                raise LucidaError("texture.wrap", problem, suggestion(way, WRAPS))
        scale = (table.scale,) * 2 if isinstance(table.scale, int | float) else table.scale
        with under("texture"):
            pixels, file = self._image(table.file, has_opacity)
            return self._kept(Texture(pixels, wrap, scale, table.offset, file, table.rotate_deg))

    def metal(self, given: str | MetalTable) -> Metal:
        """Return a metal. Raises LucidaError, whose field is below a material."""
        table = MetalTable(file=given) if isinstance(given, str) else given
        with under("metal"):
            pixels, file = self._image(table.file) if table.file else (EVERYWHERE, None)
            return self._kept(Metal(pixels, table.metalness, table.roughness, file))

    def _kept(self, image: Made) -> Made:
        """Return the equal image that is known, or else this one."""
        values = (id(v) if isinstance(v, np.ndarray) else v for v in vars(image).values())
        kept: Made = self._made.setdefault((type(image), *values), image)
        return kept

    def _image(self, name: str, has_opacity: bool = False) -> tuple[Bytes, Path]:
        file = (self._folder / name.replace("\\", "/")).absolute()
        key = file, has_opacity
        if key not in self._pixels or os.path.isabs(name):  # an absolute name is refused
            if self._read_count >= TEXTURES:
                raise LucidaError("", f"the scene has more than {TEXTURES} images", "use fewer")
            self._pixels[key] = read_image(name, self._folder, has_opacity).pixels
            self._read_count += 1
        return self._pixels[key], file
