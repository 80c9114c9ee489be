"""A builder for a glTF tree with its binary chunk, and a writer for both as a .glb file.

Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.gltf_file import glb_bytes
from lucida.renderer.images.png import png_of

FLOAT, UNSIGNED_INT = 5126, 5125
LINEAR = 9729  # a filter


class GlbTree:
    """The lists of the tree, by their names in glTF, and the binary chunk. Equal entries and equal
    bytes are written once.
    """

    def __init__(self) -> None:
        self._lists: dict[str, list[dict[str, Any]]] = {}
        self._known: dict[tuple[str, str], int] = {}
        self._views: dict[bytes, int] = {}
        self._chunk = bytearray()

    def add(self, kind: str, table: dict[str, Any]) -> int:
        """Return the number of an entry of one of the lists."""
        entries = self._lists.setdefault(kind, [])
        number = self._known.setdefault((kind, json.dumps(table)), len(entries))
        if number == len(entries):
            entries.append(table)
        return number

    def accessor(self, values: NDArray[Any], has_bounds: bool = False) -> int:
        """Return the number of an array: float32 (n, components), or vertices' numbers (n,)."""
        is_float = values.ndim == 2
        table: dict[str, Any] = {
            "bufferView": self._view(values.astype("<f4" if is_float else "<u4").tobytes()),
            "componentType": FLOAT if is_float else UNSIGNED_INT,
            "count": len(values),
            "type": f"VEC{values.shape[1]}" if is_float else "SCALAR",
        }
        if has_bounds:
            table |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        return self.add("accessors", table)

    def texture(self, texels: NDArray[np.uint8], wrap_s: int, wrap_t: int) -> dict[str, int]:
        """Return a textureInfo of an image."""
        image = {"bufferView": self._view(png_of(texels)), "mimeType": "image/png"}
        source = self.add("images", image)
        filters = {"magFilter": LINEAR, "minFilter": LINEAR}
        sampler = self.add("samplers", {**filters, "wrapS": wrap_s, "wrapT": wrap_t})
        return {"index": self.add("textures", {"source": source, "sampler": sampler})}

    def glb(self, tree: dict[str, Any]) -> bytes:
        """Return the file. tree: its parts apart from the lists."""
        if self._chunk:
            tree = tree | {"buffers": [{"byteLength": len(self._chunk)}]}
        return glb_bytes(tree | self._lists, bytes(self._chunk))

    def _view(self, data: bytes) -> int:
        if data not in self._views:
            view = {"buffer": 0, "byteOffset": len(self._chunk), "byteLength": len(data)}
            self._views[data] = self.add("bufferViews", view)
            self._chunk += data + b"\0" * (-len(data) % 4)
        return self._views[data]
