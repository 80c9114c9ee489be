"""PLY, STL and OFF files.

Each count that a file declares is compared with the data that is there before memory is set aside.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.gltf_file import TRIANGLE_STRIP
from lucida.renderer.files.models.gltf_numbers import triangles_of
from lucida.renderer.files.models.mtl import ImageMap, MtlMaterial
from lucida.renderer.files.models.numerals import floats, words
from lucida.renderer.files.models.parts import Part, linear_colors
from lucida.renderer.files.models.polygons import check_corners, triangulated
from lucida.renderer.files.models.texts import read_text_bytes, tidy
from lucida.renderer.files.reading import check_bytes, check_count, damaged, read_file
from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.scene.limits import BINARY_MODEL_BYTES, OBJECTS, TEXT_MODEL_BYTES, TRIANGLES
from lucida.renderer.system.errors import LucidaError

_SOLID = re.compile(rb"(?is)\n[ \t]*solid\b([^\n]*)(.*?)endsolid")
_VERTEX = re.compile(rb"(?i)vertex([^\n]*)")
_FACET = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attribute", "<u2")])
_PLY_END = re.compile(rb"end_header[ \t\r]*\n")
_PLY_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip
_PLY_LISTS = ("vertex_indices", "vertex_index")
_COLORS = ("red", "green", "blue", "alpha")
_PLACES = ("s", "t", "u", "v", "texture_u", "texture_v")
# By element, the properties that are read, and those that change no picture.
_PLY_READ = {
    "vertex": (*"xyz", "nx", "ny", "nz", *_COLORS, *_PLACES, "confidence", "intensity", "quality"),
    "face": (*_PLY_LISTS, *_COLORS, "texcoord", "texnumber", "flags", "quality"),
    "tristrips": _PLY_LISTS,
}
_PLY_TEXTURE = re.compile(r"(?m)^comment TextureFile (.*)$")
Columns = dict[str, NDArray[Any]]


def read_ply(path: Path, images: ModelImages) -> list[Part]:
    """Return the mesh of a .ply file, text or binary. images: for its texture; notes what is not
    read.
    """
    data = read_file(path, BINARY_MODEL_BYTES)
    end = _PLY_END.search(data[: 1 << 16])
    if not data.startswith(b"ply") or not end:
        raise damaged("has no PLY header")
    header, body = data[: end.end()].decode("utf-8", "replace"), data[end.end() :]
    try:
        elements, form = _ply_header(header)
        if is_text := form == "ascii":
            check_bytes(len(data), TEXT_MODEL_BYTES, "")
            text = tidy(body)
            body = floats(text, words(text)[0]).tobytes()
        order = ">" if form == "binary_big_endian" else "<"
        found: dict[str, Columns] = {}
        at = 0
        for element in elements:
            found[element.name], at = _ply_columns(body, at, element, order, is_text)
    except (ValueError, TypeError, LookupError, OverflowError):
        raise damaged("does not hold what its PLY header declares") from None
    not_read = [e.name for e in elements if e.rows and e.name not in _PLY_READ]
    for element in elements:
        names = [name for name, _, _ in element.properties]
        not_read += [n for n in names if n not in _PLY_READ.get(element.name, names)]
    part, material = _ply_part(found, path.stem, images), None
    if at < len(body):
        not_read.append("what follows the last element")
    match _PLY_TEXTURE.findall(header):
        case [name]:
            material = MtlMaterial(path.parent, image=ImageMap(name.strip())).material(images)
        case several:
            not_read += several
    if not_read:
        images.note(f"not read: {', '.join(not_read)}", "PLY")
    return [replace(part, material=material)]


class _PlyElement(NamedTuple):
    """properties: name, type of a list's count or "", type."""

    name: str
    rows: int
    properties: list[tuple[str, str, str]]


def _ply_header(header: str) -> tuple[list[_PlyElement], str]:
    """Return the elements and the format. Raises ValueError or KeyError."""
    elements: list[_PlyElement] = []
    form = ""
    for line in header.split("\n"):
        match line.split():
            case ["format", form, *_]:
                pass
            case ["element", name, count]:
                elements.append(_PlyElement(name, int(count), []))
            case ["property", "list", counted, kind, name]:
                types = name, _PLY_TYPES[counted], _PLY_TYPES[kind]
                elements[-1].properties.append(types)
            case ["property", kind, name]:
                elements[-1].properties.append((name, "", _PLY_TYPES[kind]))
    return elements, form


