"""Wavefront .mtl files: the materials of an .obj file.

Source: Alias|Wavefront, MTL material format.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.images import ModelImages, read_image
from renderer.scene.limits import MATERIAL_BYTES
from renderer.scene.model import Material
from renderer.scene.numerals import is_number
from renderer.scene.reading import read_file
from renderer.scene.texts import tidy
from renderer.scene.texture import Texture

# Options and the most words that follow them; of -s, -o and -t all but the first may be left out.
_OPTIONS = {
    "-s": 3, "-o": 3, "-t": 3, "-mm": 2, "-clamp": 1, "-blendu": 1, "-blendv": 1, "-cc": 1,
    "-bm": 1, "-boost": 1, "-texres": 1, "-imfchan": 1, "-type": 1, "-colorspace": 1,
}  # fmt: skip


# What changes nothing, or little, in a picture; and values that change nothing.
_HARMLESS = ("", "ka", "ni", "illum", "tf", "sharpness", "map_ka")
_DEFAULTS = {"d": 1.0, "tr": 0.0, "ke": 0.0}


@dataclass(frozen=True)
class ImageMap:
    """map_Kd of a material. name: of the image. is_clamped: -clamp on."""

    name: str
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)
    is_clamped: bool = False


@dataclass
class MtlMaterial:
    """fields: Kd, Ks and Ns as they stand. folder: the file's. ignored: keywords not shown."""

    folder: Path
    fields: dict[str, list[float]] = field(default_factory=dict)
    image: ImageMap | None = None
    ignored: list[str] = field(default_factory=list)

    def material(self, images: ModelImages) -> Material | None:
        """Return the material, clamped to what one may have, with its texture, whose image is read
        now; None if none of its fields is known.

        Kd multiplies the image. If there is none, or it is black, as many programs write it with an
        image, the image is shown unchanged.
        """
        if self.ignored:
            images.note(f"not shown: {', '.join(self.ignored)}", "materials")
        material = _plain(self.fields) if self.fields else None
        if (given := self.image) is None:
            return material
        found = images.get(given.name, lambda: read_image(given.name, self.folder))
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


def read_mtl(path: Path) -> dict[str, MtlMaterial]:
    """Return a file's materials by name. Raises LucidaError if it cannot be read."""
    text = tidy(read_file(path, MATERIAL_BYTES)).decode("utf-8", "replace")
    found: dict[str, MtlMaterial] = {}
    material = MtlMaterial(path.parent)  # of what is above the first name
    for line in text.splitlines():
        keyword, *words = line.split() or [""]
        keyword = keyword.lower()
        if keyword == "newmtl":
            material = found[" ".join(words)] = MtlMaterial(path.parent)
            continue
        words = words[: next((k for k, word in enumerate(words) if word[0] == "#"), None)]
        if keyword == "map_kd":
            material.image = _image_map(words) or material.image
        elif keyword in ("kd", "ks", "ns") and words and all(map(is_number, words)):
            material.fields[keyword] = [float(word) for word in words]  # not a spectrum's file
        elif keyword not in _HARMLESS and keyword[0] != "#":
            default = _DEFAULTS.get(keyword)
            if any(not is_number(word) or float(word) != default for word in words):
                material.ignored.append(keyword[:20])
    return found


def _plain(fields: dict[str, list[float]]) -> Material:
    shininess = fields.get("ns", [])
    usable = len(shininess) == 1 and not math.isnan(shininess[0])
    return Material(
        _rgb(fields.get("kd", []), 0.7),
        _rgb(fields.get("ks", []), 0.0),
        min(max(shininess[0], 1.0), 1000.0) if usable else 50.0,
    )


def _rgb(values: list[float], default: float) -> tuple[float, float, float]:
    if len(values) == 1:  # a gray
        values = values * 3
    if len(values) != 3 or any(map(math.isnan, values)):
        return (default,) * 3
    red, green, blue = (min(max(value, 0.0), 1.0) for value in values)
    return red, green, blue


def _image_map(words: list[str]) -> ImageMap | None:
    """Return the options and the name after map_Kd, which may hold spaces; None for one without a
    name.
    """
    found = ImageMap("")
    while words and words[0].lower() in _OPTIONS and len(words) > 1:
        option, *words = words
        option = option.lower()
        values: list[str] = []
        while words[1:] and len(values) < _OPTIONS[option]:
            if values and option in ("-s", "-o", "-t") and not is_number(words[0]):
                break
            values.append(words.pop(0))
        if option in ("-s", "-o") and all(map(is_number, values)):
            default = "1" if option == "-s" else "0"
            u, v = (float(value) for value in (*values, default, default)[:2])
            scaled = option == "-s"
            found = replace(found, scale=(u, v)) if scaled else replace(found, offset=(u, v))
        elif option == "-clamp" and values:
            found = replace(found, is_clamped=values[0].lower() == "on")
    name = " ".join(words).strip("\"'")
    return replace(found, name=name) if name else None
