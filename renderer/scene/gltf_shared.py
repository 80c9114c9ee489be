"""The parts that a glTF file names several times: made once if possible, refused if too much.

A few bytes of JSON can show one buffer a thousand times.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.gltf_file import TRIANGLE_LIST, Gltf, entry_at
from renderer.scene.gltf_textures import coordinates_of
from renderer.scene.limits import MADE_TRIANGLES, SHARED_BYTES, SHARED_VERTICES, TRIANGLES
from renderer.scene.reading import size_text

ATTRIBUTES = ("POSITION", "NORMAL", "COLOR_0")
Key = tuple[int, int]  # of a primitive: its mesh, its number in it


def same_primitives(tree: Gltf, shown: Iterable[Key], is_mapped: bool) -> dict[Key, Key]:
    """For each primitive that is shown the first one that has the same numbers. is_mapped: as
    read_gltf() takes it."""
    first: dict[tuple[Any, ...], Key] = {}
    same = {}
    for key in sorted(set(shown)):
        primitive = tree.meshes[key[0]].primitives[key[1]]
        sources = [*map(primitive.attributes.get, ATTRIBUTES), primitive.indices]
        sources.append(coordinates_of(tree, primitive, is_mapped))
        numbers = (primitive.mode, *(_numbers(tree, source) for source in sources))
        same[key] = first.setdefault(numbers, key)
    return same


def _numbers(tree: Gltf, source: int | None) -> Any:
    """Return the key of an accessor's numbers. An illegal accessor is reported elsewhere."""
    if source is None or source >= len(tree.accessors):
        return source
    a = tree.accessors[source]
    sparse = repr(a.sparse)
    return a.buffer_view, a.byte_offset, a.count, a.component_type, a.type, a.normalized, sparse


def check_triangles(tree: Gltf, shown: list[Key], keys: list[Key]) -> None:
    """Raises LucidaError where a file shows too much, in all or by repeating its numbers.

    shown: the primitive of each instance. keys: those of which no two have the same numbers.
    """
    counts = {}
    for mesh, number in set(shown):
        primitive = tree.meshes[mesh].primitives[number]
        position = primitive.attributes["POSITION"]
        source = position if primitive.indices is None else primitive.indices
        count = entry_at(tree.accessors, source, "accessors").count
        triangles = count // 3 if primitive.mode == TRIANGLE_LIST else max(count - 2, 0)
        counts[mesh, number] = triangles, _numbers(tree, source)
    total = sum(counts[key][0] for key in shown)
    if total > TRIANGLES:
        raise LucidaError("", f"has {total} triangles", f"stay within {TRIANGLES}")
    stored = sum({counts[key][1]: counts[key][0] for key in keys}.values())
    if total - stored > MADE_TRIANGLES:
        raise LucidaError(
            "",
            f"makes {total} triangles by repeating the {stored} that it holds",
            f"stay within {MADE_TRIANGLES} repeated ones: fewer copies, or a coarser mesh",
        )
    positions = [tree.meshes[m].primitives[p].attributes["POSITION"] for m, p in keys]
    vertices = sum(entry_at(tree.accessors, source, "accessors").count for source in positions)
    if len(keys) > 1 and vertices > SHARED_VERTICES:
        raise LucidaError(
            "",
            f"has {len(keys)} primitives that name {vertices} vertices",
            f"stay within {SHARED_VERTICES}: join primitives, or give each its own vertices",
        )


def compacted(fields: dict[str, Any]) -> dict[str, Any]:
    """Return a part's fields with only the vertices that its faces use: where primitives share one
    large list of vertices, each has few of them."""
    vertices, faces = fields["vertices"], fields["faces"]
    if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
        return fields  # which is told elsewhere
    used = np.zeros(len(vertices), bool)
    used[faces] = True
    per_vertex = {
        name: fields[name][used]
        for name in ("vertices", "normals", "vertex_colors", "uv")
        if fields.get(name) is not None and len(fields[name]) == len(vertices)
    }
    return fields | per_vertex | {"faces": (np.cumsum(used) - 1)[faces]}


def check_bytes_shared(views_bytes: int, items_bytes: int, there_bytes: int) -> None:
    """Raises LucidaError where views, or accessors, name far more bytes than the buffers have."""
    for field, named in (("bufferViews", views_bytes), ("accessors", items_bytes)):
        if named > there_bytes + SHARED_BYTES:
            raise LucidaError(
                field,
                f"name {size_text(named)} of buffers of {size_text(there_bytes)}",
                "give each its own part of a buffer; export it again",
            )
