"""Exported scenes: what a .glb file holds, and what it does not."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scenes import crowd

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.files.cameras import read_cameras
from lucida.renderer.files.export import export_scene
from lucida.renderer.files.export.meshes import exported_triangles
from lucida.renderer.scene import Scene
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import DirectionalLight, Mesh, SceneObject, Sphere
from lucida.renderer.system.cancelling import CancelledError, cancelled_by
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer

SIZE = (96, 54)
CAMERA = Camera.look_at((3, 2, 6), (0, 0, 0), fov_y_deg=40, aspect=SIZE[0] / SIZE[1])


def exported(scene: Scene, path: Path, camera: Camera = CAMERA) -> tuple[str, ...]:
    return export_scene(path, scene, camera, SIZE)


def scene_of(*shapes_: object, **material: object) -> Scene:
    return Scene(
        tuple(SceneObject(s, Material(**material), f"o{i}") for i, s in enumerate(shapes_))
    )


def files_in(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_a_glb_read_again_has_the_same_meshes_where_they_were(name: str, tmp_path: Path):
    scene = load_scene(name)
    camera = scene.view.for_size(SIZE)
    exported(scene, tmp_path / "a.glb", camera)
    again = load_scene(tmp_path / "a.glb")
    assert [entry.name for entry in again.objects] == [entry.name for entry in scene.objects]
    meshes = {n for n, entry in enumerate(scene.objects) if isinstance(entry.shape, Mesh)}
    (posed,) = read_cameras(tmp_path / "a.glb").cameras
    with Tracer(scene, threads=1) as tracer:
        before = tracer.render(camera, SIZE, ("depth", "id"))
        tracer.set_scene(again)
        after = tracer.render(posed.camera, SIZE, ("depth", "id"))
    # A sphere of many triangles may end a pixel earlier.
    assert (before.id != after.id).mean() < 0.004
    seen = (before.id == after.id) & np.isin(before.id, list(meshes))
    ratio = posed.camera.distance / camera.distance
    np.testing.assert_allclose(after.depth[seen] * ratio, before.depth[seen], rtol=1e-5)
    for mine, other in zip(scene.objects, again.objects, strict=True):
        color = mine.material.diffuse
        if mine.material.checker is None:
            assert other.material.diffuse == pytest.approx(color)


@pytest.mark.parametrize("single_sided", [False, True])
def test_a_glb_turns_no_face_that_is_seen_from_its_front_only(single_sided: bool, tmp_path: Path):
    """Others are turned as their normals are, by which readers tell front from back."""
    corners, normals = np.eye(3, dtype=np.float32), np.full((3, 3), -(3**-0.5), np.float32)
    mesh = Mesh(corners, np.array([[0, 1, 2]], np.int32), normals)
    exported(scene_of(mesh, single_sided=single_sided), tmp_path / "a.glb")
    (entry,) = load_scene(tmp_path / "a.glb").objects
    turned = [[0, 1, 2]] if single_sided else [[2, 1, 0]]
    np.testing.assert_array_equal(entry.shape.faces, turned)


def test_a_glb_holds_lights_camera_and_what_is_left_out(tmp_path: Path):
    scene = crowd()
    told = exported(scene, tmp_path / "a.glb")
    data = (tmp_path / "a.glb").read_bytes()
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    kinds = [light["type"] for light in tree["extensions"]["KHR_lights_punctual"]["lights"]]
    assert kinds == ["point", "directional"]
    shines = next(n for n in tree["nodes"] if n.get("name") == "light 1")["matrix"][8:11]
    light = scene.lights[1]
    assert isinstance(light, DirectionalLight)
    wanted = -np.asarray(light.direction) / np.linalg.norm(light.direction)
    np.testing.assert_allclose(shines, wanted, atol=1e-12)
    assert int.from_bytes(data[8:12], "little") == len(data) and len(data) % 4 == 0
    assert any(line.startswith("spheres: ") for line in told)
    assert any(line.startswith("pattern of object 0: ") for line in told)


# Meshes.


def test_flat_faces_among_smooth_ones_get_their_own_normals():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], np.float32)
    normals = np.array([[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1], [0, 0, 0]], np.float32)
    found = exported_triangles(Mesh(vertices, np.array([[0, 1, 2], [1, 3, 2]]), normals), True)
    assert found.normals is not None
    np.testing.assert_array_equal(found.normals[:3], normals[:3])
    np.testing.assert_allclose(found.normals[3:], [[0, 0, 1]] * 3)
    turned = exported_triangles(Mesh(vertices[:3], np.array([[2, 1, 0]]), normals[:3]), True)
    np.testing.assert_array_equal(turned.faces, [[0, 1, 2]])


def test_the_sphere_of_triangles_is_closed_and_faces_outward():
    sphere = exported_triangles(Sphere((1, 2, 3), 1.0), True)
    joined = np.unique(sphere.vertices.round(5) + 0, axis=0, return_inverse=True)[1].reshape(-1)
    edges = np.sort(joined[sphere.faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert (counts == 2).all()
    corners = sphere.vertices[sphere.faces]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", outward, corners.mean(axis=1)) > 0).all()


# What cannot be written.


def test_a_camera_that_does_not_fit_leaves_nothing(tmp_path: Path):
    off_axis = Camera(viewport=(-0.5, 0.7, -0.5, 0.5))
    with pytest.raises(LucidaError) as caught:
        exported(load_scene("still-life"), tmp_path / "a.glb", off_axis)
    assert caught.value.field == "viewport" and caught.value.remedy
    assert not list(tmp_path.iterdir())


class GivenUp:
    """Counts an export's checks, and cancels it at one of them."""

    def __init__(self, at: int) -> None:
        self.at, self.asked = at, 0

    def check(self) -> None:
        self.asked += 1
        if self.asked == self.at:
            raise CancelledError


def test_a_cancelled_export_leaves_nothing(tmp_path: Path):
    scene, path = load_scene("still-life"), tmp_path / "a.glb"
    whole = GivenUp(at=0)
    with cancelled_by(whole.check):
        exported(scene, tmp_path / "whole.glb")
    assert whole.asked > len(scene.objects)  # each of them, and what is written
    before = files_in(tmp_path)
    for at in range(1, whole.asked + 1):
        with pytest.raises(CancelledError), cancelled_by(GivenUp(at).check):
            exported(scene, path)
        assert files_in(tmp_path) == before, at


@pytest.mark.parametrize(
    ("name", "problem"), [("a.obj", "ends in '.obj'"), ("a", "has no ending"), ("a.glb.x", "'.x'")]
)
def test_another_ending_than_glb_is_refused_and_nothing_is_written(name, problem, tmp_path: Path):
    with pytest.raises(LucidaError, match=problem):
        export_scene(tmp_path / name, Scene(()), CAMERA, SIZE)
    assert not list(tmp_path.iterdir())
    export_scene(tmp_path / "a.GLB", Scene((SceneObject(Sphere()),)), CAMERA, SIZE)
    assert (tmp_path / "a.GLB").stat().st_size
