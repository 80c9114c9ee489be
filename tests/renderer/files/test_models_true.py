"""Models are shown as their files mean them, or a line says what is not shown."""

from __future__ import annotations

import json
import math
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gltf_files import gltf, load_gltf
from PIL import Image

from lucida.renderer.files import load_scene
from lucida.renderer.scene import DirectionalLight, PointLight, Scene, framing
from lucida.renderer.system.errors import LucidaError

SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"


def loaded(folder: Path, name: str, content: str | bytes, **others: str) -> Scene:
    """Load a file. others: contents of .mtl files beside it."""
    for other, text in others.items():
        (folder / f"{other}.mtl").write_text(text)
    (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    return load_scene(folder / name)


def area(scene: Scene) -> float:
    found = 0.0
    for entry in scene.objects:
        world = entry.shape.vertices @ entry.shape.transform[:3, :3].T
        a, b, c = world[entry.shape.faces].transpose(1, 0, 2)
        found += float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return found


def note(scene: Scene) -> str:
    (line,) = scene.notes
    return line.partition(": ")[2]


# OBJ and MTL.


def test_random_simple_polygons_have_their_own_area(tmp_path: Path) -> None:
    rng = np.random.default_rng(39)
    for _ in range(60):
        count = int(rng.integers(4, 30))
        angles = np.sort(rng.uniform(0, 2 * np.pi, count))
        away = rng.uniform(0.2, 1, count)
        if np.diff(angles, append=angles[0] + 2 * np.pi).max() > 3:
            continue  # the centre is outside: it may cross itself
        x, y = np.round(away * np.cos(angles), 6), np.round(away * np.sin(angles), 6)
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        points = np.column_stack([x, y, np.zeros(count)]) @ turn
        text = "".join("v {:.9f} {:.9f} {:.9f}\n".format(*p) for p in points)
        scene = loaded(tmp_path, "t.obj", f"{text}f {' '.join(map(str, range(1, count + 1)))}\n")
        shoelace = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
        assert area(scene) == pytest.approx(shoelace, rel=1e-5)
        assert not scene.notes


@pytest.mark.parametrize("libraries", ["mtllib a.mtl\nmtllib b.mtl", "mtllib a.mtl b.mtl"])
def test_materials_come_from_all_libraries(libraries: str, tmp_path: Path) -> None:
    text = f"{libraries}\n{SQUARE}usemtl blue\nf 1 2 3 4\n"
    scene = loaded(tmp_path, "t.obj", text, a="newmtl red\nKd 1 0 0\n", b="newmtl blue\nKd 0 0 1\n")
    assert scene.objects[0].material.diffuse == (0, 0, 1) and not scene.notes


def test_a_library_or_a_material_that_is_missing_is_named(tmp_path: Path) -> None:
    text = f"mtllib my own.mtl\n{SQUARE}usemtl red\nf 1 2 3 4\n"
    assert note(loaded(tmp_path, "t.obj", text)).startswith("materials: 'my own.mtl' does not ex")
    (tmp_path / "my own.mtl").write_text("newmtl blue\nKd 0 0 1\n")
    line = note(load_scene(tmp_path / "t.obj"))
    assert line == "materials: 'red' is not in my own.mtl; default colours are shown"


def test_faces_without_coordinates_keep_the_others_textured(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), "red").save(tmp_path / "t.png")
    text = f"mtllib m.mtl\nusemtl m\n{SQUARE}v 3 -1 0\nv 3 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
    faces = "f 1/1 2/2 3/3\nf 2 5 6 3\n"
    scene = loaded(tmp_path, "t.obj", text + faces, m="newmtl m\nKd 0 1 0\nmap_Kd t.png\n")
    textured, plain = scene.objects
    assert textured.material.texture is not None and len(textured.shape.faces) == 1
    assert plain.material.texture is None and plain.material.diffuse == (0, 1, 0)
    assert "2 triangles of 'geometry' have no texture coordinates" in note(scene)


