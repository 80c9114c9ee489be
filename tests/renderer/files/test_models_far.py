"""Model files whose own coordinates are large: maps, plants, scans in a country's coordinates."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lucida.renderer.files import load_scene, save_scene
from lucida.renderer.files.models.models import load_model
from lucida.renderer.files.models.parts import Part, build_mesh
from lucida.renderer.scene import Mesh, SceneObject, shapes

AT = np.array([4_512_345.671875, 215.25, -5_400_123.53125])  # metres; exact in binary
TORUS = shapes.torus(0.5, 0.2, 24, 12)
POINTS = TORUS.vertices.astype(np.float64) + AT


def rows(lines: np.ndarray, head: str) -> str:
    return "".join(f"{head} {' '.join(map(repr, line))}\n" for line in lines.tolist())


def obj(points: np.ndarray = POINTS) -> str:
    return rows(points, "v") + rows(TORUS.faces + 1, "f")


def mesh_of(entry: SceneObject) -> Mesh:
    assert isinstance(entry.shape, Mesh)
    return entry.shape


def test_a_scene_file_places_a_far_model_and_is_saved(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(obj())
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
    for by, is_far in (((0, 0, 0), False), ((8, 0, -16), False), ((0, 0, 1000), True)):
        part = Part("p", TORUS.vertices + np.array(by), TORUS.faces)
        mesh = build_mesh(part)
        assert mesh is not None
        assert bool((mesh.transform != np.eye(4)).any()) == is_far
        assert (mesh.transform[:3, 3] % 2 == 0).all()  # a power of two above its 1.4 units
    lone = np.vstack([TORUS.vertices, [[1e9, 0, 0]]])  # a vertex that no face uses
    mesh = build_mesh(Part("p", lone, TORUS.faces))
    assert mesh is not None
    assert (mesh.transform == np.eye(4)).all()


def test_a_marker_at_the_origin_of_a_map_costs_no_digits(tmp_path: Path) -> None:
    marker = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    at = len(POINTS)
    (tmp_path / "a.obj").write_text(
        rows(POINTS, "v") + marker + rows(TORUS.faces + 1, "f") + f"f {at + 1} {at + 2} {at + 3}\n"
    )
    (entry,) = load_model(tmp_path / "a.obj").objects
    mesh = mesh_of(entry)
    world = mesh.vertices + mesh.transform[:3, 3]
    assert len(mesh.faces) == len(TORUS.faces) + 1
    off = np.abs(POINTS[:, None] - world).max(axis=2).min(axis=1)
    assert off.max() <= 1e-6
