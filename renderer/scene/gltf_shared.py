"""The parts that a glTF file names several times: built once if possible, refused if too much.

A few bytes of JSON can show one buffer a thousand times.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.gltf_file import TRIANGLE_LIST, Accessor, Gltf, OpenGltf, entry_at
from renderer.scene.gltf_numbers import check_accessor, item_bytes
from renderer.scene.gltf_textures import coordinates_of
from renderer.scene.limits import (
    BINARY_MODEL_BYTES,
    MADE_TRIANGLES,
    SHARED_BYTES,
    SHARED_VERTICES,
    TRIANGLES,
)
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


def check_triangles(tree: Gltf, shown: list[Key], keys: list[Key]) -> None:
    """Raise LucidaError if a file shows too much, in all or by repeating its numbers.

    shown: the primitive of each instance.
    keys: those of which no two have the same numbers.
    """

    def count(source: int) -> int:
        accessor: Accessor = entry_at(tree.accessors, source, "accessors")
        return accessor.count

    counts = {}
    for mesh, number in set(shown):
        primitive = tree.meshes[mesh].primitives[number]
        position = primitive.attributes["POSITION"]
        source = position if primitive.indices is None else primitive.indices
        corners = count(source)
        triangles = corners // 3 if primitive.mode == TRIANGLE_LIST else max(corners - 2, 0)
        counts[mesh, number] = triangles, _numbers(tree, source)
    total = sum(counts[key][0] for key in shown)
    check_count(total, TRIANGLES, "triangles")
    stored = sum({counts[key][1]: counts[key][0] for key in keys}.values())
    if total - stored > MADE_TRIANGLES:
        raise LucidaError(
            "",
            f"makes {total} triangles by repeating the {stored} that it holds",
            f"stay within {MADE_TRIANGLES} repeated ones: fewer copies, or a coarser mesh",
        )
    vertices = sum(count(tree.meshes[m].primitives[p].attributes["POSITION"]) for m, p in keys)
    if len(keys) > 1 and vertices > SHARED_VERTICES:
        raise LucidaError(
            "",
            f"has {len(keys)} primitives that name {vertices} vertices",
            f"stay within {SHARED_VERTICES}: join primitives, or give each its own vertices",
        )


def check_accessors(file: OpenGltf, keys: list[Key]) -> None:
    """Raise LucidaError if the primitives name accessors that are illegal, or that together name
    far more bytes than the buffers have.
    """
    tree = file.tree
    used: dict[int, Accessor] = {}
    for key in keys:
        for name, source in _sources(tree, key).items():
            if source is not None:
                where = name if name == "indices" else f"attributes.{name}"
                field = f"meshes[{key[0]}].primitives[{key[1]}].{where}"
                used[source] = entry_at(tree.accessors, source, field)
                check_accessor(file, used[source], TYPES[name], f"accessors[{source}]")
    numbers = {a.buffer_view for a in used.values() if a.buffer_view is not None}
    views = [tree.buffer_views[number] for number in numbers]
    named = sum(view.byte_length for view in views)
    if named > 2 * BINARY_MODEL_BYTES:
        raise LucidaError("bufferViews", f"hold {size_text(named)}", "split the model")
    there = sum(tree.buffers[number].byte_length for number in {view.buffer for view in views})
    items = sum(item_bytes(accessor) * accessor.count for accessor in used.values())
    for field, size in (("bufferViews", named), ("accessors", items)):
        if size > there + SHARED_BYTES:
            problem = f"name {size_text(size)} of buffers of {size_text(there)}"
            raise LucidaError(field, problem, "give each its own part of a buffer; export it again")


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