def _ply_columns(
    body: bytes, at: int, element: _PlyElement, order: str, is_text: bool
) -> tuple[Columns, int]:
    """Return the columns of an element, and where it ends. A list has two: its numbers under its
    name, and their count in each row under "name count".
    """
    if element.rows < 0:
        raise ValueError
    if not element.rows or not element.properties:
        return {}, at
    # In a text, all numbers have been read as float64.
    kinds = [
        (name, counted and (order + counted, "<f8")[is_text], (order + kind, "<f8")[is_text])
        for name, counted, kind in element.properties
    ]
    fields: list[tuple[Any, ...]] = []
    for name, counted, kind in kinds:  # as if all lists were as long as those of the first row
        if counted:
            length = np.frombuffer(body, counted, 1, at + np.dtype(fields).itemsize)
            fields += [(f"{name} count", counted), (name, kind, (int(length[0]),))]
        else:
            fields.append((name, kind))
    row = np.dtype(fields)
    lists = [f"{name} count" for name, counted, _ in kinds if counted]
    end = at + element.rows * row.itemsize
    rows = np.frombuffer(body, row, element.rows if end <= len(body) or not lists else 0, at)
    if len(rows) and all((rows[name] == rows[name][0]).all() for name in lists):
        found = {name: rows[name].reshape(-1) for name in row.names or ()}
    else:
        found, end = _ragged_columns(body, at, element.rows, kinds)
    if is_text:
        types = {name: kind for name, _, kind in element.properties}
        with np.errstate(all="ignore"):
            found = {name: a.astype(types.get(name, "i8")) for name, a in found.items()}
    return found, end


def _ragged_columns(
    body: bytes, at: int, count: int, kinds: list[tuple[str, str, str]]
) -> tuple[Columns, int]:
    """Return the columns of an element whose lists differ in length, row by row."""
    found: dict[str, list[NDArray[Any]]] = {}
    for _ in range(count):
        for name, counted, kind in kinds:
            length = 1
            if counted:
                number = np.frombuffer(body, counted, 1, at)
                found.setdefault(f"{name} count", []).append(number)
                length, at = int(number[0]), at + number.itemsize
                if length < 0:
                    raise ValueError
            numbers = np.frombuffer(body, kind, length, at)
            found.setdefault(name, []).append(numbers)
            at += numbers.nbytes
    return {name: np.concatenate(pieces) for name, pieces in found.items()}, at


