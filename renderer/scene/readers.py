"""OBJ, PLY, STL and OFF files through trimesh's readers.

Owns what is checked and mended before and after trimesh: each count that a file declares is held
against its size, so that no lie sets memory aside. Knows nothing of glTF or of meshes' repair.
"""

from __future__ import annotations

import io
import itertools
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.guard import guarded
from renderer.scene.limits import (
    BINARY_MODEL_BYTES,
    MATERIAL_BYTES,
    OBJECTS,
    TEXT_MODEL_BYTES,
    TRIANGLES,
)
from renderer.scene.model import Material
from renderer.scene.parts import Part, linear_colors
from renderer.scene.reading import check_bytes, read_file, size_text

SPLIT_WORK = 1 << 31  # parts times vertices of an .obj file up to which it is split into parts

# What a face line of an .obj must not hold for trimesh: indices counted from the end, or 0.
_RELATIVE = re.compile(r"^f[^\n]*[ \t/](?:-\d|0+(?![0-9.]))", re.MULTILINE)
_COMMENT = re.compile(r"^((?:f|v[nt]?)[ \t][^#\n]*)#[^\n]*", re.MULTILINE)
_INDENT = re.compile(r"^[ \t]+", re.MULTILINE)
_TAB = re.compile(r"^(f|v[nt]?|o|g|usemtl|mtllib)[ \t]*\t[ \t]*", re.MULTILINE)
_SOLID = re.compile(r"^solid\b([^\n]*)", re.MULTILINE | re.IGNORECASE)
_DIVISION = re.compile(r"^(?:o|g|usemtl|mtllib)\b[^\n]*\n", re.MULTILINE)


def read_obj(path: Path) -> list[Part]:
    """The parts of a Wavefront .obj: one for each object and material, in the file's order."""
    original = text = _text(read_file(path, TEXT_MODEL_BYTES))
    if "\nf " not in text:
        return []
    vertices = text.count("\nv ")
    divisions = text.count("\no ") + text.count("\nusemtl ") + 1
    if divisions > OBJECTS or divisions * vertices > SPLIT_WORK:
        text = _DIVISION.sub("", text)
    faces = text[text.find("\nf ") :]
    if any(sign in faces for sign in ("-", " 0", "/0")) and _RELATIVE.search(faces):
        text = _absolute_indices(text)
    try:
        with guarded(path, "OBJ"):
            from trimesh.exchange.obj import load_obj

            found = load_obj(
                io.StringIO(text), _BesideIt(path.parent), split_objects=True, group_material=True
            )
    except LucidaError:
        _blame_line(path, original)
        raise
    parts = []
    for name, fields in reversed(_geometries(found, path.stem)):
        material = _obj_material(fields.get("visual"))
        parts.append(_part(name, fields, material))
    return parts


def read_ply(path: Path) -> list[Part]:
    """The mesh of a .ply file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    end = re.search(rb"end_header[ \t\r]*\n", data[: 1 << 16])
    if not data.startswith(b"ply") or not end:
        raise _damaged(path, "has no PLY header")
    header, body = data[: end.end()].decode("utf-8", "replace"), data[end.end() :]
    if "ascii" in header.split("\n", 2)[1]:
        check_bytes(len(data), TEXT_MODEL_BYTES, str(path))
        lines = _lines(body.decode("utf-8", "replace"))
        body = "\n".join(lines).encode()
        _check_rows(path, _ply_rows(header, least_bytes=False), len(lines), "lines")
    else:
        _check_rows(path, _ply_rows(header, least_bytes=True), len(body), "bytes")
    with guarded(path, "PLY"):
        from trimesh.exchange.ply import load_ply

        # Edges and textures are passed over: under this name trimesh does not look for edges.
        header = re.sub(r"(?m)^element edge\b", "element edges", header)
        found = load_ply(io.BytesIO(header.encode() + body), skip_materials=True)
    return [_part(path.stem, fields) for _, fields in _geometries(found, path.stem)]


def read_stl(path: Path) -> list[Part]:
    """The solids of an .stl file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    triangles = int.from_bytes(data[80:84], "little")
    names: list[str] = []
    if len(data) != 84 + 50 * triangles or len(data) < 84:
        if not data.lstrip()[:5].lower() == b"solid":
            raise _damaged(
                path,
                f"declares {triangles} triangles, {size_text(84 + 50 * triangles)}, and has "
                f"{size_text(len(data))}"
                if len(data) >= 84
                else "is too short to be STL",
            )
        check_bytes(len(data), TEXT_MODEL_BYTES, str(path))
        text = _text(data)
        solids = text.lower().count("endsolid")
        if not solids:
            raise _damaged(path, "has no 'endsolid'")
        _check_limit(path, solids, OBJECTS, "solids")
        # trimesh takes quadratic time over equal names.
        names = [match[1].strip() for match in _SOLID.finditer(text)]
        numbers = itertools.count()
        data = _SOLID.sub(lambda _: f"solid {next(numbers)}", text).encode()
    else:
        _check_limit(path, triangles, TRIANGLES, "triangles")
    with guarded(path, "STL"):
        from trimesh.exchange.stl import load_stl

        found = load_stl(io.BytesIO(data))
    parts = []
    for number, fields in _geometries(found, ""):
        name = names[int(number)] if number.isdigit() and int(number) < len(names) else ""
        parts.append(_part(name or path.stem, fields))
    return parts