@pytest.mark.parametrize(
    ("obj", "mtl", "wanted"),
    [
        (
            "l 1 2\np 1\nvp 0 1\nsurf 0 1 0 1 1\nsp 1\n",
            "",
            "shapes: not shown: l, p, vp, surf, sp",
        ),
        ("", "d 0.5\nillum 2\nNi 1.5\n", "materials: not shown: d"),
        ("", "map_Bump b.png\nKe 1 1 1\n", "materials: not shown: map_bump, ke"),
        ("s 1\ns\ng x\n#c\nlod 1\n", "d 1.0\nKe 0 0 0\nTr 0\n", None),
    ],
)
def test_what_obj_and_mtl_hold_besides_is_named(
    obj: str, mtl: str, wanted: str | None, tmp_path: Path
) -> None:
    text = f"mtllib m.mtl\n{SQUARE}{obj}usemtl m\nf 1 2 3 4\n"
    scene = loaded(tmp_path, "t.obj", text, m=f"newmtl m\nKd 1 0 0\n{mtl}")
    assert [line.partition(": ")[2] for line in scene.notes] == ([wanted] if wanted else [])


def test_faces_without_normals_are_flat_beside_those_that_have_some(tmp_path: Path) -> None:
    text = f"{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//9 2//9 4//9\n"
    mesh = loaded(tmp_path, "t.obj", text).objects[0].shape
    found = mesh.normals[mesh.faces].reshape(-1, 9)
    np.testing.assert_array_equal(found, [[0, 0, 1] * 3, [0] * 9, [0] * 9])


def test_a_text_that_is_no_obj_is_told_what_was_looked_for(tmp_path: Path) -> None:
    with pytest.raises(LucidaError, match="has no line that begins with v or f"):
        loaded(tmp_path, "t.obj", "hello\n")


# PLY, STL, OFF.

VERTICES = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
ROWS = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"


def test_ply_strips_are_refused(tmp_path: Path) -> None:
    head = f"ply\nformat ascii 1.0\n{VERTICES}element tristrips 1\nproperty list int int"
    with pytest.raises(LucidaError, match="tristrips: are not read; export triangles"):
        loaded(tmp_path, "t.ply", f"{head} vertex_indices\nend_header\n{ROWS}4 0 1 2 3\n")


def test_what_ply_and_off_hold_besides_is_named(tmp_path: Path) -> None:
    head = f"ply\nformat ascii 1.0\n{VERTICES}property float w\n"
    edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    text = f"{head}element face 1\nproperty list uchar int vertex_index\n{edges}end_header\n"
    rows = ROWS.replace("\n", " 0.5\n")
    scene = loaded(tmp_path, "t.ply", f"{text}{rows}3 0 1 2\n0 1\n")
    assert note(scene) == "PLY: not read: w, vertex1, vertex2"
    off = "OFF4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2"
    assert not loaded(tmp_path, "t.off", off).notes
    assert "not read: colours" in note(loaded(tmp_path, "t.off", f"{off} 255 0 0\n"))


def test_bytes_behind_the_triangles_of_an_stl_cost_a_line(tmp_path: Path) -> None:
    facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    data = bytes(80) + struct.pack("<I", 1) + facet
    assert not loaded(tmp_path, "t.stl", data).notes
    scene = loaded(tmp_path, "t.stl", data + b"\r\n")
    assert len(scene.objects[0].shape.faces) == 1
    assert note(scene) == "STL: not read: 2 bytes after the triangles"


LIGHTS = "KHR_lights_punctual"


def lit(tmp_path: Path, light: dict[str, Any], **node: Any) -> Scene:
    """Load a triangle with a light at (0, 0, 2)."""
    shines = {"extensions": {LIGHTS: {"light": 0}}, "translation": [0.5, 0.5, 2]} | node
    tree = gltf(nodes=[{"mesh": 0}, shines], scenes=[{"nodes": [0, 1]}])
    tree |= {"extensions": {LIGHTS: {"lights": [light]}}, "extensionsUsed": [LIGHTS]}
    return load_gltf(tree, tmp_path)


