"""Wavefront .obj files: vertices, polygons, objects and materials, and which line has an error."""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene import numerals
from renderer.scene.images import ModelImages
from renderer.scene.limits import OBJECTS
from renderer.scene.model import Material
from renderer.scene.mtl import Library, read_mtl
from renderer.scene.numerals import Ints
from renderer.scene.obj_lines import Lines
from renderer.scene.parts import Part, linear_colors, used_vertices
from renderer.scene.texts import read_text_bytes

_END_LETTERS = 4096  # a last line that is longer is not looked at
_WHOLE = re.compile(r"[-+]?\d{1,18}")
_VALUES = {"v": "a vertex", "vn": "a normal"}


@dataclass(frozen=True, eq=False)
class _Triangles:
    """Indices from 0, (m, 3), into vertices, texture coordinates and normals; -1 where a corner
    has none, None where no corner has any. line: of the file, (m,)."""

    vertices: Ints
    uvs: Ints | None
    normals: Ints | None
    line: Ints

    def chosen(self, which: NDArray) -> _Triangles:
        uvs, normals = (None if a is None else a[which] for a in (self.uvs, self.normals))
        return _Triangles(self.vertices[which], uvs, normals, self.line[which])


def read_obj(path: Path, images: ModelImages, is_mapped: bool = False) -> list[Part]:
    """Return the parts of an .obj file: one for each object and material, in the file's order.

    images: for the textures of its materials.
    is_mapped: all parts with texture coordinates.
    """
    lines = Lines(read_text_bytes(path))
    if not len(lines.numbers("f")):
        return []
    _check_end(path, lines)
    try:
        vertices, normals = _rows(lines, "v"), _rows(lines, "vn")
        triangles = _triangles(lines)
        if vertices.shape[1] < 3 or not _are_within(triangles.vertices, len(vertices)):
            raise ValueError("vertices are missing")
    except ValueError as error:
        _blame_line(path, lines, str(error))
    named = _named_parts(path, lines, triangles, images)
    places = np.zeros((0, 0))
    textured = [
        is_mapped or (material is not None and material.texture is not None)
        for _, _, material in named
    ]
    if any(textured):
        places = _places(lines)
    parts = []
    for (name, which, material), is_textured in zip(named, textured, strict=True):
        mine = triangles if len(named) == 1 else triangles.chosen(which)
        source, faces, normal, place = _merged(mine, normals, places if is_textured else None)
        part_normals = None if normal is None else normals[normal]
        uv = None if place is None else places[place, :2]
        colors = linear_colors(vertices[source, 3:6]) if vertices.shape[1] >= 6 else None
        corners = vertices[source, :3]
        part = Part(name, corners, faces, part_normals, colors, material=material, uv=uv)
        parts.append(part)
    return parts


def _places(lines: Lines) -> NDArray[np.float64]:
    """Return texture coordinates, of two numbers or more; none if they cannot be read."""
    try:
        found = _rows(lines, "vt")
    except ValueError:
        return np.zeros((0, 0))
    return found if found.shape[1] >= 2 else np.zeros((0, 0))


def _rows(lines: Lines, kind: str) -> NDArray[np.float64]:
    """Return the numbers of all lines of a kind: as many of each as the shortest line has."""
    text = lines.of(kind)
    begins, counts = numerals.words(text)
    values = numerals.floats(text, begins)
    if not len(counts):
        return np.zeros((0, 0))
    width = int(counts.min())
    if width == counts.max():
        return values.reshape(-1, width)
    return values[(np.cumsum(counts) - counts)[:, None] + np.arange(width)]


def _triangles(lines: Lines) -> _Triangles:
    """Return the polygons as fans of triangles: corners 0, k, k + 1."""
    text = lines.of("f")
    line = lines.numbers("f")
    begins, counts = numerals.words(text)
    columns = [
        None if column is None else _from_zero(column, counts, line, lines.numbers(kind))
        for kind, column in zip(("v", "vt", "vn"), numerals.corners(text, begins), strict=True)
    ]
    if (counts == 3).all():
        corners = np.arange(3 * len(counts)).reshape(-1, 3)
    else:
        fan = np.maximum(counts - 2, 0)
        first = np.repeat(np.cumsum(counts) - counts, fan)
        k = np.arange(len(first)) - np.repeat(np.cumsum(fan) - fan, fan)
        corners = np.stack([first, first + k + 1, first + k + 2], axis=1)
        line = np.repeat(line, fan)
    vertices, uvs, normals = (None if c is None else c[corners] for c in columns)
    assert vertices is not None  # a word has a first number
    return _Triangles(vertices, uvs, normals, line)


def _from_zero(column: Ints, counts: Ints, line: Ints, named: Ints) -> Ints:
    """Return indices counted from 0: -1 for none, less for an impossible one.

    Negative ones are counted from the end of what was defined above their line. column: of the
    lines `line`, counts of each. named: the lines of the elements they refer to.
    """
    if column.min(initial=0) >= 0:
        return column - 1
    back = np.repeat(np.searchsorted(named, line), counts) + column
    return np.where(column < 0, np.where(back < 0, -2, back), column - 1)


def _are_within(indices: Ints, count: int) -> bool:
    return indices.min(initial=0) >= 0 and indices.max(initial=-1) < count


