"""glTF trees made of arrays."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np

from lucida.renderer.files import load_scene
from lucida.renderer.scene import Scene

CODES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")
TRIANGLE = {"POSITION": CORNERS, "indices": np.arange(3, dtype="<u2")}


def gltf(*primitives: dict[str, Any], blobs: tuple[bytes, ...] = (), **changes: Any) -> dict:
    """Return a tree of one mesh at one node.

    primitives: arrays by attribute, "indices", "mode", "material". An array that is in several is
    one accessor; equal ones are several accessors to the same bytes.
    blobs: the content of further buffer views.
    changes: other entries of the tree.
    """
    data, views, accessors = b"", [], []
    known = {}

    def view_of(part, **more):
        nonlocal data
        if (at := data.find(part)) < 0:
            data += bytes(-len(data) % 4)
            at, data = len(data), data + part
        view = {"buffer": 0, "byteOffset": at, "byteLength": len(part)} | more
        if view not in views:
            views.append(view)
        return views.index(view)

    made = []
    for primitive in primitives or (TRIANGLE,):
        attributes = {}
        entry = {"attributes": attributes}
        for name, value in primitive.items():
            if isinstance(value, np.ndarray):
                if id(value) not in known:
                    rows = value.reshape(len(value), -1)
                    gap = -rows.shape[1] * rows.itemsize % 4 if name != "indices" else 0
                    stride = {"byteStride": rows.shape[1] * rows.itemsize + gap} if gap else {}
                    padded = np.pad(rows, ((0, 0), (0, gap // rows.itemsize)))
                    known[id(value)] = len(accessors)
                    accessors.append(
                        {
                            "bufferView": view_of(padded.tobytes(), **stride),
                            "componentType": CODES[value.dtype.str[1:]],
                            "count": len(value),
                            "type": TYPES[rows.shape[1]],
                            "normalized": name != "indices" and value.dtype.kind in "iu",
                        }
                    )
                value = known[id(value)]
            (entry if name in ("indices", "mode", "material") else attributes)[name] = value
        made.append(entry)
    for blob in blobs:
        view_of(blob)
    data += bytes(-len(data) % 4)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "node"}],
        "meshes": [{"primitives": made}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": uri}],
    } | changes


def load_gltf(tree: dict, folder: Path) -> Scene:
    (folder / "t.gltf").write_text(json.dumps(tree))
    return load_scene(folder / "t.gltf")
