"""The numbers of a glTF file: its accessors as arrays, its primitives as triangles.

Every range that an accessor names is checked against the file.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.gltf_file import (
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    Accessor,
    OpenGltf,
    entry_at,
)
from lucida.renderer.system.errors import LucidaError

COMPONENT_TYPES: dict[int, np.dtype[Any]] = {
    5120: np.dtype("i1"),
    5121: np.dtype("u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def read_numbers(file: OpenGltf, number: int, types: tuple[str, ...], field: str) -> NDArray[Any]:
    """Return the numbers of an accessor, (count, components), of the file's own type.

    types: the allowed ones.
    field: what names the accessor.
    Raises LucidaError.
    """
    accessor: Accessor = entry_at(file.tree.accessors, number, field)
    field = f"accessors[{number}]"
    kind = COMPONENT_TYPES.get(accessor.component_type)
    if accessor.type not in types or kind is None:
        problem = f"is {accessor.type[:20]} of type {accessor.component_type}"
        raise LucidaError(field, problem, "export it again")
    if accessor.sparse is not None:
        raise LucidaError(field, "is sparse, which is not read", "export it without")
    data, stride = file.view(accessor.buffer_view, field)
    shape = accessor.count, COMPONENTS[accessor.type]
    strides = stride or shape[1] * kind.itemsize, kind.itemsize
    try:
        return np.ndarray(shape, kind, data, accessor.byte_offset, strides)
    except (TypeError, ValueError):  # NumPy compares them with the buffer
        problem = f"declares {accessor.count} elements in a view of {len(data)} bytes"
        raise LucidaError(field, problem, "it is damaged; export it again") from None


def scaled(found: NDArray[Any], file: OpenGltf, number: int) -> NDArray[Any]:
    """Return the numbers of an accessor as it means them: normalized ones as fractions."""
    if found.dtype.kind not in "ui" or not file.tree.accessors[number].normalized:
        return found
    return np.maximum(found / np.iinfo(found.dtype).max, -1).astype(np.float32)


def whole_numbers(found: NDArray[Any], field: str) -> NDArray[np.int64]:
    """Return indices (n,). Raises LucidaError unless they are unsigned whole numbers."""
    if found.dtype.kind != "u":
        raise LucidaError(field, f"are of type {found.dtype}", "export it again")
    return found[:, 0].astype(np.int64)


def triangles_of(corners: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    """Return the triangles (m, 3) of a list, strip or fan of vertices, counter-clockwise from the
    front. Those that repeat a vertex only join strips: they have no area.
    """
    if mode == TRIANGLE_LIST:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == TRIANGLE_FAN:
        return np.stack([second, third, np.broadcast_to(corners[:1], second.shape)], axis=1)
    faces = np.stack([first, second, third], axis=1)
    faces[1::2, 1:] = faces[1::2, :0:-1]  # every other one goes the other way round
    return faces
