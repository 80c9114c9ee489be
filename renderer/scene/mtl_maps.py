"""The images of .mtl files: map_Kd with its options, as a texture of a material.

Source: Alias|Wavefront, MTL material format.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.images import ModelImages, read_image
from renderer.scene.model import Material
from renderer.scene.texture import Texture

# Options and the most words that follow them; of -s, -o and -t all but the first may be left out.
_OPTIONS = {
    "-s": 3, "-o": 3, "-t": 3, "-mm": 2, "-clamp": 1, "-blendu": 1, "-blendv": 1, "-cc": 1,
    "-bm": 1, "-boost": 1, "-texres": 1, "-imfchan": 1, "-type": 1, "-colorspace": 1,
}  # fmt: skip


@dataclass(frozen=True)
class ImageMap:
    """map_Kd of a material. name: of the image. is_clamped: -clamp on."""

    name: str
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)
    is_clamped: bool = False


def mapped_material(
    material: Material | None, given: ImageMap, folder: Path, images: ModelImages
) -> Material | None:
    """Return the material with its texture; without, if that cannot be read. folder: the .mtl
    file's.

    Kd multiplies the image. If there is none, or it is black, as many programs write it with an
    image, the image is shown unchanged.
    """
    found = images.get(given.name, lambda: read_image(given.name, folder))
    if found is None:
        return material
    wrap = "clamp" if given.is_clamped else "repeat"
    try:
        texture = Texture(found.pixels, (wrap, wrap), given.scale, given.offset, found.file)
    except LucidaError as error:
        images.note(f"{given.name!r}: {error}; the plain colour is shown")
        return material
    if material is None or not any(material.diffuse):
        material = replace(material or Material(), diffuse=(1.0, 1.0, 1.0))
    return replace(material, texture=texture)


def image_map(words: list[str]) -> ImageMap | None:
    """Return the options and the name after map_Kd, which may hold spaces; None for one without a
    name.
    """
    found = ImageMap("")
    while words and words[0].lower() in _OPTIONS and len(words) > 1:
        option, *words = words
        option = option.lower()
        values: list[str] = []
        while words[1:] and len(values) < _OPTIONS[option]:
            if values and option in ("-s", "-o", "-t") and not _is_number(words[0]):
                break
            values.append(words.pop(0))
        if option in ("-s", "-o") and all(map(_is_number, values)):
            default = "1" if option == "-s" else "0"
            u, v = (float(value) for value in (*values, default, default)[:2])
            scaled = option == "-s"
            found = replace(found, scale=(u, v)) if scaled else replace(found, offset=(u, v))
        elif option == "-clamp" and values:
            found = replace(found, is_clamped=values[0].lower() == "on")
    name = " ".join(words).strip("\"'")
    return replace(found, name=name) if name else None


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
