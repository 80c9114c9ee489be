"""Wavefront .obj files through trimesh's reader.

Owns what trimesh does not take as the format means it: relative indices, index 0, dialects, and
which line is at fault. Knows nothing of meshes' repair.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.guard import geometries, guarded, read_text, to_part
from renderer.scene.images import ModelImages
from renderer.scene.limits import MATERIAL_BYTES, OBJECTS
from renderer.scene.model import Material
from renderer.scene.mtl_maps import ImageMap, mapped_material, read_maps
from renderer.scene.parts import Part
from renderer.scene.reading import read_file

SPLIT_WORK = 1 << 31  # parts times vertices up to which a file is split into parts
_END_LETTERS = 4096  # a last line that is longer is not looked at

# What a face line must not hold for trimesh: indices counted from the end, or 0.
_RELATIVE = re.compile(r"^f[^\n]*[ \t/](?:-\d|0+(?![0-9.]))", re.MULTILINE)
_DIVISION = re.compile(r"^(?:o|g|usemtl|mtllib)\b[^\n]*\n", re.MULTILINE)


def read_obj(path: Path, images: ModelImages) -> list[Part]:
    """The parts of an .obj file: one for each object and material, in the file's order. images:
    for the textures of its materials."""
    original = text = read_text(path)
    if "\nf " not in text:
        return []
    _check_end(path, text)
    vertices = text.count("\nv ")
    divisions = text.count("\no ") + text.count("\nusemtl ") + 1
    if divisions > OBJECTS or divisions * vertices > SPLIT_WORK:
        text = _DIVISION.sub("", text)
    faces = text[text.find("\nf ") :]
    if any(sign in faces for sign in ("-", " 0", "/0")) and _RELATIVE.search(faces):
        text = _absolute_indices(text)
    beside = _BesideIt(path.parent)
    try:
        with guarded(path, "OBJ"):
            from trimesh.exchange.obj import load_obj

            found = load_obj(io.StringIO(text), beside, split_objects=True, group_material=True)
    except LucidaError:
        _blame_line(path, original)
        raise
    parts = []
    for name, fields in reversed(geometries(found, path.stem)):
        visual = fields.get("visual")
        part = to_part(name, fields, _obj_material(visual))
        image_map = beside.maps.get(_material_name(visual))
        if image_map is not None:
            material = mapped_material(part.material, image_map, beside.library, images)
            part = replace(part, material=material, uv=getattr(visual, "uv", None))
        parts.append(part)
    return parts


class _BesideIt(Mapping[str, bytes]):
    """What an .obj may read: its .mtl file, in its own folder. Images are read elsewhere."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.library = folder  # of the .mtl file, once it is read
        self.maps: dict[str, ImageMap] = {}

    def __getitem__(self, name: str) -> bytes:
        path = (self.folder / name).resolve()
        if not path.is_relative_to(self.folder):
            raise KeyError(name)
        data = read_file(path, MATERIAL_BYTES)
        self.library, self.maps = path.parent, read_maps(data.decode("utf-8-sig", "replace"))
        return data

    def get(self, name: str, default: Any = None) -> Any:
        raise KeyError(name)  # trimesh asks for images in this way

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def _check_end(path: Path, text: str) -> None:
    """Raises LucidaError for a file that ends within a face, which trimesh would pass over."""
    line = text[-_END_LETTERS:].rstrip().rpartition("\n")[2]
    keyword, *corners = line.split() or [""]
    slashes = {corner.count("/") for corner in corners}
    if keyword == "f" and (len(corners) < 3 or len(slashes) > 1):
        raise LucidaError(
            f"line {text.rstrip().count(chr(10))}",
            f"{line[:60]!r}, the last one, is not a whole face",
            "the file is cut off; export it again",
            str(path),
        )


def _blame_line(path: Path, text: str) -> None:
    """Raises LucidaError for the first line that trimesh may have stumbled over, if there is one.

    text: as tidy_text() gives it, with an empty line before the first.
    """
    vertices = text.count("\nv ")
    above = 0
    for number, line in enumerate(text.split("\n")):
        keyword, _, rest = line.partition(" ")
        where = f"line {number}"
        if keyword == "v":
            above += 1
            try:
                if len([float(word) for word in rest.split()[:3]]) < 3:
                    raise ValueError
            except ValueError:
                raise LucidaError(
                    where, f"{line[:60]!r} is not a vertex", "repair the line", str(path)
                ) from None
        elif keyword == "f":
            for corner in rest.split():
                index = corner.split("/")[0]
                if not re.fullmatch(r"[-+]?\d{1,18}", index):
                    raise LucidaError(
                        where, f"{line[:60]!r} is not a face", "repair the line", str(path)
                    )
                if int(index) == 0 or not -above <= int(index) <= vertices:
                    raise LucidaError(
                        where,
                        f"{line[:60]!r} uses vertex {int(index)} of {vertices}",
                        "repair the line",
                        str(path),
                    )


def _absolute_indices(text: str) -> str:
    """Face lines with indices counted from the end replaced by ones from the beginning.

    They count from the vertices above their line. Index 0, or one before the first vertex, does
    not exist: it becomes one that cannot either.
    """
    counts = {"v": 0, "vt": 0, "vn": 0}
    kinds = ("v", "vt", "vn")
    lines = text.split("\n")
    for number, line in enumerate(lines):
        keyword, _, rest = line.partition(" ")
        if keyword in counts:
            counts[keyword] += 1
        elif keyword == "f":
            corners = []
            for corner in rest.split():
                indices = corner.split("/")
                for k, index in enumerate(indices[:3]):
                    if re.fullmatch(r"-\d{1,18}|0+", index):
                        back = int(index[:19])
                        absolute = counts[kinds[k]] + 1 + back
                        indices[k] = str(absolute if back and absolute > 0 else 1 << 40)
                corners.append("/".join(indices))
            lines[number] = "f " + " ".join(corners)
    return "\n".join(lines)


def _material_name(visual: Any) -> str:
    return str(getattr(getattr(visual, "material", None), "name", ""))


def _obj_material(visual: Any) -> Material | None:
    """Kd, Ks and Ns of an .mtl file as they stand, clamped to what a Material may have."""
    fields = getattr(getattr(visual, "material", None), "kwargs", None) or {}
    if not any(key in fields for key in ("kd", "ks", "ns")):
        return None

    def rgb(key: str, default: float) -> tuple[float, float, float]:
        try:
            red, green, blue = np.clip(np.asarray(fields.get(key, [default] * 3), float), 0, 1)
        except (TypeError, ValueError):
            return (default,) * 3
        usable = np.isfinite([red, green, blue]).all()
        return (float(red), float(green), float(blue)) if usable else (default,) * 3

    shininess = fields.get("ns", 50.0)
    shininess = shininess if isinstance(shininess, float) and shininess == shininess else 50.0
    return Material(rgb("kd", 0.7), rgb("ks", 0.0), min(max(shininess, 1.0), 1000.0))
