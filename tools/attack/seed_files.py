"""Sound files of every format that is read, small ones: what mutated_files.py begins with.

Made here, none fetched. Text and binary forms, colours, normals, several objects, instances.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Iterator
from typing import Any

import numpy as np

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]], float)
FACES = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
COLORS = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [9, 9, 9], [255, 255, 0]])


def seed_files() -> dict[str, bytes]:
    """The files' names and content. What other files name, materials and buffers, is among them;
    names of scenes begin with `scene`, of views with `view`, of lectures with `lecture`."""
    files = {
        name: content if isinstance(content, bytes) else content.encode()
        for part in (_obj(), _ply(), _stl(), _off(), _gltf(), _toml())
        for name, content in part
    }
    return files


def _rows(rows: Any, prefix: str = "") -> str:
    return "".join(prefix + " ".join(f"{x:g}" for x in row) + "\n" for row in rows)


def _obj() -> Iterator[tuple[str, str]]:
    plain = _rows(POINTS, "v ") + _rows(FACES + 1, "f ")
    yield "plain.obj", plain
    full = "# a pyramid\nmtllib colours.mtl\no base\n" + _rows(POINTS, "v ")
    full += "vn 0 0 -1\nvn 0 0 1\nvt 0 0\nvt 1 1\nusemtl red\nf 1/1/1 2/2/1 3/1/1 4/2/1\n"
    full += "o sides\nusemtl blue\nf -5//2 -4//2 -1//2\nf 2//2 3//2 \\\n 5//2\nf 3/1 4/2 5/1\n"
    yield "full.obj", full
    yield "colours.mtl", "newmtl red\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 30\nnewmtl blue\nKd 0 0 1\n"


def _ply() -> Iterator[tuple[str, str | bytes]]:
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        header = f"ply\nformat {form} 1.0\ncomment a pyramid\nelement vertex {len(POINTS)}\n"
        header += "".join(f"property float {axis}\n" for axis in "xyz")
        header += "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
        header += f"element face {len(FACES)}\nproperty list uchar int vertex_indices\nend_header\n"
        if form == "ascii":
            body = _rows(np.hstack([POINTS, COLORS])) + _rows(FACES, "3 ")
            yield "colours.ply", header + body
            continue
        order = "<" if "little" in form else ">"
        binary = b"".join(
            struct.pack(order + "3f3B", *point, *color)
            for point, color in zip(POINTS, COLORS.tolist(), strict=True)
        )
        binary += b"".join(struct.pack(order + "B3i", 3, *face) for face in FACES)
        yield f"{form}.ply", header.encode() + binary


def _stl() -> Iterator[tuple[str, str | bytes]]:
    corners = POINTS[FACES]
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n" + _rows(three, "vertex ") + "endloop\nendfacet\n"
        for three in corners
    )
    yield "text.stl", f"solid one\n{facets}endsolid one\nsolid two\n{facets}endsolid two\n"
    packed = b"".join(struct.pack("<12fH", 0, 0, 1, *three.reshape(-1), 0) for three in corners)
    yield "binary.stl", bytes(80) + struct.pack("<I", len(corners)) + packed


def _off() -> Iterator[tuple[str, str]]:
    counts = f"{len(POINTS)} {len(FACES)} 0\n"
    yield "plain.off", "OFF\n" + counts + _rows(POINTS) + _rows(FACES, "3 ")
    colored = _rows(np.hstack([POINTS, COLORS, np.full((len(POINTS), 1), 255)]))
    yield "colours.off", "# a pyramid\nCOFF\n" + counts + colored + "4 0 1 2 3\n" * len(FACES)


def _gltf() -> Iterator[tuple[str, str | bytes]]:
    data = POINTS.astype("<f4").tobytes() + FACES.astype("<u2").tobytes()
    views = [
        {"buffer": 0, "byteLength": POINTS.size * 4},
        {"buffer": 0, "byteOffset": POINTS.size * 4, "byteLength": FACES.size * 2},
    ]
    tree: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"children": [1, 2], "scale": [1, 2, 1]},
            {"mesh": 0, "translation": [2, 0, 0], "rotation": [0, 0.6, 0, 0.8]},
            {"mesh": 0, "name": "second", "matrix": np.eye(4).reshape(-1).tolist()},
        ],
        "meshes": [
            {
                "name": "pyramid",
                "primitives": [
                    {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
                    {"attributes": {"POSITION": 0, "NORMAL": 0}, "mode": 5},
                ],
            }
        ],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(POINTS), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": FACES.size, "type": "SCALAR"},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)}],
    }
    json_chunk = json.dumps(tree).encode()
    json_chunk += b" " * (-len(json_chunk) % 4)
    body = struct.pack("<I4s", len(json_chunk), b"JSON") + json_chunk
    padded = data + bytes(-len(data) % 4)
    body += struct.pack("<I4s", len(padded), b"BIN\0") + padded
    yield "binary.glb", b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body
    tree["buffers"][0]["uri"] = "buffer.bin"
    yield "beside.gltf", json.dumps(tree, indent=1)
    yield "buffer.bin", data
    coded = base64.b64encode(data).decode()
    tree["buffers"][0]["uri"] = f"data:application/octet-stream;base64,{coded}"
    yield "inside.gltf", json.dumps(tree)


SCENE = """\
lucida = 1
name = "everything"
background = "#203040"
ambient = [0.1, 0.1, 0.1]
[camera]
eye = [3, 3, 8]
target = [0, 1, 0]
fov_y_deg = 34
[materials.red]
diffuse = "#d55e00"
specular = [0.4, 0.4, 0.4]
shininess = 80
checker = { diffuse = "#000000", size = 1.0 }
[[objects]]
type = "box"
size = [1, 2, 1]
material = "red"
translate = [0, 1, 0]
rotate_deg = [0, 30, 0]
[[objects]]
type = "sphere"
center = [1, 1, 0]
radius = 0.5
material = { diffuse = [0.2, 0.4, 0.8] }
[[objects]]
type = "torus"
segments = 24
sides = 12
[[objects]]
type = "cylinder"
segments = 16
smooth = false
[[objects]]
type = "cone"
height = 2.0
[[objects]]
type = "disk"
[[objects]]
type = "rectangle"
width = 4
[[objects]]
type = "model"
file = "plain.obj"
scale = [1, 2, 3]
[[lights]]
type = "point"
position = [2, 5, 4]
[[lights]]
type = "directional"
direction = [0, -1, 0]
color = "#ffffff"
"""

VIEW = """\
lucida = 1
[camera]
eye = [0.0, 0.0, 5.0]
u = [1.0, 0.0, 0.0]
v = [0.0, 1.0, 0.0]
w = [0.0, 0.0, 1.0]
distance = 1.0
viewport = [-0.5, 0.5, -0.5, 0.5]
fit = true
projection = "perspective"
near = 0.1
far = 100.0
"""

LECTURE = '''\
title = "A lecture"
author = "nobody"
[scenes.balls]
objects = [{ type = "sphere" }, { type = "box", translate = [2, 0, 0] }]
[[steps]]
title = "First"
part = "One"
text = """
# Rays
A ray is $\\\\mathbf r(t) = \\\\mathbf o + t\\\\,\\\\mathbf d$, **bold** and *slanted*, `code`:

$$
\\\\frac{a}{b}
$$

- one
- two $x_1$

> A question?
"""
scene = "balls"
views = ["raster", "outside"]
pixel = [1, 2]
[steps.options.images]
resolution = [8, 6]
[[steps]]
title = "Second"
camera = { eye = [0, 1, 5] }
[steps.exercise]
kind = "ray"
question = "Which?"
pixel = [1, 1]
size = [4, 4]
[[steps]]
title = "Third"
[steps.exercise]
kind = "choice"
question = "Which $x$?"
options = [{ text = "a", feedback = "no" }, { text = "b", feedback = "yes", right = true }]
'''


def _toml() -> Iterator[tuple[str, str]]:
    yield "scene.toml", SCENE
    yield "view.toml", VIEW
    yield "lecture.toml", LECTURE
