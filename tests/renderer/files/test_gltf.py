"""glTF files: scenes, nodes, materials, and how their numbers are stored."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from gltf_files import CORNERS, TRIANGLE, gltf, load_gltf
from test_models import corners, mesh_of, write

from lucida.app.cli import main
from lucida.renderer.editing.changing import as_tables
from lucida.renderer.files import load_scene
from lucida.renderer.scene import Material, framing
from lucida.renderer.scene.metal import METAL_DIFFUSE
from lucida.renderer.system.errors import LucidaError


def test_gltf_instances_stand_where_their_nodes_put_them(tmp_path: Path) -> None:
    half = math.sqrt(0.5)
    nodes = [
        {"children": [1, 2], "translation": [10, 0, 0], "rotation": [0, half, 0, half]},
        {"mesh": 0, "name": "scaled", "scale": [2, 3, 4]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]},
        {"mesh": 0, "name": "not in the scene"},
    ]
    first, second = load_gltf(gltf(nodes=nodes), tmp_path).objects
    assert (first.name, second.name) == ("scaled", "t")
    # The quarter turn about y takes x to -z and z to x.
    expected = [[0, 0, 4, 10], [0, 3, 0, 0], [-2, 0, 0, 0], [0, 0, 0, 1]]
    np.testing.assert_allclose(mesh_of(first).transform, expected, atol=1e-12)
    np.testing.assert_allclose(mesh_of(second).transform[:3, 3], [13, 2, -1], atol=1e-12)


def test_gltf_colours_are_linear_and_normals_kept(tmp_path: Path) -> None:
    colors, normals = np.array([[255, 51, 0, 255]] * 3, "u1"), np.array([[0, 0, 127]] * 3, "i1")
    scene = load_gltf(gltf(TRIANGLE | {"COLOR_0": colors, "NORMAL": normals}), tmp_path)
    mesh = mesh_of(scene.objects[0])
    np.testing.assert_allclose(mesh.colors, [[1, 0.2, 0]] * 3, atol=1e-6)
    np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 3)


def materials_of(tmp_path: Path, *given: dict) -> list[Material]:
    """Return what glTF materials become, each on a triangle of its own."""
    primitives = [TRIANGLE | {"material": number} for number in range(len(given))]
    scene = load_gltf(gltf(*primitives, materials=list(given)), tmp_path)
    return [entry.material for entry in scene.objects]


def test_materials_keep_colour_shine_and_sides(tmp_path: Path) -> None:
    base = [0.5, 0.01, 0.0, 1.0]
    pbrs = [{"metallicFactor": m, "roughnessFactor": r} for m, r in ((0, 0.5), (1, 0.5), (1, 0))]
    plastic, metal, smooth, default = materials_of(
        tmp_path,
        *({"pbrMetallicRoughness": pbr | {"baseColorFactor": base}} for pbr in pbrs),
        {"doubleSided": True},
    )
    assert plastic.diffuse == (0.5, 0.01, 0.0)  # exactly: not by way of 8 bits
    assert plastic.specular == pytest.approx((0.04, 0.04, 0.04))
    assert plastic.shininess == metal.shininess == pytest.approx(2 / 0.5**4 - 2)
    # A metal shines in its base colour, and hardly scatters light.
    assert metal.specular == pytest.approx((0.5, 0.01, 0.0))
    assert metal.diffuse == pytest.approx((METAL_DIFFUSE * 0.5, METAL_DIFFUSE * 0.01, 0))
    assert smooth.shininess == 1000
    assert max(default.specular) < 0.25  # a rough metal does not shine white
    assert (plastic.single_sided, default.single_sided) == (True, False)
    assert load_gltf(gltf(), tmp_path).objects[0].material == framing.MATERIAL


def test_what_of_gltf_materials_is_not_shown_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    texture = {"index": 0}
    materials_of(
        tmp_path,
        {"normalTexture": texture, "emissiveFactor": [1, 0, 0], "emissiveTexture": texture},
        {"alphaMode": "BLEND", "extensions": {"KHR_materials_clearcoat": {}, "X\x1b[31m": {}}},
        {"emissiveFactor": [0, 0, 0], "emissiveTexture": texture},
    )
    (note,) = load_scene(tmp_path / "t.gltf").notes
    told = (
        "normal maps, emission, transparency (BLEND), which is drawn opaque, clearcoat, X\\x1b[31m"
    )
    assert note.endswith(f"t.gltf: materials: not shown: {told}")
    assert main(["scene", str(tmp_path / "t.gltf")]) == 0
    assert f"  note: {note}" in capsys.readouterr().out


def test_what_would_move_a_mesh_is_said(tmp_path: Path) -> None:
    tree = gltf()
    assert not load_gltf(tree, tmp_path).notes
    tree["nodes"][0]["skin"] = 0
    tree["meshes"][0]["primitives"][0]["targets"] = [{}]
    (note,) = load_gltf(tree | {"animations": [{}]}, tmp_path).notes
    assert note.endswith("t.gltf: shapes: not shown: skins, morph targets, animations")


def test_colours_beyond_full_reflection_are_cut_to_it(tmp_path: Path) -> None:
    pbr = {"baseColorFactor": [2.0, -1.0, 0.5, 1.0]}
    (material,) = materials_of(tmp_path, {"pbrMetallicRoughness": pbr | {"metallicFactor": 0}})
    assert material.diffuse == (1.0, 0.0, 0.5)


@pytest.mark.parametrize(("cutoff", "alpha", "gone"), [(0.5, 0.4, True), (0.5, 0.6, False)])
def test_a_gltf_mask_without_an_image_is_a_hole_or_none(
    cutoff: float, alpha: float, gone: bool, tmp_path: Path
) -> None:
    pbr = {"baseColorFactor": [1, 1, 1, alpha]}
    mask = {"alphaMode": "MASK", "alphaCutoff": cutoff, "pbrMetallicRoughness": pbr}
    (material,) = materials_of(tmp_path, mask)
    assert material.cutout == pytest.approx(cutoff / alpha)
    assert load_scene(tmp_path / "t.gltf").objects[0].hidden == gone
    # So it is where a scene file shows the model, unless it gives another material.
    part = '[[objects]]\ntype = "model"\nfile = "t.gltf"\n'
    write(tmp_path / "s.toml", part + part + "material = {}\n")
    assert [entry.hidden for entry in load_scene(tmp_path / "s.toml").objects] == [gone, False]


def test_a_gltf_leaf_of_two_turned_faces_has_both_where_it_is_single_sided(tmp_path: Path) -> None:
    """Each is seen from its side. The same face again would be hit at the same distance."""
    indices = np.array([0, 1, 2, 1, 0, 2, 1, 2, 0], "<u2")
    primitive = TRIANGLE | {"indices": indices, "material": 0}
    for double_sided, faces in ((False, [[0, 1, 2], [3, 4, 5]]), (True, [[0, 1, 2]])):
        tree = gltf(primitive, materials=[{"doubleSided": double_sided}])
        (entry,) = load_gltf(tree, tmp_path).objects
        np.testing.assert_array_equal(entry.shape.faces, faces)


def test_quantised_positions_are_read(tmp_path: Path) -> None:
    tree = gltf({"POSITION": (CORNERS * 127).astype("i1")})
    mesh = mesh_of(load_gltf(tree, tmp_path).objects[0])
    np.testing.assert_array_equal(corners(mesh), [CORNERS])


ZIGZAG = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0], [1, 2, 0]], "<f4")
AROUND = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [-1, 1, 0], [-1, 0, 0]], "<f4")


@pytest.mark.parametrize("mode", [4, 5, 6])
def test_strips_and_fans_face_one_way(mode: int, tmp_path: Path) -> None:
    """All face +z: a strip's every other triangle goes the other way round."""
    points = AROUND if mode == 6 else ZIGZAG
    expected = {
        4: [[0, 1, 2], [3, 5, 4]],
        5: [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]],
        6: [[1, 2, 0], [2, 3, 0], [3, 4, 0], [4, 5, 0]],
    }[mode]
    order = {"indices": np.array([0, 1, 2, 3, 5, 4], "<u2")} if mode == 4 else {}
    primitive = {"POSITION": points, "mode": mode} | order
    mesh = mesh_of(load_gltf(gltf(primitive), tmp_path).objects[0])
    found = mesh.vertices[mesh.faces]
    np.testing.assert_array_equal(found, points[expected])
    a, b, c = np.moveaxis(found, 1, 0)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    # Strips are joined by triangles that repeat a vertex; points and lines have no surface.
    if mode == 5:
        joined = gltf(primitive | {"indices": np.array([0, 1, 2, 2, 3, 3, 5, 4], "<u2")})
        assert len(mesh_of(load_gltf(joined, tmp_path).objects[0]).faces) == 2
    for other in (0, 1, 2, 3):
        with pytest.raises(LucidaError, match="holds no triangle"):
            load_gltf(gltf(primitive | {"mode": other}), tmp_path)