def test_gltf_lights_shine_as_brightly_as_the_file_s(tmp_path: Path) -> None:
    scene = lit(tmp_path, {"type": "point", "color": [1, 0, 0], "intensity": 4 * math.pi})
    (light,) = scene.lights
    assert isinstance(light, PointLight) and light.position == (0.5, 0.5, 2)
    assert light.color == pytest.approx((1, 0, 0))
    sun = {"type": "directional", "intensity": math.pi}
    (light,) = lit(tmp_path, sun, rotation=[1, 0, 0, 0]).lights
    assert isinstance(light, DirectionalLight)
    assert light.direction == pytest.approx((0, 0, 1)) and light.color == pytest.approx((1, 1, 1))
    scene = lit(tmp_path, sun | {"intensity": 1000 * math.pi})
    assert scene.lights[0].color == pytest.approx((1, 1, 1))
    assert note(scene) == "lights: all are 1e+03 times darker than in the file"
    scene = lit(tmp_path, {"type": "spot"})
    assert scene.lights == framing.LIGHTS and note(scene) == "lights: not shown: spot lights"


def test_extensions_that_are_not_read_are_named_or_refused(tmp_path: Path) -> None:
    used = ["MSFT_lod", LIGHTS, "KHR_materials_variants", "KHR_materials_unlit"]
    scene = load_gltf(gltf(extensionsUsed=used), tmp_path)
    assert note(scene) == "extensions: not read: MSFT_lod, KHR_materials_variants"
    for name in ("MSFT_lod", "EXT_mesh_gpu_instancing"):
        with pytest.raises(LucidaError, match=f"extensionsRequired: {name} is not read"):
            load_gltf(gltf(extensionsRequired=[name]), tmp_path)


def test_gltf_points_and_lines_are_named_and_a_byte_order_mark_is_passed(tmp_path: Path) -> None:
    tree = gltf()
    tree["meshes"][0]["primitives"].append(tree["meshes"][0]["primitives"][0] | {"mode": 1})
    scene = loaded(tmp_path, "t.gltf", b"\xef\xbb\xbf" + json.dumps(tree).encode())
    assert len(scene.objects) == 1 and note(scene) == "shapes: not shown: points and lines"


@pytest.mark.parametrize(
    ("scale", "wanted"), [([1, 1, 0], 0.5), ([2, 0, 0], None), ([0, 0, 0], None), ([0, 1, 1], 0.5)]
)
def test_only_three_scales_of_0_hide_a_gltf_node(
    scale: list[float], wanted: float | None, tmp_path: Path
) -> None:
    corners = np.array([[0, 0, 0], [1, 0, 1], [0, 1, 1]], "<f4")
    nodes = [{"mesh": 0, "scale": scale, "translation": [5, 0, 0]}, {"mesh": 0}]
    tree = gltf({"POSITION": corners}, nodes=nodes, scenes=[{"nodes": [0, 1]}])
    *flat, whole = load_gltf(tree, tmp_path).objects
    assert len(flat) == (wanted is not None)
    for entry in flat:
        assert area(Scene((entry,))) == pytest.approx(wanted)
        assert (entry.shape.transform[:3, 3] == (5, 0, 0)).all()
    assert (whole.shape.transform == np.eye(4)).all()


def test_colours_of_some_vertices_cost_a_line(tmp_path: Path) -> None:
    face, rest = "f 1 2 3\n", "v 1 0 0\nv 0 1 0\n"
    some = loaded(tmp_path, "t.obj", f"v 0 0 0 1 0 0\n{rest}{face}")
    assert note(some) == "OBJ: not read: numbers that only some lines of the kind v have"
    weights = loaded(tmp_path, "t.obj", f"v 0 0 0 0.5\nv 1 0 0 1\nv 0 1 0 1\n{face}")
    assert note(weights) == "OBJ: not read: the weights of vertices"
    assert not loaded(tmp_path, "t.obj", f"v 0 0 0\n{rest}{face}").notes
