"""The numbers of a glTF file: its accessors as arrays, its primitives as triangles.

Owns whether every range that an accessor names lies inside the file. Knows nothing of what the
numbers mean.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.gltf_file import (
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    Accessor,
    Gltf,
    GltfBuffers,
    Index,
    entry_at,
    invalid,
)
from renderer.scene.limits import BINARY_MODEL_BYTES
from renderer.scene.reading import size_text

COMPONENT_TYPES: dict[int, np.dtype[Any]] = {
    5120: np.dtype("i1"),
    5121: np.dtype("u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class SparsePart(msgspec.Struct, rename="camel"):
    buffer_view: Index
    byte_offset: Index = 0
    component_type: int = 0  # of the indices


class Sparse(msgspec.Struct, rename="camel"):
    count: Index
    indices: SparsePart
    values: SparsePart


def item_bytes(accessor: Accessor) -> int:
    return COMPONENT_TYPES[accessor.component_type].itemsize * COMPONENTS[accessor.type]


def read_numbers(
    tree: Gltf, number: int, buffers: GltfBuffers, types: tuple[str, ...], field: str
) -> NDArray[Any]:
    """Return the numbers of an accessor, (count, components), of the file's own type; sparse ones
    are put in. types: those that are wanted. field: what names it. Raises LucidaError."""
    accessor: Accessor = entry_at(tree.accessors, number, field)
    field = f"accessors[{number}]"
    check_accessor(accessor, buffers, types, field)
    if accessor.buffer_view is not None:
        found = _in_view(accessor, buffers, field)
    elif accessor.sparse is not None:
        if accessor.count * item_bytes(accessor) > BINARY_MODEL_BYTES:
            raise LucidaError(field, f"declares {accessor.count} elements", "split the model")
        shape = accessor.count, COMPONENTS[accessor.type]
        found = np.zeros(shape, COMPONENT_TYPES[accessor.component_type])
    else:
        raise LucidaError(field, "has no bufferView", "export it uncompressed")
    return found if accessor.sparse is None else _with_sparse(found, accessor, buffers, field)


def check_accessor(
    accessor: Accessor, buffers: GltfBuffers, types: tuple[str, ...], field: str
) -> None:
    """Raise LucidaError for an accessor of a type that is not wanted, or unknown, and where its
    elements do not lie inside its buffer view."""
    if accessor.type not in types or accessor.component_type not in COMPONENT_TYPES:
        problem = f"is {accessor.type[:20]} of type {accessor.component_type}"
        raise LucidaError(field, problem, "export it again")
    if accessor.buffer_view is None:
        return
    view, item = buffers.declared(accessor.buffer_view, field), item_bytes(accessor)
    stride = view.byte_stride or item
    if stride < item:
        raise LucidaError(
            f"bufferViews[{accessor.buffer_view}].byteStride",
            f"{stride} is below the {item} bytes of an element",
            "export it again",
        )
    need = accessor.byte_offset + max(accessor.count - 1, 0) * stride + item
    if accessor.count < 1 or need > view.byte_length:
        raise LucidaError(
            field,
            f"declares {accessor.count} elements, {need} bytes, in a view of {view.byte_length}",
            "it is damaged; export it again",
        )


def _in_view(accessor: Accessor, buffers: GltfBuffers, field: str) -> NDArray[Any]:
    """Return the elements of an accessor that lie in its buffer view."""
    data, view = buffers.view(accessor.buffer_view, field)
    dtype = COMPONENT_TYPES[accessor.component_type]
    strides = view.byte_stride or item_bytes(accessor), dtype.itemsize
    shape = accessor.count, COMPONENTS[accessor.type]
    return np.ndarray(shape, dtype, data, accessor.byte_offset, strides)


def _with_sparse(
    found: NDArray[Any], accessor: Accessor, buffers: GltfBuffers, field: str
) -> NDArray[Any]:
    field = f"{field}.sparse"
    try:
        sparse = msgspec.convert(accessor.sparse, Sparse)
    except msgspec.ValidationError as error:
        wrong = invalid(error)
        raise LucidaError(
            f"{field}.{wrong.field}".strip("."), wrong.problem, wrong.remedy
        ) from None
    parts = []
    for name, part, kind, component in (
        ("indices", sparse.indices, "SCALAR", sparse.indices.component_type),
        ("values", sparse.values, accessor.type, accessor.component_type),
    ):
        of = Accessor(component, sparse.count, kind, part.buffer_view, part.byte_offset)
        check_accessor(of, buffers, (kind,), f"{field}.{name}")
        parts.append(_in_view(of, buffers, f"{field}.{name}"))
    places = whole_numbers(parts[0], f"{field}.indices")
    if places.max() >= len(found):
        problem = f"names element {places.max()}, counted from 0, of {len(found)}"
        raise LucidaError(f"{field}.indices", problem, "export it again")
    found = found.copy()
    found[places] = parts[1]
    return found


def whole_numbers(found: NDArray[Any], field: str) -> NDArray[np.int64]:
    """Return indices (n,). Raises LucidaError where they are no unsigned whole numbers."""
    if found.dtype.kind != "u":
        raise LucidaError(field, f"are of type {found.dtype}", "export it again")
    return found[:, 0].astype(np.int64)


def triangles_of(corners: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    """Return the triangles (m, 3) of a list, strip or fan of vertices, counter-clockwise from the
    front, without those that repeat a vertex, by which strips are joined."""
    if mode == TRIANGLE_LIST:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.zeros((0, 3), np.int64)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == TRIANGLE_FAN:
        faces = np.stack([second, third, np.broadcast_to(corners[0], second.shape)], axis=1)
    else:
        # Every other triangle of a strip goes the other way round.
        odd = np.arange(len(first)) % 2 == 1
        faces = np.stack(
            [first, np.where(odd, third, second), np.where(odd, second, third)], axis=1
        )
    a, b, c = faces.T
    return faces[(a != b) & (b != c) & (c != a)]


def check_sizes(tree: Gltf, used: list[int]) -> tuple[int, int, int]:
    """Return how many bytes the buffer views of accessors, these accessors, and the buffers have.
    Raises LucidaError where the views hold too much."""
    entries = [tree.accessors[number] for number in used]
    views = {entry.buffer_view for entry in entries if entry.buffer_view is not None}
    found = [entry_at(tree.buffer_views, number, "bufferViews") for number in views]
    total = sum(view.byte_length for view in found)
    if total > 2 * BINARY_MODEL_BYTES:
        raise LucidaError("bufferViews", f"hold {size_text(total)}", "split the model")
    items = sum(item_bytes(entry) * entry.count for entry in entries)
    buffers = {view.buffer for view in found}
    there = sum(entry_at(tree.buffers, number, "buffers").byte_length for number in buffers)
    return total, items, there
