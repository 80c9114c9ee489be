"""Model files whose own coordinates are large: maps, plants, scans in a country's coordinates."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from gltf_files import gltf, load_gltf

from renderer.files import load_scene, save_scene
from renderer.files.models.models import load_model
from renderer.files.models.parts import Part, build_mesh
from renderer.scene import Mesh, SceneObject, framing, shapes

AT = np.array([4_512_345.671875, 215.25, -5_400_123.53125])  # metres; exact in binary
TORUS = shapes.torus(0.5, 0.2, 24, 12)
POINTS = TORUS.vertices.astype(np.float64) + AT


def rows(lines: np.ndarray, head: str) -> str:
    return "".join(f"{head} {' '.join(map(repr, line))}\n" for line in lines.tolist())


def obj(points: np.ndarray = POINTS) -> str:
    return rows(points, "v") + rows(TORUS.faces + 1, "f")


def ply_head(kind: str) -> str:
    properties = "\n".join(f"property double {axis}" for axis in "xyz")
    return (
        f"ply\nformat {kind} 1.0\nelement vertex {len(POINTS)}\n{properties}\n"
        f"element face {len(TORUS.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )


def binary_faces() -> bytes:
    found = np.zeros(len(TORUS.faces), [("count", "u1"), ("corners", "<i4", 3)])
    found["count"], found["corners"] = 3, TORUS.faces
    return found.tobytes()


BODY = rows(POINTS, "") + rows(TORUS.faces, "3")
FILES = {
    "a.obj": obj().encode(),
    "a.off": f"OFF\n{len(POINTS)} {len(TORUS.faces)} 0\n{BODY}".encode(),
    "text.ply": (ply_head("ascii") + BODY).encode(),
    "binary.ply": ply_head("binary_little_endian").encode() + POINTS.tobytes() + binary_faces(),
    "a.stl": "".join(
        f"facet normal 0 0 0\nouter loop\n{rows(face, 'vertex')}endloop\nendfacet\n"
        for face in POINTS[TORUS.faces]
    )
    .join(["solid far\n", "endsolid far\n"])
    .encode(),
}


def written(folder: Path, name: str) -> Path:
    (folder / name).write_bytes(FILES[name])
    return folder / name


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


def test_nodes_of_gltf_may_be_far(tmp_path: Path) -> None:
    """Its numbers are float32; a node's place, and a mesh's own far place, are not."""
    points, indices = TORUS.vertices + np.float32(2048), TORUS.faces.astype("<u4").ravel()
    nodes = [{"mesh": 0, "translation": (AT - 2048).tolist()}]
    (entry,) = load_gltf(
        gltf({"POSITION": points, "indices": indices}, nodes=nodes), tmp_path
    ).objects
    mesh = mesh_of(entry)
    np.testing.assert_array_equal(mesh.transform[:3, 3], AT)
    np.testing.assert_allclose(mesh.vertices.max(axis=0), TORUS.vertices.max(axis=0), atol=2e-4)
    view = framing.framing_view((entry,))
    assert np.linalg.norm(np.array(view.camera.eye) - AT) < 5
