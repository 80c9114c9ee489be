"""PLY, STL and OFF files.

Each count that a file declares is compared with the available data before memory is allocated.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import check_bytes, check_count, damaged, read_file
from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.scene.limits import BINARY_MODEL_BYTES, TEXT_MODEL_BYTES, TRIANGLES
from lucida.renderer.system.errors import LucidaError

from .parts import Part, linear_colors
from .polygons import check_corners, triangulated
from .texts import floats, read_text_bytes, tidy, words

_VERTEX = re.compile(rb"(?i)vertex([^\n]*)")
_FACET = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attribute", "<u2")])
_PLY_END = re.compile(rb"end_header[ \t\r]*\n")
_PLY_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip
_POINT, _NORMAL, _COLORS = "xyz", ("nx", "ny", "nz"), ("red", "green", "blue")
_PLACES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
_CORNERS = ("vertex_indices", "vertex_index")
_PLY_READ = {*_POINT, *_NORMAL, *_COLORS, "alpha", *np.ravel(_PLACES).tolist(), *_CORNERS}
Columns = dict[str, NDArray[Any]]


def read_ply(path: Path, images: ModelImages) -> list[Part]:
    """Return the mesh of a .ply file, text or binary. images: notes unread data."""
    data = read_file(path, BINARY_MODEL_BYTES)
    end = _PLY_END.search(data[: 1 << 16])
    if not data.startswith(b"ply") or not end:
        raise damaged("has no PLY header")
    header, body = data[: end.end()].decode("utf-8", "replace"), data[end.end() :]
    found: dict[str, Columns] = {}
    try:
        elements, form = _ply_header(header)
        if is_text := form == "ascii":
            check_bytes(len(data), TEXT_MODEL_BYTES, "")
            text = tidy(body)
            body = floats(text, words(text)[0]).tobytes()
        order = ">" if form == "binary_big_endian" else "<"
        at = 0
        for element in elements:
            found[element.name], at = _ply_columns(body, at, element, order, is_text)
    except (ValueError, TypeError, LookupError, OverflowError):
        raise damaged("does not hold the data that its PLY header declares") from None
    if "tristrips" in found:
        raise LucidaError("tristrips", "are not read", "export triangles")
    vertex, face = found.get("vertex", {}), found.get("face", {})
    names = [name for element in elements for name, _, _ in element.properties]
    left = [name for name in names if name not in _PLY_READ]
    if left := left + ["colours of faces"] * ("red" in face):
        images.note(f"not read: {', '.join(left)}", "PLY")
    return [_ply_part(vertex, face, path.stem)]


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
    """Return the columns of an element, and its end. A list has two: its numbers under its name,
    and their count in each row under "name count".
    """
    if element.rows < 0:
        raise ValueError
    if not element.rows or not element.properties:
        return {}, at
    # A text's numbers have all been read as float64.
    kinds = [
        (name, counted and (order + counted, "<f8")[is_text], (order + kind, "<f8")[is_text])
        for name, counted, kind in element.properties
    ]
    fields: list[tuple[Any, ...]] = []
    for name, counted, kind in kinds:  # assume that all lists are as long as those of the first row
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


def _ply_part(vertex: Columns, face: Columns, name: str) -> Part:
    def rows(columns: Columns, *choices: tuple[str, ...]) -> NDArray[Any] | None:
        whole = (names for names in choices if set(names) <= columns.keys())
        return next((np.column_stack([columns[n] for n in names]) for names in whole), None)

    points = rows(vertex, tuple(_POINT))
    listed = next((name for name in _CORNERS if f"{name} count" in face), None)
    if points is None or listed is None:
        return Part(name, np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    faces = _faces(points, face[listed], face[f"{listed} count"])
    return Part(
        name,
        points,
        faces,
        rows(vertex, _NORMAL),
        linear_colors(rows(vertex, _COLORS)),
        uv=rows(vertex, *_PLACES),
    )


def _faces(points: NDArray[Any], corners: NDArray[Any], counts: NDArray[Any]) -> NDArray[np.int64]:
    """Return the triangles of polygons."""
    with np.errstate(invalid="ignore"):
        corners = corners.astype(np.int64)
    check_corners(corners, len(points))
    places, _ = triangulated(points.astype(np.float64), corners, counts.astype(np.int64))
    return corners[places]


def read_off(path: Path, images: ModelImages) -> list[Part]:
    """Return the mesh of an .off file, a text. images: notes unread data."""
    text = re.sub(rb"#[^\n]*", b"", read_text_bytes(path)).lstrip()
    kind = re.match(rb"(?i)(ST)?(C)?(N)?OFF(?!\s*BINARY)", text)
    if kind is None:
        raise damaged("does not begin with OFF, or is binary")
    text = b" %s\n" % text[kind.end() :]
    begins, lengths = words(text)
    lengths = lengths[lengths > 0]
    rows = np.cumsum(lengths) - lengths
    try:
        numbers = floats(text, begins)
        vertices, faces = (int(numbers[k]) for k in (0, 1))
        which = slice(vertices + 1, vertices + 1 + faces)
        first = rows[which]
        counts = numbers[first].astype(np.int64)
        is_whole = len(first) == faces and (lengths[1 : vertices + 1] >= 3).all()
        if vertices < 0 or not is_whole or not ((counts >= 0) & (counts < lengths[which])).all():
            raise ValueError
        points = numbers[rows[1 : vertices + 1, None] + np.arange(3)]
        places = np.repeat(first + 1 - (np.cumsum(counts) - counts), counts)
        corners = numbers[places + np.arange(len(places))]
    except (ValueError, IndexError, OverflowError):
        raise damaged("does not hold the data that its OFF header declares") from None
    if kind[0].upper() != b"OFF" or (lengths[which] > counts + 1).any():
        images.note("not read: colours, normals and texture coordinates", "OFF")
    return [Part(path.stem, points, _faces(points, corners, counts))]


def read_stl(path: Path, images: ModelImages) -> list[Part]:
    """Return the mesh of all solids of an .stl file, text or binary. images: notes unread data."""
    data = read_file(path, BINARY_MODEL_BYTES)
    triangles = int.from_bytes(data[80:84], "little")
    behind = len(data) - 84 - 50 * triangles
    if behind == 0 or behind > 0 < triangles:
        check_count(triangles, TRIANGLES, "triangles")
        points = np.frombuffer(data, _FACET, triangles, 84)["vertices"].reshape(-1, 3)
        if behind:
            images.note(f"not read: {behind} bytes after the triangles", "STL")
    elif data.lstrip()[:5].lower() == b"solid" and b"endsolid" in data.lower():
        check_bytes(len(data), TEXT_MODEL_BYTES, "")
        text = b" %s\n" % b"\n ".join(_VERTEX.findall(tidy(data)))
        try:
            points = floats(text, words(text)[0]).reshape(-1, 3)
        except ValueError:
            raise damaged("has a vertex that is not three numbers") from None
    else:
        raise damaged(f"is not an STL of {triangles} triangles: it has {len(data):,} bytes")
    return [Part(path.stem, points, np.arange(len(points) // 3 * 3).reshape(-1, 3))]
