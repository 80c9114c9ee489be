"""glTF files that are wrong, or mean harm: refused in one line."""

from __future__ import annotations

import base64
import copy
import json
import struct
from pathlib import Path
from typing import Any

import pytest
from gltf_files import gltf
from test_scene_hostile import refusal, write

TREE = gltf(nodes=[{"mesh": 0}], scene=0)
BUFFER = base64.b64decode(TREE["buffers"][0]["uri"].partition(",")[2])


def changed(changes: dict[str, Any]) -> dict[str, Any]:
    """Return TREE with the entries at some paths replaced, or removed where the value is None."""
    tree = copy.deepcopy(TREE)
    for path, value in changes.items():
        *parents, last = (int(key) if key.isdigit() else key for key in path.split("."))
        entry = tree
        for key in parents:
            entry = entry[key]
        if value is None:
            del entry[last]
        else:
            entry[last] = value
    return tree


OUTSIDE = "is not in the folder of what names it"
GLTF_MISTAKES: list[tuple[dict[str, Any], str]] = [
    (
        {"nodes": [{"mesh": 0, "children": [1]}, {"children": [0]}]},
        "nodes[0]: has two parents, or is",
    ),
    ({"nodes": [{"children": [7]}]}, "nodes: names entry 7, counted from 0, of 1"),
    ({"nodes": [{"mesh": 7}]}, "nodes[0].mesh: names entry 7"),
    ({"nodes": [{}]}, "holds no triangle"),
    ({"nodes": [{"mesh": 0, "scale": [0, 1, 1]}]}, "holds no triangle"),
    ({"nodes": [{"mesh": 0, "scale": [1e300, 1e300, 1]}]}, "node 'x'.transform: is too large"),
    (
        {"nodes": [{"mesh": 0, "matrix": [1] * 15}]},
        "nodes[0].matrix: expected a list of length",
    ),
    (
        {"nodes": [{"mesh": 0, "translation": ["a", 0, 0]}]},
        "nodes[0].translation[0]: is text in quotes; give a number",
    ),
    ({"scene": 9}, "scene: names entry 9"),
    (
        {"scenes.0.nodes": list(range(10001)), "nodes": [{"mesh": 0}] * 10001},
        "nodes: make more than 10000 objects",
    ),
    ({"asset": None}, "asset: is missing"),
    ({"asset": {"version": "1.0"}, "meshes": {"a": {"primitives": []}}}, "is glTF 1.0; export it"),
    ({"asset": {"version": "2.0"}, "meshes": {"a": 1}}, "meshes: is a table; give a list"),
    (
        {"extensionsRequired": ["KHR_draco_mesh_compression"]},
        "extensionsRequired: KHR_draco_mesh_compression is not read",
    ),
    ({"meshes.0.primitives.0.indices": 9}, "accessors: names entry 9"),
    ({"meshes.0.primitives.0.material": 9}, "meshes[0].primitives[0].material: names entry 9"),
    ({"meshes.0.primitives.0.attributes.POSITION": None}, "meshes[0].primitives[0]: has no POS"),
    ({"meshes.0.primitives.0.mode": 0}, "holds no triangle"),
    ({"accessors.0.count": 10**11}, "accessors[0]: declares 100000000000 elements in a view of 36"),
    ({"accessors.1.count": 10**11}, "has 33333333333 triangles"),
    ({"accessors.1.count": 10**7}, "accessors[1]: declares 10000000 elements"),
    ({"accessors.0.count": -1}, "accessors[0].count: expected a whole number >= 0"),
    ({"accessors.0.bufferView": None}, "accessors[0]: has no bufferView"),
    ({"accessors.0.sparse": {"count": 1}}, "accessors[0]: is sparse, which is not read"),
    ({"accessors.0.type": "VEC9"}, "accessors[0]: is VEC9 of type 5126"),
    ({"accessors.0.componentType": 1}, "accessors[0]: is VEC3 of type 1"),
    ({"accessors.1.componentType": 5126}, "accessors[1]: declares 3 elements in a view of 6"),
    (
        {"accessors.1": {"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR"}},
        "meshes[0].primitives[0].indices: are of type float32",
    ),
    ({"bufferViews.0.buffer": 3}, "bufferViews[0].buffer: names entry 3"),
    ({"bufferViews.0.byteLength": 10**6}, "bufferViews[0]: ends behind its buffer"),
    ({"bufferViews.0.byteLength": 10**9}, "bufferViews[0]: ends behind its buffer"),
    ({"buffers.0.byteLength": 10**9}, "buffers[0]: declares 1,000,000,000 bytes and has 44"),
    ({"buffers.0.uri": None}, "buffers[0]: has no uri and no binary chunk"),
    ({"buffers.0.uri": "data:x;base64,@@@"}, "buffers[0].uri: is not base64"),
    ({"buffers.0.uri": "none.bin"}, "buffers[0].uri: 'none.bin' does not exist"),
    ({"buffers.0.uri": "http://example.com/a.bin"}, "buffers[0].uri: 'http://exam"),
    ({"buffers.0.uri": "../secret.bin"}, f"buffers[0].uri: '../secret.bin' {OUTSIDE}"),
    ({"buffers.0.uri": "/etc/passwd"}, f"buffers[0].uri: '/etc/passwd' {OUTSIDE}"),
    ({"buffers.0.uri": "link.bin"}, f"buffers[0].uri: 'link.bin' {OUTSIDE}"),
]


@pytest.mark.parametrize(("changes", "message"), GLTF_MISTAKES, ids=range(len(GLTF_MISTAKES)))
def test_gltf(changes: dict[str, Any], message: str, tmp_path: Path) -> None:
    folder = tmp_path / "model"
    folder.mkdir()
    write(tmp_path / "secret.bin", BUFFER)
    (folder / "link.bin").symlink_to(tmp_path / "secret.bin")
    assert refusal(write(folder / "x.gltf", json.dumps(changed(changes)))).startswith(message)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[" * 1_000_000, "is a list; give a table"),
        ('{"asset":{"version":"2.0"},"extras":' + "[" * 1_000_000, "is not glTF: "),
        ('{"x":NaN}', "is not glTF: its JSON"),
    ],
    ids=range(3),
)
def test_gltf_json(text: str, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.gltf", text)).startswith(message)


def glb(tree: dict[str, Any], declared: int | None = None, chunk: int | None = None) -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text) if chunk is None else chunk, b"JSON") + text
    body += struct.pack("<I4s", len(BUFFER), b"BIN\0") + BUFFER
    return struct.pack("<4sII", b"glTF", 2, declared or 12 + len(body)) + body


IN_CHUNK = changed({"buffers.0.uri": None})


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (glb(IN_CHUNK, declared=10**9), "declares 1000000000 bytes and has"),
        (glb(IN_CHUNK, declared=30), "declares a chunk of"),
        (glb(IN_CHUNK, chunk=4_000_000_000), "declares a chunk of 4000000000 bytes"),
        (glb(IN_CHUNK)[:-20], "declares"),
        (glb(IN_CHUNK).replace(b"BIN\0", b"NIX\0"), "buffers[0]: declares 44 bytes and has 0"),
        (glb(IN_CHUNK).replace(b"JSON", b"NOSJ"), "has no JSON chunk"),
        (struct.pack("<4sII", b"glTF", 1, 20) + bytes(20), "is glTF 1.0"),
        (b"glTF", "declares 0 bytes and has 4"),
    ],
    ids=range(8),
)
def test_glb(content: bytes, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.glb", content)).startswith(message)