def _ply_part(found: dict[str, Columns], name: str, images: ModelImages) -> Part:
    vertex, face = found.get("vertex", {}), found.get("face", {})

    def rows(columns: Columns, *names: str, least: int = 3) -> NDArray[Any] | None:
        there = [columns[name] for name in names if name in columns]
        return np.column_stack(there) if len(there) >= least else None

    def lists(columns: Columns) -> tuple[NDArray[Any], NDArray[Any]]:
        for name in _PLY_LISTS:
            if f"{name} count" in columns:
                return columns[name], columns[f"{name} count"]
        return np.zeros(0), np.zeros(0)

    vertices: dict[str, Any] = {
        "vertices": rows(vertex, *"xyz"),
        "normals": rows(vertex, "nx", "ny", "nz"),
        "vertex_colors": linear_colors(rows(vertex, *_COLORS)),
        "uv": rows(vertex, *_PLACES, least=2),
    }
    if (points := vertices["vertices"]) is None:
        return Part(name, np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    corners, counts = lists(face)
    corners, places, owner = _faces(points, corners, counts, images)
    faces, colors = corners[places], linear_colors(rows(face, *_COLORS))
    if len(strips := _strips(*lists(found.get("tristrips", {})))):
        check_corners(strips.reshape(-1), len(points))
        faces, colors = np.concatenate([faces, strips]), None
    elif "texcoord count" in face and np.array_equal(
        face["texcoord count"], 2 * counts
    ):  # a vertex for each corner
        vertices = {key: rows if rows is None else rows[corners] for key, rows in vertices.items()}
        vertices["uv"], faces = face["texcoord"].reshape(-1, 2), places
    return Part(
        name, faces=faces, face_colors=None if colors is None else colors[owner], **vertices
    )


def _strips(corners: NDArray[Any], counts: NDArray[Any]) -> NDArray[np.int64]:
    """Return the triangles of strips, which end with their list or at -1."""
    found = [np.zeros((0, 3), np.int64)]
    ends = np.append(np.cumsum(counts[:-1]), np.flatnonzero(corners == -1))
    for strip in np.split(corners.astype(np.int64), np.sort(ends.astype(np.int64))):
        found.append(triangles_of(strip[strip != -1], TRIANGLE_STRIP))
    return np.concatenate(found)


def _faces(
    points: NDArray[Any], corners: NDArray[Any], counts: NDArray[Any], images: ModelImages
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return the polygons' corners, and triangulated() of them."""
    with np.errstate(invalid="ignore"):
        corners = corners.astype(np.int64)
    check_corners(corners, len(points))
    points, counts = points.astype(np.float64), counts.astype(np.int64)
    return corners, *triangulated(points, corners, counts, images)


def read_off(path: Path, images: ModelImages) -> list[Part]:
    """Return the mesh of an .off file, a text. images: notes what is not read."""
    text = re.sub(rb"#[^\n]*", b"", read_text_bytes(path)).lstrip()
    kind = re.match(rb"(?i)([a-z0-9]*?)off", text)
    if kind is None:
        raise damaged("does not begin with OFF")
    rest = text[kind.end() :]
    if kind[1].upper() not in (b"", b"C", b"N", b"CN", b"ST") or rest.lstrip()[:6] == b"BINARY":
        raise LucidaError("", f"is of the kind {kind[0].decode()}", "export a plain OFF")
    rest = b" %s\n" % rest
    begins, lengths = words(rest)
    lengths = lengths[lengths > 0]
    rows = np.cumsum(lengths) - lengths
    try:
        numbers = floats(rest, begins)
        vertices, faces = (int(numbers[k]) for k in (0, 1))
        is_whole = min(vertices, faces) >= 0 and vertices + faces < len(rows)
        if not is_whole or (lengths[1 : vertices + 1] < 3).any():
            raise ValueError
        points = numbers[rows[1 : vertices + 1, None] + np.arange(3)]
        which = slice(vertices + 1, vertices + 1 + faces)
        first, room = rows[which], lengths[which]
        sides = numbers[first]
        if not ((sides >= 0) & (sides < room)).all():
            raise ValueError
        counts = sides.astype(np.int64)
        places = np.repeat(first + 1 - (np.cumsum(counts) - counts), counts)
        corners = numbers[places + np.arange(len(places))]
    except (ValueError, IndexError, OverflowError):
        raise damaged("does not hold what its OFF header declares") from None
    if kind[1] or (room > sides + 1).any():
        images.note("not read: colours, normals and texture coordinates", "OFF")
    indices, cut, _ = _faces(points, corners, counts, images)
    return [Part(path.stem, points, indices[cut])]


def read_stl(path: Path, images: ModelImages) -> list[Part]:
    """Return the solids of an .stl file, text or binary. images: notes what is not read."""
    data = read_file(path, BINARY_MODEL_BYTES)
    triangles = int.from_bytes(data[80:84], "little")
    solids: list[tuple[str, NDArray[Any]]] = []
    behind = len(data) - 84 - 50 * triangles
    if len(data) >= 84 and (behind == 0 or behind > 0 < triangles):
        check_count(triangles, TRIANGLES, "triangles")
        facets = np.frombuffer(data, _FACET, triangles, 84)
        if behind:
            images.note(f"not read: {behind} bytes behind the triangles", "STL")
        if facets["attribute"].any() or b"COLOR=" in data[:80]:
            images.note(
                "not read: attributes of triangles, which some programs use for colours", "STL"
            )
        solids.append(("", facets["vertices"].reshape(-1, 3)))
    elif data.lstrip()[:5].lower() == b"solid":
        check_bytes(len(data), TEXT_MODEL_BYTES, "")
        found = _SOLID.findall(tidy(data))
        if not found:
            raise damaged("has no 'endsolid'")
        check_count(len(found), OBJECTS, "solids")
        for name, lines in found:
            text = b" %s\n" % b"\n ".join(_VERTEX.findall(lines))
            try:
                points = floats(text, words(text)[0]).reshape(-1, 3)
            except ValueError:
                raise damaged("has a vertex that is not three numbers") from None
            solids.append((name.decode("utf-8", "replace").strip(), points))
    elif len(data) < 84:
        raise damaged("is too short to be STL")
    else:
        declared = f"{triangles} triangles, {84 + 50 * triangles:,} bytes"
        raise damaged(f"declares {declared}, and has {len(data):,} bytes")
    return [
        Part(name or path.stem, points, np.arange(len(points) // 3 * 3).reshape(-1, 3))
        for name, points in solids
    ]
