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


OUTSIDE = "is not in the folder of the file that names it"
GLTF_MISTAKES: list[tuple[dict[str, Any], str]] = [
    (
        {"nodes": [{"mesh": 0, "children": [1]}, {"children": [0]}]},
        "nodes[0]: has two parents, or is",
    ),
    ({"nodes": [{"children": [7]}]}, "nodes: names entry 7, counted from 0, of 1"),
    ({"nodes": [{"mesh": 0, "scale": [0, 1, 1]}]}, "holds no triangle"),
    (
        {"nodes": [{"mesh": 0, "translation": ["a", 0, 0]}]},
        "nodes[0].translation[0]: is text in quotes; give a number",
    ),
    (
        {"scenes.0.nodes": list(range(6)), "nodes": [{"mesh": 0}] * 6},
        "nodes: holds 6 objects; stay within 5",
    ),
    (
        {
            "asset": {"version": "1.0"},
        },
        "asset.version: is 1.0; export glTF 2.0",
    ),
    (
        {"meshes.0.primitives.0.attributes.POSITION": None},
        "meshes: have a primitive without",
    ),
    ({"accessors.0.count": 10**11}, "accessors[0]: declares 100000000000 elements in a view of 36"),
    ({"accessors.1.count": 10**11}, "has 33333333333 triangles"),
    ({"accessors.0.componentType": 1}, "accessors[0]: is VEC3 of type 1"),
    (
        {"accessors.1": {"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR"}},
        "accessors[1]: has indices of float32",
    ),
    ({"bufferViews.0.byteLength": 10**6}, "bufferViews[0]: ends after its buffer"),
    ({"buffers.0.uri": None}, "bufferViews[0]: ends after its buffer of 0 bytes"),
    ({"buffers.0.uri": "/etc/passwd"}, f"uri: '/etc/passwd' {OUTSIDE}"),
    ({"buffers.0.uri": "link.bin"}, f"uri: 'link.bin' {OUTSIDE}"),
]


@pytest.mark.parametrize(("changes", "message"), GLTF_MISTAKES, ids=range(len(GLTF_MISTAKES)))
def test_a_hostile_gltf_is_refused(
    changes: dict[str, Any], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lucida.renderer.files.models.gltf.OBJECTS", 5)
    folder = tmp_path / "model"
    folder.mkdir()
    write(tmp_path / "secret.bin", BUFFER)
    (folder / "link.bin").symlink_to(tmp_path / "secret.bin")
    assert refusal(write(folder / "x.gltf", json.dumps(changed(changes)))).startswith(message)


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
        (
            glb(IN_CHUNK, declared=10**9),
            "is not a complete glTF 2.0: version 2, 1000000000 bytes",
        ),
        (glb(IN_CHUNK).replace(b"JSON", b"NOSJ"), "is not a complete glTF 2.0"),
        (struct.pack("<4sII", b"glTF", 1, 20) + bytes(20), "is not a complete glTF 2.0: version 1"),
    ],
)
def test_a_hostile_glb_is_refused(content: bytes, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.glb", content)).startswith(message)
