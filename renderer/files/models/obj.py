"""Wavefront .obj files: vertices, polygons, objects and materials. Errors name their line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import damaged
from lucida.renderer.files.texture_images import ModelImages, inner_path, shown
from lucida.renderer.scene.limits import OBJECTS
from lucida.renderer.scene.material import Material
from lucida.renderer.system.errors import LucidaError

from . import texts
from .mtl import MtlMaterial, read_mtl
from .obj_lines import Lines
from .parts import Part, linear_colors, used_vertices
from .polygons import triangulated
from .texts import Ints

# Lines that change no picture: smoothing and groups without values, levels of detail, bevels.
_HARMLESS = ("s", "g", "mg", "lod", "bevel", "c_interp", "d_interp", "end")
Floats = NDArray[np.float64]
Named = tuple[str, Ints | slice, Material | None]  # a part's name, triangles and material


def read_obj(path: Path, images: ModelImages) -> list[Part]:
    """Return the parts of an .obj file: one for each object and material, in the file's order.

    images: for the textures of its materials.
    """
    lines = Lines(texts.read_text_bytes(path))
    if not len(lines.numbers("f")):
        if not len(lines.numbers("v")):
            raise damaged("has no line that begins with v or f")
        return []
    try:
        vertices, coordinates, normals = (_rows(lines, kind, images) for kind in ("v", "vt", "vn"))
        columns, counts = _corners(lines)
        # The file is cut off if its last face has two corners.
        if vertices.shape[1] < 3 or counts[-1] < 3 or not _are_within(columns[0], len(vertices)):
            raise ValueError
    except ValueError:
        _blame_line(path, lines)
    if vertices.shape[1] in (4, 5) and (vertices[:, 3] != 1).any():
        images.note("not read: the weights of vertices", "OBJ")
    places, owner = triangulated(vertices[:, :3], columns[0], counts)
    corners = [column if column is None else column[places] for column in columns]
    if normals.shape[1] != 3:
        normals = np.zeros((0, 3))
    normals = np.vstack([normals, np.zeros(3)])  # the last one makes a face flat
    named = _named_parts(path, lines, lines.numbers("f")[owner], images)
    if coordinates.shape[1] < 2:
        coordinates = np.zeros((0, 2))
    if corners[1] is not None:
        has_uv = np.all((corners[1] >= 0) & (corners[1] < len(coordinates)), axis=1)
        named = list(_by_coordinates(named, has_uv, images))
    parts = []
    for name, which, material in named:
        mine = [a if a is None else a[which] for a in corners]
        source, faces, uv, normal = _merged(mine, len(coordinates), len(normals) - 1)
        parts.append(
            Part(
                name,
                vertices[source, :3],
                faces,
                None if normal is None else normals[normal],
                linear_colors(vertices[source, 3:6]) if vertices.shape[1] >= 6 else None,
                material=material,
                uv=None if uv is None else coordinates[uv, :2],
            )
        )
    return parts


def _by_coordinates(
    named: list[Named], has_uv: NDArray[np.bool_], images: ModelImages
) -> Iterator[Named]:
    """Yield the parts. Triangles without coordinates for their texture become separate parts, in
    the plain colour of their material.
    """
    for name, which, material in named:
        numbers = np.arange(len(has_uv))[which]
        bare = numbers[~has_uv[numbers]]
        if material is None or material.texture is None or not 0 < len(bare) < len(numbers):
            yield name, which, material
            continue
        problem = f"{len(bare)} triangles of {shown(name)} have no texture coordinates"
        images.note(f"{problem}; the plain colour is shown")
        yield name, numbers[has_uv[numbers]], material
        yield f"{name}_plain", bare, replace(material, texture=None)


def _rows(lines: Lines, kind: str, images: ModelImages) -> Floats:
    """Return the numbers of all lines of a kind, cut to the length of the shortest line.

    Longer lines are noted: for example, only some vertices may have colours.
    """
    text = lines.of(kind)
    begins, counts = texts.words(text)
    values = texts.floats(text, begins)
    width = int(counts.min(initial=9)) if len(counts) else 0
    if (counts > width).any():
        images.note(f"not read: numbers that only some lines of the kind {kind} have", "OBJ")
    return values[(np.cumsum(counts) - counts)[:, None] + np.arange(width)]


def _corners(lines: Lines) -> tuple[list[Ints], Ints]:
    """Return the polygons' corners: indices of vertices, texture coordinates and normals, (c,),
    None if no corner has any; and the number of corners of each polygon.

    Indices count from 0; -1 means none, and lower numbers are invalid.
    """
    columns = []
    found, counts = texts.corners(lines.of("f"))
    for kind, column in zip(("v", "vt", "vn"), found, strict=True):
        if column is not None:
            # Negative ones count from the end of the entries above their line.
            if column.min() < 0:
                above = np.searchsorted(lines.numbers(kind), lines.numbers("f"))
                back = np.repeat(above, counts) + column
                column = np.where(column < 0, np.where(back < 0, -2, back), column - 1)
            else:
                column = column - 1
        columns.append(column)
    return columns, counts


def _are_within(indices: Ints, count: int) -> bool:
    return indices.min(initial=0) >= 0 and indices.max(initial=-1) < count


def _merged(
    corners: list[Ints], uvs: int, normals: int
) -> tuple[Ints, Ints, Ints | None, Ints | None]:
    """Return (source, faces, uv, normal): the vertex, texture coordinates and normal of each new
    vertex, and the faces.

    corners: triangles of vertices, texture coordinates and normals. uvs, normals: their numbers.
    Corners that agree in all three become one vertex. uv is None unless all corners have
    coordinates, normal if none has a normal; those without one get number `normals`.
    """
    key = vertices = corners[0].reshape(-1)
    others: list[Ints | None] = []
    for indices, count in zip(corners[1:], (uvs, normals), strict=True):
        flat: Ints | None = None if indices is None else indices.reshape(-1)
        if flat is not None and not _are_within(flat, count):
            given = (flat >= 0) & (flat < count)
            flat = np.where(given, flat, count) if others and given.any() else None
        others.append(flat)
        if flat is not None and not np.array_equal(vertices, flat):
            key = key * (count + 1) + flat
    if key is vertices:  # all indices equal those of the vertices
        source, faces = used_vertices(corners[0])
        uv, normal = (None if other is None else source for other in others)
        return source, faces, uv, normal
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    uv, normal = (None if other is None else other[first] for other in others)
    return vertices[first], inverse.reshape(-1, 3), uv, normal


def _named_parts(
    path: Path, lines: Lines, triangle_lines: Ints, images: ModelImages
) -> list[Named]:
    """Return a name, the triangles and the material for each object and material.

    The material is None if the file does not have it.
    """
    keys: dict[tuple[str, str], int] = {("", ""): 0}
    at, states = [-1], [0]
    found = used = ""
    libraries = []
    left = [kind for kind in ("l", "p") if len(lines.numbers(kind))]
    for number, keyword, rest in lines.statements():
        if keyword == "mtllib":
            libraries.append(rest)
        elif keyword in ("o", "usemtl"):
            found, used = (rest, used) if keyword == "o" else (found, " ".join(rest.split()))
            at.append(number)
            states.append(keys.setdefault((found, used), len(keys)))
        elif keyword not in _HARMLESS:
            left.append(keyword[:20])
    if left:
        images.note(f"not shown: {', '.join([*dict.fromkeys(left)][:12])}", "shapes")
    part = np.array(states)[np.searchsorted(np.array(at), triangle_lines) - 1]
    order = np.argsort(part, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(part[order])) + 1)
    if len(groups) > OBJECTS:
        images.note(f"more than {OBJECTS} objects are shown as one, in one colour", "shapes")
    if len(keys) == 1 or len(groups) > OBJECTS or not len(order):
        return [(path.stem, slice(None), None)]
    groups.sort(key=lambda group: int(group[0]))
    materials = _materials(path.parent, libraries, images)
    all_keys = list(keys)
    named: list[Named] = []
    for group in groups:
        found, used = all_keys[part[group[0]]]
        name = "_".join(filter(None, (found, used if len(materials) > 1 else ""))) or "geometry"
        given = materials.get(used)
        if used and materials and given is None:
            problem = f"{shown(used)} is not in {', '.join(libraries)}; default colours are shown"
            images.note(problem, "materials")
        named.append((name, group, None if given is None else given.material(images)))
    return named


def _materials(folder: Path, libraries: list[str], images: ModelImages) -> dict[str, MtlMaterial]:
    """Return the materials of the .mtl files in the folder of the .obj file, by name. The first
    file that has a name defines it. Note the files that cannot be read.

    libraries: the text after each mtllib, a name that may hold blanks, or several names.
    """
    found: dict[str, MtlMaterial] = {}
    for line in libraries:
        several = any((folder / word).is_file() for word in line.split())
        for name in line.split() if several else [line]:
            try:
                found = read_mtl(inner_path(name, folder)) | found
            except LucidaError as error:
                problem = f"{shown(name)} {error.problem}; default colours are shown"
                images.note(problem, "materials")
    return found


def _blame_line(path: Path, lines: Lines) -> NoReturn:
    """Raise LucidaError for the first faulty line."""
    vertices = len(lines.numbers("v"))
    for number, line in enumerate(lines.text.decode("utf-8", "replace").split("\n")):
        keyword, *words = line.partition("#")[0].split() or [""]
        try:
            if keyword in ("v", "vn", "vt"):
                is_sound = len([float(word) for word in words]) >= (2 if keyword == "vt" else 3)
            else:
                corners = [abs(int(word.partition("/")[0])) for word in words if keyword == "f"]
                is_sound = keyword != "f" or (min(corners) > 0 and max(corners) <= vertices)
                is_sound &= number != lines.numbers("f")[-1] or len(words) > 2
        except ValueError:
            is_sound = False
        if not is_sound:
            problem = f"{line[:60]!r} is not valid in an OBJ with {vertices} vertices"
            raise LucidaError(f"line {number}", problem, "repair the line", str(path))
    raise LucidaError("", "cannot be read as OBJ", "export it again, as triangles", str(path))
