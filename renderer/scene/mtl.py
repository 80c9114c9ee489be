"""Wavefront .mtl files: the materials of an .obj file. mtl_maps.py reads their images."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from renderer.scene.images import ModelImages
from renderer.scene.limits import MATERIAL_BYTES
from renderer.scene.model import Material
from renderer.scene.mtl_maps import ImageMap, image_map, mapped_material
from renderer.scene.reading import read_file
from renderer.scene.texts import tidy


@dataclass(frozen=True)
class Library:
    """plain: materials by name: Kd, Ks and Ns as they stand, clamped to what a Material may have;
    None for one that has none of these. maps: the images of those that have one. folder: the
    file's."""

    plain: dict[str, Material | None]
    maps: dict[str, ImageMap]
    folder: Path

    def material(self, name: str, images: ModelImages) -> Material | None:
        """Return a material with its texture, whose image is read now; None if there is no such
        material.
        """
        plain, given = self.plain.get(name), self.maps.get(name)
        return plain if given is None else mapped_material(plain, given, self.folder, images)


def read_mtl(path: Path) -> Library:
    """Return a file's materials. Raises LucidaError if it cannot be read."""
    text = tidy(read_file(path, MATERIAL_BYTES)).decode("utf-8", "replace")
    found: dict[str, dict[str, list[float]]] = {}
    fields: dict[str, list[float]] = {}
    maps: dict[str, ImageMap] = {}
    name = ""
    for line in text.splitlines():
        keyword, *words = line.split() or [""]
        if keyword.lower() == "newmtl":
            name = " ".join(words)
            if words:
                fields = found[name] = {}
                maps.pop(name, None)
            continue
        words = words[: next((k for k, word in enumerate(words) if word[0] == "#"), None)]
        if keyword.lower() == "map_kd" and (given := image_map(words)) is not None:
            maps[name] = given
        elif keyword.lower() in ("kd", "ks", "ns") and words:
            try:
                fields[keyword.lower()] = [float(word) for word in words]
            except ValueError:
                continue  # a spectrum in a file of its own
    plain = {name: _material(fields) for name, fields in found.items()}
    return Library(plain, maps, path.parent)


def _material(fields: dict[str, list[float]]) -> Material | None:
    if not fields:
        return None
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
