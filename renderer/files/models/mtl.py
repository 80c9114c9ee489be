"""Wavefront .mtl files: the materials of an .obj file.

Source: Alias|Wavefront, MTL material format.
"""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lucida.renderer.files.reading import read_file
from lucida.renderer.files.texture_images import ModelImages, read_image
from lucida.renderer.scene.limits import MATERIAL_BYTES
from lucida.renderer.scene.material import Material, vector
from lucida.renderer.scene.texture import Texture

from .texts import is_number, tidy

_COMMENT = re.compile(r"(?:^|\s)#.*")
_DEFAULTS = {"kd": [0.7], "ks": [0.0], "ns": [50.0]}
# Keywords that change little in a picture, and values that change nothing.
_HARMLESS = ("ka", "ni", "illum", "tf", "sharpness", "map_ka")
_NO_CHANGE = {"d": 1.0, "tr": 0.0, "ke": 0.0}


@dataclass
class MtlMaterial:
    """A material. fields: Kd, Ks and Ns, unchanged. image: the name after map_Kd. folder: the
    file's.
    ignored: keywords that are not shown.
    """

    folder: Path
    fields: dict[str, list[float]] = field(default_factory=dict)
    image: str = ""
    ignored: list[str] = field(default_factory=list)

    def material(self, images: ModelImages) -> Material | None:
        """Return the material, clamped to its bounds, after reading its texture's image; None if
        none of its fields is known.

        Kd multiplies the image. The image is unchanged if Kd is missing, or black, which many
        programs write next to an image.
        """
        if self.ignored:
            images.note(f"not shown: {', '.join(self.ignored)}", "materials")
        material = self._plain() if self.fields else None
        name = self.image
        found = images.get(name, lambda: read_image(name, self.folder)) if name else None
        if found is None:
            return material
        if material is None or not any(material.diffuse):
            material = replace(material or Material(), diffuse=(1.0, 1.0, 1.0))
        return replace(material, texture=Texture(found.pixels, file=found.file))

    def _plain(self) -> Material:
        given = {**_DEFAULTS, **self.fields}
        colors = (np.resize(given[name], 3) for name in ("kd", "ks"))  # one number means gray
        diffuse, specular = (vector("color", np.nan_to_num(rgb).clip(0, 1)) for rgb in colors)
        return Material(diffuse, specular, float(np.nan_to_num(given["ns"][0]).clip(1, 1000)))


def read_mtl(path: Path) -> dict[str, MtlMaterial]:
    """Return a file's materials by name. Raises LucidaError if it cannot be read."""
    text = tidy(read_file(path, MATERIAL_BYTES)).decode("utf-8", "replace")
    found: dict[str, MtlMaterial] = {}
    material = MtlMaterial(path.parent)  # for lines above the first name
    for line in text.splitlines():
        keyword, *words = _COMMENT.sub("", line).split() or ["illum"]
        keyword = keyword.lower()
        if keyword == "newmtl":
            material = found[" ".join(words)] = MtlMaterial(path.parent)
        elif keyword == "map_kd":
            material.image = _image_name(words) or material.image
            if words[:1] != material.image.split()[:1]:
                material.ignored.append("options of map_kd")
        elif keyword in _DEFAULTS and words and all(map(is_number, words)):
            material.fields[keyword] = [float(word) for word in words]  # not a spectrum's file
        elif keyword not in _HARMLESS:
            unchanged = _NO_CHANGE.get(keyword)
            if any(not is_number(word) or float(word) != unchanged for word in words):
                material.ignored.append(keyword[:20])
    return found


def _image_name(words: list[str]) -> str:
    """Return the name after map_Kd and its options. It may hold spaces."""
    while words and words[0].startswith("-"):
        words = list(itertools.dropwhile(_is_value, words[1:]))
    return " ".join(words).strip("\"'")


def _is_value(word: str) -> bool:
    return is_number(word) or word in ("on", "off")
