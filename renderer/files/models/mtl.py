"""Wavefront .mtl files: the materials of an .obj file.

Source: Alias|Wavefront, MTL material format.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field, replace
from pathlib import Path

from lucida.renderer.files.models.numerals import is_number
from lucida.renderer.files.models.texts import tidy
from lucida.renderer.files.reading import read_file
from lucida.renderer.files.texture_images import ModelImages, read_image
from lucida.renderer.scene.limits import MATERIAL_BYTES
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.errors import LucidaError

_OPTION = re.compile(r"-[a-z]+", re.IGNORECASE)
_LONGEST = {"-s": 3, "-o": 3, "-t": 3, "-mm": 2}  # words after an option; all others have one
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
    given: dict[str, list[str]] = {}
    while len(words) > 2 and _OPTION.fullmatch(words[0]):
        option, end = words[0].lower(), 2
        while end < min(_LONGEST.get(option, 1) + 1, len(words) - 1) and is_number(words[end]):
            end += 1
        given[option], words = words[1:end], words[end:]
    name = " ".join(words).strip("\"'")
    clamp = given.get("-clamp", [""])[0].lower() == "on"
    return ImageMap(name, _pair(given, "-s", 1.0), _pair(given, "-o", 0.0), clamp) if name else None


def _pair(given: dict[str, list[str]], option: str, default: float) -> tuple[float, float]:
    values = [float(value) for value in given.get(option, ()) if is_number(value)]
    u, v = [*values, default, default][:2]
    return u, v