# Cameras, which become views.

LENS = {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}


def with_cameras(*cameras: object, **changes: object) -> dict:
    """The tree with a node for each camera behind the mesh's."""
    nodes = [{"mesh": 0, "name": "node"}]
    nodes += [{"camera": n, "translation": [0, 0, 5 + n]} for n in range(len(cameras))]
    numbers = list(range(len(nodes)))
    return gltf(nodes=nodes, scenes=[{"nodes": numbers}], cameras=list(cameras)) | changes


def test_gltf_cameras_are_the_scene_s_views(tmp_path: Path) -> None:
    scene = load_gltf(with_cameras(LENS | {"name": "near"}, LENS), tmp_path)
    assert [named.name for named in scene.views] == ["near", "camera 2"]
    first, second = (named.view for named in scene.views)
    assert first.fit and second.fit
    assert (first.camera.eye, second.camera.eye) == ((0, 0, 5), (0, 0, 6))
    # What is seen first has the model in the picture all the same.
    assert scene.view == load_gltf(gltf(), tmp_path).view
    assert not load_scene("spheres").views


@pytest.mark.parametrize(
    "changes",
    [
        {"cameras": [{"type": "perspective", "perspective": {"yfov": "wide", "znear": 1}}]},
        {"cameras": [[]]},
        {"nodes": [{"mesh": 0}, {"camera": 0, "scale": [0, 0, 0]}]},
        {"nodes": [{"mesh": 0}, {"camera": 0, "translation": [1e300, 0, 0]}]},
    ],
)
def test_a_model_is_not_refused_for_its_cameras(changes: dict, tmp_path: Path) -> None:
    scene = load_gltf(with_cameras(LENS, scenes=[]) | changes, tmp_path)
    assert len(scene.objects) == 1 and not scene.views


def test_a_model_s_cameras_are_named_in_a_scene_file_and_stay_while_it_is_edited(
    tmp_path: Path,
) -> None:
    alone = load_gltf(with_cameras(LENS | {"name": "near"}), tmp_path)
    text = '[[objects]]\ntype = "model"\nfile = "t.gltf"\n'
    scene = load_scene(write(tmp_path / "s.toml", text))
    assert not scene.views and "cameras: listed where the model is opened alone" in scene.notes[0]
    assert [named.name for named in as_tables(alone).views] == ["near"]
