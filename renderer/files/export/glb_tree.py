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

from lucida.renderer.files.export.meshes import Triangles

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
    """The parts of the tree that nodes share, by their names in glTF, and the binary chunk."""

    def __init__(self) -> None:
        self.chunk = bytearray()
        names = "meshes materials textures images samplers accessors bufferViews"
        self._tables: dict[str, list[dict[str, Any]]] = {name: [] for name in names.split()}
        self._materials: dict[str, int] = {}  # their numbers, by their JSON
        # Cached: equal inputs share a result.
        self.primitive = functools.cache(self._primitive)
        self.texture = functools.cache(self._texture)

    def _primitive(
        self, make: Callable[..., Triangles], *inputs: Hashable
    ) -> dict[str, dict[str, int] | int]:
        """Return the attributes and indices of the triangles make(*inputs)."""
        found = make(*inputs)
        attributes = {"POSITION": self._vertices(found.vertices)}
        low, high = found.vertices.min(axis=0).tolist(), found.vertices.max(axis=0).tolist()
        self._tables["accessors"][-1] |= {"min": low, "max": high}
        for name, values in (
            ("NORMAL", found.normals),
            ("COLOR_0", found.colors),
            ("TEXCOORD_0", found.uv),
        ):
            if values is not None:
                attributes[name] = self._vertices(values)
        corners = found.faces.astype("<u4").reshape(-1)
        indices = self._accessor(corners, "SCALAR", UNSIGNED_INT, INDICES)
        return {"attributes": attributes, "indices": indices}

    def mesh(self, primitive: dict[str, Any], material: dict[str, Any], name: str) -> int:
        materials = self._tables["materials"]
        number = self._materials.setdefault(json.dumps(material), len(materials))
        if number == len(materials):
            materials.append(material)
        primitive = primitive | {"material": number}
        return self._add("meshes", {"primitives": [primitive]} | ({"name": name} if name else {}))

    def _texture(self, png: bytes, *sampler: int) -> int:
        """Add a picture and its sampler, the values of SAMPLER. Return the texture's number."""
        table, samplers = dict(zip(SAMPLER, sampler, strict=True)), self._tables["samplers"]
        if table not in samplers:
            samplers.append(table)
        image = {"bufferView": self._view(png), "mimeType": "image/png"}
        source = self._add("images", image)
        return self._add("textures", {"source": source, "sampler": samplers.index(table)})

    def tables(self) -> dict[str, Any]:
        """Return the lists that are not empty: glTF does not allow empty ones."""
        buffers = [{"byteLength": len(self.chunk)}] if self.chunk else []
        lists = self._tables | {"buffers": buffers}
        return {name: entries for name, entries in lists.items() if entries}

    def _add(self, kind: str, table: dict[str, Any]) -> int:
        self._tables[kind].append(table)
        return len(self._tables[kind]) - 1

    def _view(self, data: bytes, **more: int) -> int:
        view = {"buffer": 0, "byteOffset": len(self.chunk), "byteLength": len(data), **more}
        self.chunk += data + b"\0" * (-len(data) % 4)
        return self._add("bufferViews", view)

    def _vertices(self, values: NDArray[np.float32]) -> int:
        kind = f"VEC{values.shape[1]}"
        return self._accessor(values.astype("<f4"), kind, FLOAT, VERTICES)

    def _accessor(self, values: NDArray[Any], type: str, component: int, target: int) -> int:
        return self._add(
            "accessors",
            {
                "bufferView": self._view(values.tobytes(), target=target),
                "componentType": component,
                "count": len(values),
                "type": type,
            },
        )