def read_off(path: Path) -> list[Part]:
    """The mesh of an .off file (text; vertex colours are not read)."""
    text = re.sub(r"#[^\n]*", "", _text(read_file(path, TEXT_MODEL_BYTES)))
    lines = _lines(text)
    words = " ".join(lines[:3]).split(None, 3)
    if not words or not re.fullmatch(r"[A-Z0-9]*OFF", words[0]):
        raise _damaged(path, "does not begin with OFF")
    if words[0] not in ("OFF", "COFF", "NOFF", "CNOFF", "STOFF") or words[1:2] == ["BINARY"]:
        raise LucidaError("", f"is of the kind {words[0]}", "export a plain OFF", str(path))
    counts = [_whole(path, word) for word in words[1:3]]
    first = 2 if lines[0] == words[0] else 1  # the counts may stand beside the keyword
    _check_rows(path, counts, len(lines) - first, "lines")
    with guarded(path, "OFF"):
        from trimesh.exchange.off import load_off

        found = load_off(io.StringIO("\n".join(lines)))
    return [_part(path.stem, fields) for _, fields in _geometries(found, path.stem)]


class _BesideIt(Mapping[str, bytes]):
    """What an .obj may read: its .mtl file, in its own folder. Images are not read."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()

    def __getitem__(self, name: str) -> bytes:
        path = (self.folder / name).resolve()
        if not path.is_relative_to(self.folder):
            raise KeyError(name)
        return read_file(path, MATERIAL_BYTES)

    def get(self, name: str, default: Any = None) -> Any:
        raise KeyError(name)  # trimesh asks for images in this way

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def _text(data: bytes) -> str:
    """Text with newlines only, tidy enough for trimesh; what is not UTF-8 is replaced."""
    text = data.decode("utf-8-sig", "replace").replace("\r\n", "\n").replace("\r", "\n")
    text = f"\n{text}\n"
    if "\t" in text or "\n " in text:
        text = _TAB.sub(r"\1 ", _INDENT.sub("", text))
    if text.count("#") > text.count("\n#"):
        text = _COMMENT.sub(r"\1", text)
    return text


def _lines(text: str) -> list[str]:
    """The lines of a text that are not empty."""
    return [line for line in map(str.strip, text.split("\n")) if line]


def _blame_line(path: Path, text: str) -> None:
    """Raises LucidaError for the first line that trimesh may have stumbled over, if there is one.

    text: as _text() gives it, with an empty line before the first.
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


def _ply_rows(header: str, least_bytes: bool) -> list[int]:
    """For each element of a PLY header its rows, or the fewest bytes they can have."""
    sizes = {"8": 1, "char": 1, "uchar": 1, "16": 2, "short": 2, "ushort": 2, "64": 8, "double": 8}
    rows: list[int] = []
    width: list[int] = []
    for line in header.split("\n"):
        words = line.split()
        if words[:1] == ["element"] and len(words) == 3:
            rows.append(int(words[2]) if re.fullmatch(r"-?\d{1,18}", words[2]) else -1)
            width.append(0)
        elif words[:1] == ["property"] and len(words) >= 3 and width:
            kind = words[2] if words[1] == "list" else words[1]
            width[-1] += sizes.get(kind, sizes.get(kind.lstrip("uintfloa"), 4))
    if not least_bytes:
        return rows
    return [count * max(each, 1) for count, each in zip(rows, width, strict=True)]


def _check_rows(path: Path, declared: list[int], there: int, unit: str) -> None:
    for count in declared:
        if count < 0:
            raise _damaged(path, "declares a count that is not a whole number")
    if sum(declared) > there:
        raise _damaged(path, f"declares {sum(declared)} {unit} of data and has {there}")


def _check_limit(path: Path, count: int, most: int, what: str) -> None:
    if count > most:
        raise LucidaError("", f"has {count} {what}", f"stay within {most}", str(path))


def _whole(path: Path, word: str) -> int:
    if not re.fullmatch(r"-?\d{1,18}", word):
        raise _damaged(path, "declares a count that is not a whole number")
    return int(word)


def _damaged(path: Path, problem: str) -> LucidaError:
    return LucidaError("", problem, "it is cut off or of another kind; export it again", str(path))


def _geometries(found: dict[str, Any], name: str) -> list[tuple[str, dict[str, Any]]]:
    """trimesh's answer as (name, fields of a geometry), whether it found one or several."""
    if "geometry" in found:
        return list(found["geometry"].items())
    return [(name, found)]


def _part(name: str, fields: dict[str, Any], material: Material | None = None) -> Part:
    return Part(
        str(name),
        fields.get("vertices"),
        fields.get("faces"),
        fields.get("vertex_normals"),
        linear_colors(fields.get("vertex_colors")),
        linear_colors(fields.get("face_colors")),
        material,
    )


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