def _merged(
    triangles: _Triangles, normals: NDArray[np.float64], places: NDArray[np.float64] | None
) -> tuple[Ints, Ints, Ints | None, Ints | None]:
    """Return (source, faces, normal, place): for each new vertex its vertex, normal and texture
    coordinates; and the faces.

    Corners that agree in all three become one vertex. normal and place are None unless all corners
    have them.
    """
    key = source = triangles.vertices.reshape(-1)
    normal = None if triangles.normals is None else triangles.normals.reshape(-1)
    place = None if triangles.uvs is None or places is None else triangles.uvs.reshape(-1)
    if normals.shape[1] != 3 or normal is None or not _are_within(normal, len(normals)):
        normal = None
    if places is None or place is None or not _are_within(place, len(places)):
        place = None
    for other, count in ((normal, len(normals)), (place, len(places) if places is not None else 0)):
        if other is not None and not np.array_equal(source, other):
            key = key * count + other
    if key is source:
        source, faces = used_vertices(triangles.vertices)
        same = source
    else:
        _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
        faces, same = inverse.reshape(-1, 3), None
        source = source[first]
        normal, place = (None if a is None else a[first] for a in (normal, place))
    if same is not None:  # the numbers are those of the vertices
        normal, place = (None if a is None else same for a in (normal, place))
    return source, faces, normal, place


def _named_parts(
    path: Path, lines: Lines, triangles: _Triangles, images: ModelImages
) -> list[tuple[str, NDArray, Material | None]]:
    """Return for each object and material a name, its triangles, and the material if the file has
    it.
    """
    materials = Library({}, {}, path.parent)
    keys: dict[tuple[str | None, str | None], int] = {(None, None): 0}
    at, states = [-1], [0]
    found: str | None = None
    used: str | None = None
    library: str | None = None
    for number, keyword, rest in lines.statements():
        if keyword == "mtllib":
            library = rest if library is None else library
            continue
        found, used = (rest, used) if keyword == "o" else (found, " ".join(rest.split()))
        at.append(number)
        states.append(keys.setdefault((found, used), len(keys)))
    if len(keys) == 1 or not len(triangles.line):
        return [(path.stem, np.arange(0), None)]
    part = np.array(states)[np.searchsorted(np.array(at), triangles.line) - 1]
    order = np.argsort(part, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(part[order])) + 1)
    if len(groups) > OBJECTS:
        return [(path.stem, order, None)]
    groups.sort(key=lambda group: int(group[0]))
    if library:
        materials = _materials(path.parent, library)
    all_keys = list(keys)
    named = []
    for group in groups:
        found, used = all_keys[part[group[0]]]
        several = len(materials.plain) > 1
        words = [word for word in (found, used if several else None) if word is not None]
        name = "_".join(words) if words else "geometry"
        named.append((name, group, materials.material(used or "", images)))
    return _told_apart(named)


def _told_apart(
    named: list[tuple[str, NDArray, Material | None]],
) -> list[tuple[str, NDArray, Material | None]]:
    """Return the parts with unique names. The last of equal names keeps it; those before it are
    numbered: x_2, x_1, x.
    """
    taken: set[str] = set()
    counts: dict[str, int] = {}
    apart = []
    for name, group, material in reversed(named):
        unique = name
        base, _, number = name.rpartition("_")
        if not (base and number.isdecimal() and len(number) < 10):
            base, number = name or "geometry", "0"
        counted = counts.get(base, int(number))
        while not unique or unique in taken:
            counted += 1
            unique = f"{base}_{counted}"
            counts[base] = counted
        taken.add(unique)
        apart.append((unique, group, material))
    return apart[::-1]


def _materials(folder: Path, name: str) -> Library:
    """Return the materials of an .mtl file in the folder of the .obj file; none if it cannot be
    read.
    """
    with contextlib.suppress(LucidaError, OSError, ValueError):
        path = (folder / name).resolve()
        if path.is_relative_to(folder.resolve()):
            return read_mtl(path)
    return Library({}, {}, folder)


def _check_end(path: Path, lines: Lines) -> None:
    """Raise LucidaError if the file ends within a face."""
    text = lines.text[-_END_LETTERS:].rstrip()
    line = text.rpartition(b"\n")[2].decode("utf-8", "replace")
    keyword, *corners = line.partition("#")[0].split() or [""]
    slashes = {corner.count("/") for corner in corners}
    if keyword == "f" and (len(corners) < 3 or len(slashes) > 1):
        raise LucidaError(
            f"line {lines.text.rstrip().count(10)}",
            f"{line[:60]!r}, the last one, is not a whole face",
            "the file is cut off; export it again",
            str(path),
        )


def _blame_line(path: Path, lines: Lines, reason: str) -> NoReturn:
    """Raise LucidaError for the first line that is at fault."""
    count = len(lines.numbers("v"))
    above = 0
    for number, line in enumerate(lines.text.decode("utf-8", "replace").split("\n")):
        keyword, *words = line.partition("#")[0].split() or [""]
        problem = ""
        if keyword in _VALUES:
            above += keyword == "v"
            if (keyword == "v" and len(words) < 3) or not all(map(_is_number, words)):
                problem = f"is not {_VALUES[keyword]}"
        elif keyword == "f":
            problem = _face_problem(words, above, count)
        if problem:
            raise LucidaError(
                f"line {number}", f"{line[:60]!r} {problem}", "repair the line", str(path)
            )
    raise LucidaError(
        "",
        f"cannot be read as OBJ: {reason}",
        "it is damaged or of another kind; export it again, as triangles",
        str(path),
    )


def _face_problem(corners: list[str], above: int, count: int) -> str:
    for corner in corners:
        first, *others = corner.split("/")
        if (
            len(others) > 2
            or not _WHOLE.fullmatch(first)
            or not all(_WHOLE.fullmatch(x) for x in others if x)
        ):
            return "is not a face"
        index = int(first)
        if index == 0 or not -above <= index <= count:
            return f"uses vertex {index} of {count}"
    return ""


def _is_number(word: str) -> bool:
    with contextlib.suppress(ValueError):
        float(word)
        return True
    return False
