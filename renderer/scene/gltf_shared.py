"""The parts that a glTF file names several times: built once if possible, refused if too much.

A few bytes of JSON can show one buffer a thousand times.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.gltf_file import TRIANGLE_LIST, Gltf, entry_at
from renderer.scene.gltf_numbers import item_bytes
from renderer.scene.gltf_textures import coordinates_of
from renderer.scene.limits import SHARED_BYTES, TRIANGLES
from renderer.scene.parts import used_vertices
from renderer.scene.reading import check_count, size_text

# The types of accessors that primitives may name.
TYPES = {
    "POSITION": ("VEC3",),
    "NORMAL": ("VEC3",),
    "COLOR_0": ("VEC3", "VEC4"),
    "indices": ("SCALAR",),
}
Key = tuple[int, int]  # of a primitive: its mesh, its number in it


def same_primitives(tree: Gltf, shown: Iterable[Key], is_mapped: bool) -> dict[Key, Key]:
    """Return for each primitive that is shown the first one with the same numbers.

    is_mapped: as in read_gltf().
    """
    first: dict[tuple[Any, ...], Key] = {}
    same = {}
    for key in sorted(set(shown)):
        primitive = tree.meshes[key[0]].primitives[key[1]]
        sources = [*_sources(tree, key).values(), coordinates_of(tree, primitive, is_mapped)]
        numbers = (primitive.mode, *(_numbers(tree, source) for source in sources))
        same[key] = first.setdefault(numbers, key)
    return same


def _sources(tree: Gltf, key: Key) -> dict[str, int | None]:
    """Return a primitive's accessors by their names in TYPES."""
    primitive = tree.meshes[key[0]].primitives[key[1]]
    found: dict[str, int | None] = {n: primitive.attributes.get(n) for n in TYPES}
    return found | {"indices": primitive.indices}


def _numbers(tree: Gltf, source: int | None) -> Any:
    """Return the key of an accessor's numbers. An illegal accessor is reported elsewhere."""
    if source is None or source >= len(tree.accessors):
        return source
    a = tree.accessors[source]
    sparse = repr(a.sparse)
    return a.buffer_view, a.byte_offset, a.count, a.component_type, a.type, a.normalized, sparse


def check_size(tree: Gltf, shown: list[Key], keys: list[Key]) -> None:
    """Raise LucidaError if a file shows too many triangles, or if its accessors together name far
    more bytes than its buffers have.

    shown: the primitive of each instance.
    keys: those of which no two have the same numbers.
    """
    triangles = {}
    for key in set(shown):
        primitive = tree.meshes[key[0]].primitives[key[1]]
        sources = _sources(tree, key)
        source = sources["POSITION"] if primitive.indices is None else primitive.indices
        corners = entry_at(tree.accessors, source or 0, "accessors").count
        is_list = primitive.mode == TRIANGLE_LIST
        triangles[key] = corners // 3 if is_list else max(corners - 2, 0)
    check_count(sum(triangles[key] for key in shown), TRIANGLES, "triangles")
    named = {source for key in keys for source in _sources(tree, key).values()}
    accessors = [entry_at(tree.accessors, k, "accessors") for k in named if k is not None]
    size = sum(accessor.count * item_bytes(accessor) for accessor in accessors)
    there = sum(buffer.byte_length for buffer in tree.buffers)
    if size > there + SHARED_BYTES:
        problem = f"name {size_text(size)} of buffers of {size_text(there)}"
        remedy = "give each its own part of a buffer; export it again"
        raise LucidaError("accessors", problem, remedy)


def compacted(fields: dict[str, Any]) -> dict[str, Any]:
    """Return a part's fields with only the vertices that its faces use: of primitives that share
    one large list of vertices, each uses few.
    """
    count, faces = len(fields["vertices"]), fields["faces"]
    if not len(faces) or faces.min() < 0 or faces.max() >= count:
        return fields  # reported elsewhere
    source, faces = used_vertices(faces)
    per_vertex = {
        name: fields[name][source]
        for name in ("vertices", "normals", "vertex_colors", "uv")
        if fields[name] is not None and len(fields[name]) == count
    }
    return fields | per_vertex | {"faces": faces}
