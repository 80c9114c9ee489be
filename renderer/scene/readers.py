"""PLY, STL and OFF files through trimesh's readers.

Owns what is checked and mended before trimesh: each count that a file declares is held
against its size, so that no lie sets memory aside. Knows nothing of meshes' repair.
"""

from __future__ import annotations

import io
import itertools
import re
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.guard import damaged, geometries, guarded, to_part
from renderer.scene.limits import (
    BINARY_MODEL_BYTES,
    OBJECTS,
    TEXT_MODEL_BYTES,
    TRIANGLES,
)
from renderer.scene.parts import Part
from renderer.scene.reading import check_bytes, read_file, size_texts
from renderer.scene.texts import read_text, tidy

_SOLID = re.compile(r"^[ \t]*solid\b([^\n]*)", re.MULTILINE | re.IGNORECASE)


def read_ply(path: Path) -> list[Part]:
    """The mesh of a .ply file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    end = re.search(rb"end_header[ \t\r]*\n", data[: 1 << 16])
    if not data.startswith(b"ply") or not end:
        raise damaged(path, "has no PLY header")
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
    return [to_part(path.stem, fields) for _, fields in geometries(found, path.stem)]


def read_stl(path: Path) -> list[Part]:
    """The solids of an .stl file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    triangles = int.from_bytes(data[80:84], "little")
    names: list[str] = []
    if len(data) != 84 + 50 * triangles or len(data) < 84:
        if data.lstrip()[:5].lower() != b"solid":
            if len(data) < 84:
                raise damaged(path, "is too short to be STL")
            declared, there = size_texts(84 + 50 * triangles, len(data))
            raise damaged(path, f"declares {triangles} triangles, {declared}, and has {there}")
        check_bytes(len(data), TEXT_MODEL_BYTES, str(path))
        text = tidy(data).decode("utf-8", "replace")
        solids = text.lower().count("endsolid")
        if not solids:
            raise damaged(path, "has no 'endsolid'")
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
    for number, fields in geometries(found, ""):
        name = names[int(number)] if number.isdigit() and int(number) < len(names) else ""
        parts.append(to_part(name or path.stem, fields))
    return parts


def read_off(path: Path) -> list[Part]:
    """The mesh of an .off file (text; vertex colours are not read)."""
    text = re.sub(r"#[^\n]*", "", read_text(path))
    lines = _lines(text)
    if lines and lines[0][:3].lower() == "off":
        lines[0] = "OFF" + lines[0][3:]
    words = " ".join(lines[:3]).split(None, 3)
    if not words or not re.fullmatch(r"[A-Z0-9]*OFF", words[0]):
        raise damaged(path, "does not begin with OFF")
    if words[0] not in ("OFF", "COFF", "NOFF", "CNOFF", "STOFF") or words[1:2] == ["BINARY"]:
        raise LucidaError("", f"is of the kind {words[0]}", "export a plain OFF", str(path))
    counts = [_whole(path, word) for word in words[1:3]]
    first = 2 if lines[0] == words[0] else 1  # the counts may stand beside the keyword
    _check_rows(path, counts, len(lines) - first, "lines")
    with guarded(path, "OFF"):
        from trimesh.exchange.off import load_off

        found = load_off(io.StringIO("\n".join(lines)))
    return [to_part(path.stem, fields) for _, fields in geometries(found, path.stem)]


def _lines(text: str) -> list[str]:
    """The lines of a text that are not empty."""
    return [line for line in map(str.strip, text.split("\n")) if line]


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
            raise damaged(path, "declares a count that is not a whole number")
    if sum(declared) > there:
        raise damaged(path, f"declares {sum(declared)} {unit} of data and has {there}")


def _check_limit(path: Path, count: int, most: int, what: str) -> None:
    if count > most:
        raise LucidaError("", f"has {count} {what}", f"stay within {most}", str(path))


def _whole(path: Path, word: str) -> int:
    if not re.fullmatch(r"-?\d{1,18}", word):
        raise damaged(path, "declares a count that is not a whole number")
    return int(word)
