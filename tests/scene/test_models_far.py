"""Model files whose own coordinates are large: maps, plants, scans in a country's coordinates."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from agreeing import agree

from renderer import Camera
from renderer.scene import Mesh, SceneObject, framing, load_scene, save_scene, shapes
from renderer.scene.model import Checker, DirectionalLight, Material, Scene
from renderer.scene.models import load_model
from renderer.scene.parts import Part, build_mesh

AT = np.array([4_512_345.671875, 215.25, -5_400_123.53125])  # metres; exact in binary
TORUS = shapes.torus(0.5, 0.2, 24, 12)
POINTS = TORUS.vertices.astype(np.float64) + AT


def obj(points: np.ndarray = POINTS) -> str:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    return "\n".join([*lines, *(f"f {a} {b} {c}" for a, b, c in (TORUS.faces + 1).tolist())])


def off() -> str:
    lines = [f"OFF\n{len(POINTS)} {len(TORUS.faces)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in POINTS.tolist()]
    return "\n".join([*lines, *(f"3 {a} {b} {c}" for a, b, c in TORUS.faces.tolist())])


def ply_head(kind: str, number: str) -> str:
    properties = "\n".join(f"property {number} {axis}" for axis in "xyz")
    return (
        f"ply\nformat {kind} 1.0\nelement vertex {len(POINTS)}\n{properties}\n"
        f"element face {len(TORUS.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )


def ply_text(number: str = "double") -> str:
    return ply_head("ascii", number) + off().split("\n", 2)[2] + "\n"


def ply_binary() -> bytes:
    rows = np.zeros(len(TORUS.faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, TORUS.faces
    head = ply_head("binary_little_endian", "double").encode()
    return head + POINTS.astype("<f8").tobytes() + rows.tobytes()


def stl() -> str:
    facets = []
    for corners in POINTS[TORUS.faces].tolist():
        rows = "\n".join("vertex " + " ".join(map(repr, corner)) for corner in corners)
        facets.append(f"facet normal 0 0 0\nouter loop\n{rows}\nendloop\nendfacet")
    return "\n".join(["solid far", *facets, "endsolid far\n"])


FILES = {
    "a.obj": obj,
    "a.off": off,
    "text.ply": ply_text,
    "binary.ply": ply_binary,
    "a.stl": stl,
}


def written(folder: Path, name: str) -> Path:
    content = FILES[name]()
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def mesh_of(entry: SceneObject) -> Mesh:
    assert isinstance(entry.shape, Mesh)
    return entry.shape


def world_corners(mesh: Mesh) -> np.ndarray:
    """(m, 3, 3), in an order that does not depend on the file's."""
    world = mesh.vertices.astype(float) @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
    middle = world[mesh.faces].mean(axis=1)
    return world[mesh.faces][np.lexsort(np.round(middle - AT, 5).T)]


@pytest.mark.parametrize("name", FILES)
def test_every_text_and_every_double_keeps_its_digits(name: str, tmp_path: Path) -> None:
    (entry,) = load_model(written(tmp_path, name)).objects
    mesh = mesh_of(entry)
    assert np.abs(mesh.vertices).max() < 2
    want = world_corners(Mesh(TORUS.vertices, TORUS.faces, transform=mesh.transform))
    want += AT - mesh.transform[:3, 3]
    have = world_corners(mesh)
    np.testing.assert_allclose(np.sort(have, axis=1), np.sort(want, axis=1), rtol=0, atol=2e-7)


def test_a_far_model_looks_like_a_near_one(tmp_path: Path) -> None:
    scene = load_scene(written(tmp_path, "a.obj"))
    near = tmp_path / "near.obj"
    near.write_text(obj(POINTS - AT))
    size = (96, 64)
    pairs = zip(
        agree(scene, scene.view.for_size(size), size),
        agree(load_scene(near), load_scene(near).view.for_size(size), size),
        strict=True,
    )
    for far_frame, near_frame in pairs:
        assert (far_frame.id == near_frame.id).mean() > 0.998
        both = (far_frame.id >= 0) & (near_frame.id >= 0)
        assert both.mean() > 0.2
        difference = np.abs(far_frame.color - near_frame.color).max(axis=2)[both]
        assert (difference > 2e-3).mean() < 2e-3


