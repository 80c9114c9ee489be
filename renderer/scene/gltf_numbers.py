"""The numbers of a glTF file: its accessors as arrays, its primitives as triangles.

Every range that an accessor names is checked against the file.
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
    Index,
    OpenGltf,
    entry_at,
    invalid,
)
from renderer.scene.limits import BINARY_MODEL_BYTES

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


def read_numbers(file: OpenGltf, number: int, types: tuple[str, ...], field: str) -> NDArray[Any]:
    """Return the numbers of an accessor, (count, components), of the file's own type.

    types: the allowed ones.
    field: what names the accessor.
    Raises LucidaError.
    """
    accessor: Accessor = entry_at(file.tree.accessors, number, field)
    field = f"accessors[{number}]"
    if accessor.buffer_view is not None or accessor.sparse is None:
        found = _in_view(file, accessor, types, field)
    else:
        _check_accessor(file, accessor, types, field)
        if accessor.count * item_bytes(accessor) > BINARY_MODEL_BYTES:
            raise LucidaError(field, f"declares {accessor.count} elements", "split the model")
        shape = accessor.count, COMPONENTS[accessor.type]
        found = np.zeros(shape, COMPONENT_TYPES[accessor.component_type])
    return found if accessor.sparse is None else _with_sparse(file, found, accessor, field)


def item_bytes(accessor: Accessor) -> int:
    """Return the bytes of an element; 0 for a type that is not known, which is reported later."""
    kind = COMPONENT_TYPES.get(accessor.component_type)
    return 0 if kind is None else kind.itemsize * COMPONENTS.get(accessor.type, 0)


def _check_accessor(file: OpenGltf, accessor: Accessor, types: tuple[str, ...], field: str) -> None:
    """Raise LucidaError for an accessor of another type, or with elements outside its view."""
    if accessor.type not in types or accessor.component_type not in COMPONENT_TYPES:
        problem = f"is {accessor.type[:20]} of type {accessor.component_type}"
        raise LucidaError(field, problem, "export it again")
    if accessor.buffer_view is None:
        return
    view, item = file.declared(accessor.buffer_view, field), item_bytes(accessor)
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


def _in_view(
    file: OpenGltf, accessor: Accessor, types: tuple[str, ...], field: str
) -> NDArray[Any]:
    """Return the elements of an accessor in its buffer view."""
    _check_accessor(file, accessor, types, field)
    data = file.view(accessor.buffer_view, field)
    dtype, stride = COMPONENT_TYPES[accessor.component_type], item_bytes(accessor)
    stride = file.declared(accessor.buffer_view, field).byte_stride or stride
    shape = accessor.count, COMPONENTS[accessor.type]
    return np.ndarray(shape, dtype, data, accessor.byte_offset, (stride, dtype.itemsize))


def _with_sparse(
    file: OpenGltf, found: NDArray[Any], accessor: Accessor, field: str
) -> NDArray[Any]:
    """Return the numbers with the sparse accessor's own in their places."""
    field = f"{field}.sparse"
    try:
        sparse = msgspec.convert(accessor.sparse, Sparse)
    except msgspec.ValidationError as error:
        raise invalid(error).within(field) from None
    parts = []
    for name, part, kind, component in (
        ("indices", sparse.indices, "SCALAR", sparse.indices.component_type),
        ("values", sparse.values, accessor.type, accessor.component_type),
    ):
        of = Accessor(component, sparse.count, kind, part.buffer_view, part.byte_offset)
        parts.append(_in_view(file, of, (kind,), f"{field}.{name}"))
    places = whole_numbers(parts[0], f"{field}.indices")
    if places.max() >= len(found):
        problem = f"names element {places.max()}, counted from 0, of {len(found)}"
        raise LucidaError(f"{field}.indices", problem, "export it again")
    found = found.copy()
    found[places] = parts[1]
    return found


def scaled(found: NDArray[Any], file: OpenGltf, number: int) -> NDArray[Any]:
    """Return the numbers of an accessor as it means them: normalized ones as fractions."""
    if found.dtype.kind not in "ui" or not file.tree.accessors[number].normalized:
        return found
    return np.maximum(found / np.iinfo(found.dtype).max, -1)


def whole_numbers(found: NDArray[Any], field: str) -> NDArray[np.int64]:
    """Return indices (n,). Raises LucidaError unless they are unsigned whole numbers."""
    if found.dtype.kind != "u":
        raise LucidaError(field, f"are of type {found.dtype}", "export it again")
    return found[:, 0].astype(np.int64)


def triangles_of(corners: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    """Return the triangles (m, 3) of a list, strip or fan of vertices, counter-clockwise from the
    front, without those that repeat a vertex, which only join strips.
    """
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
