"""A builder for a glTF tree with its binary chunk, and a writer for both as a .glb file.

Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Hashable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from renderer.scene_export.meshes import Triangles

FLOAT, UNSIGNED_INT = 5126, 5125
VERTICES, INDICES = 34962, 34963  # targets of a buffer view
SAMPLER = "magFilter", "minFilter", "wrapS", "wrapT"


def glb_bytes(tree: dict[str, Any], binary: bytes) -> bytes:
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = [(b"JSON", text), *([(b"BIN\0", binary)] if binary else [])]
    length = 12 + sum(8 + len(data) for _, data in chunks)
    parts = [b"glTF", (2).to_bytes(4, "little"), length.to_bytes(4, "little")]
    for kind, data in chunks:
        parts += [len(data).to_bytes(4, "little"), kind, data]
    return b"".join(parts)


class GlbTree:
    """The parts of the tree that nodes share, and the binary chunk."""

    def __init__(self) -> None:
        self._chunk: list[bytes] = []
        self._bytes = 0
        self._views: list[dict[str, int]] = []
        self._accessors: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._materials: list[dict[str, Any]] = []
        self._material_numbers: dict[str, int] = {}
        self._images: list[dict[str, Any]] = []
        self._samplers: list[dict[str, int]] = []
        self._sampler_of: list[int] = []  # each image's
        # Cached: equal inputs share a result.
        self.primitive = functools.cache(self._primitive)
        self.texture = functools.cache(self._texture)

    def _primitive(
        self, make: Callable[..., Triangles], *inputs: Hashable
    ) -> dict[str, dict[str, int] | int]:
        """Return the attributes and indices of the triangles make(*inputs)."""
        found = make(*inputs)
        attributes = {"POSITION": self._vectors(found.vertices, bounds=True)}
        if found.normals is not None:
            attributes["NORMAL"] = self._vectors(found.normals)
        if found.colors is not None:
            attributes["COLOR_0"] = self._vectors(found.colors)
        if found.uv is not None:
            uv = found.uv.astype("<f4")
            attributes["TEXCOORD_0"] = self._accessor(uv, "VEC2", FLOAT, VERTICES)
        corners = found.faces.astype("<u4").reshape(-1)
        indices = self._accessor(corners, "SCALAR", UNSIGNED_INT, INDICES)
        return {"attributes": attributes, "indices": indices}

    def mesh(self, primitive: dict[str, Any], material: int, name: str) -> int:
        primitive = primitive | {"material": material}
        self._meshes.append({"primitives": [primitive]} | ({"name": name} if name else {}))
        return len(self._meshes) - 1

    def material(self, table: dict[str, Any]) -> int:
        number = self._material_numbers.setdefault(json.dumps(table), len(self._materials))
        if number == len(self._materials):
            self._materials.append(table)
        return number

    def _texture(self, png: bytes, *sampler: int) -> int:
        """Add a picture and its sampler, the values of SAMPLER. Return their number."""
        table = dict(zip(SAMPLER, sampler, strict=True))
        if table not in self._samplers:
            self._samplers.append(table)
        self._sampler_of.append(self._samplers.index(table))
        view = {"buffer": 0, "byteOffset": self._bytes, "byteLength": len(png)}
        self._append(png + b"\0" * (-len(png) % 4), view)
        self._images.append({"bufferView": len(self._views) - 1, "mimeType": "image/png"})
        return len(self._images) - 1

    def tables(self) -> dict[str, Any]:
        """Return the lists that are not empty: glTF does not allow empty ones."""
        lists = {
            "meshes": self._meshes,
            "materials": self._materials,
            "textures": [{"source": n, "sampler": s} for n, s in enumerate(self._sampler_of)],
            "images": self._images,
            "samplers": self._samplers,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._bytes}] if self._bytes else [],
        }
        return {name: entries for name, entries in lists.items() if entries}

    def chunk(self) -> bytes:
        return b"".join(self._chunk)

    def _append(self, data: bytes, view: dict[str, int]) -> None:
        self._views.append(view)
        self._chunk.append(data)
        self._bytes += len(data)

    def _vectors(self, values: NDArray[np.float32], bounds: bool = False) -> int:
        number = self._accessor(values.astype("<f4"), "VEC3", FLOAT, VERTICES)
        if bounds:
            limits = {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
            self._accessors[number] |= limits
        return number

    def _accessor(self, values: NDArray[Any], type: str, component: int, target: int) -> int:
        data = values.tobytes()  # four bytes each, so the chunk stays aligned
        view = {"buffer": 0, "byteOffset": self._bytes, "byteLength": len(data), "target": target}
        self._append(data, view)
        self._accessors.append(
            {
                "bufferView": len(self._views) - 1,
                "componentType": component,
                "count": len(values),
                "type": type,
            }
        )
        return len(self._accessors) - 1