def test_a_scene_file_places_a_far_model_and_is_saved(tmp_path: Path) -> None:
    written(tmp_path, "a.obj")
    x, y, z = (-AT).tolist()
    (tmp_path / "scene.toml").write_text(
        "lucida = 1\n[[objects]]\ntype = 'model'\nfile = 'a.obj'\n"
        f"translate = [{x!r}, {y!r}, {z!r}]\nscale = 1.0\n"
    )
    scene = load_scene(tmp_path / "scene.toml")
    save_scene(tmp_path / "again.toml", scene)
    for read in (scene, load_scene(tmp_path / "again.toml")):
        mesh = mesh_of(read.objects[0])
        world = mesh.vertices @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
        np.testing.assert_allclose(world.min(axis=0), TORUS.vertices.min(axis=0), atol=1e-6)
        np.testing.assert_allclose(world.max(axis=0), TORUS.vertices.max(axis=0), atol=1e-6)


def test_only_a_mesh_far_from_its_file_s_origin_gets_one_of_its_own() -> None:
    for by, is_far in (((0, 0, 0), False), ((10, 0, -20), False), ((0, 0, 1000), True)):
        part = Part("p", TORUS.vertices + np.array(by), TORUS.faces)
        mesh = build_mesh(part)
        assert mesh is not None
        assert bool((mesh.transform != np.eye(4)).any()) == is_far
        assert (mesh.transform[:3, 3] % 2 == 0).all()  # a power of two above its 1.4 units
    lone = np.vstack([TORUS.vertices, [[1e9, 0, 0]]])  # a vertex that no face uses
    mesh = build_mesh(Part("p", lone, TORUS.faces))
    assert mesh is not None
    assert (mesh.transform == np.eye(4)).all()


def test_cells_of_a_far_model_stay_where_the_file_has_them() -> None:
    """A cell is centred on the file's origin, though the mesh has got another one."""
    material = Material(checker=Checker(size=0.25))
    light = (DirectionalLight((-1, -2, -3)),)
    whole = Mesh(TORUS.vertices + np.float32([0, 0, 4096]), TORUS.faces)
    own = build_mesh(Part("p", whole.vertices, whole.faces, normals=None))
    assert own is not None
    assert own.transform[2, 3] == 4096
    camera = Camera.look_at((1, 1, 4098), (0, 0, 4096), fov_y_deg=45, aspect=1.5)
    split = Scene((SceneObject(replace(own, normals=None), material),), light)
    (a, _, _), (b, _, _) = (
        agree(scene, camera) for scene in (split, Scene((SceneObject(whole, material),), light))
    )
    assert (np.abs(a.color - b.color).max(axis=2) > 0.02).mean() < 0.01


def test_nodes_of_gltf_may_be_far(tmp_path: Path) -> None:
    """Its numbers are float32; a node's place, and a mesh's own far place, are not."""
    data = TORUS.faces.astype("<u4").tobytes() + (TORUS.vertices + np.float32(2048)).tobytes()
    (tmp_path / "a.bin").write_bytes(data)
    indices, points = TORUS.faces.size * 4, TORUS.vertices.nbytes
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": (AT - 2048).tolist()}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5125, "count": TORUS.faces.size, "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(POINTS), "type": "VEC3"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": indices},
            {"buffer": 0, "byteOffset": indices, "byteLength": points},
        ],
        "buffers": [{"uri": "a.bin", "byteLength": indices + points}],
    }
    (tmp_path / "a.gltf").write_text(json.dumps(tree))
    (entry,) = load_model(tmp_path / "a.gltf").objects
    mesh = mesh_of(entry)
    np.testing.assert_array_equal(mesh.transform[:3, 3], AT)
    np.testing.assert_allclose(mesh.vertices.max(axis=0), TORUS.vertices.max(axis=0), atol=2e-4)
    view = framing.framing_view((entry,))
    assert np.linalg.norm(np.array(view.camera.eye) - AT) < 5
