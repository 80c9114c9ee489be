"""Model files whose own coordinates are large: maps, plants, scans in a country's coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lucida.renderer.files import load_scene, save_scene
from lucida.renderer.files.models.apart import MOST, parts_apart
from lucida.renderer.files.models.models import load_model
from lucida.renderer.files.models.parts import Part, build_mesh
from lucida.renderer.files.texture_images import ModelImages
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


# Parts far apart.


def written_as(folder: Path, ending: str, points: np.ndarray, faces: np.ndarray) -> Path:
    """Write one object in a format that holds all digits."""
    head = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n" + "".join(
        f"property double {axis}\n" for axis in "xyz"
    )
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    body = rows(points, "") + rows(faces, "3")
    facets = (f"facet\n{rows(corners, 'vertex')}endfacet\n" for corners in points[faces])
    text = {
        "obj": rows(points, "v") + rows(faces + 1, "f"),
        "off": f"OFF\n{len(points)} {len(faces)} 0\n{body}",
        "ply": head + body,
        "stl": f"solid\n{''.join(facets)}endsolid\n",
    }[ending]
    (folder / f"a.{ending}").write_text(text)
    return folder / f"a.{ending}"


def in_world(objects: Sequence[SceneObject]) -> np.ndarray:
    shapes_ = map(mesh_of, objects)
    return np.vstack([mesh.vertices + mesh.transform[:3, 3] for mesh in shapes_])


@pytest.mark.parametrize("ending", ["obj", "off", "ply", "stl"])
def test_parts_far_apart_keep_the_digits_of_their_own_size(ending: str, tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    small = shapes.torus(0.5, 0.2, 7, 5)
    for _ in range(8):
        sizes = 10.0 ** rng.uniform(-3, 2, 12)
        places = 10.0 ** rng.uniform(0, 7, (12, 1)) * rng.uniform(-1, 1, (12, 3))
        places[6:] = places[:6] + 3 * sizes[:6, None] * rng.normal(size=(6, 3))  # neighbours
        parts = [small.vertices * s + place for s, place in zip(sizes, places, strict=True)]
        faces = [small.faces + k * len(small.vertices) for k in range(len(parts))]
        path = written_as(tmp_path, ending, np.vstack(parts), np.vstack(faces))
        objects = load_model(path).objects
        assert 1 < len(objects) <= len(parts)
        assert sum(len(mesh_of(entry).faces) for entry in objects) == len(faces) * len(faces[0])
        world = in_world(objects)
        for part in parts:
            off = np.abs(part[:, None] - world).max(axis=2).min(axis=1)
            assert off.max() <= 1e-6 * np.ptp(part, axis=0).max()


def test_only_parts_that_would_lose_digits_are_divided(tmp_path: Path) -> None:
    small = TORUS.vertices * 0.001 + (0.3, 0.2, 0.1)
    both = np.vstack([TORUS.vertices, small])
    faces = np.vstack([TORUS.faces, TORUS.faces + len(TORUS.vertices)])
    six_decimals = written_as(tmp_path, "obj", np.round(both, 6), faces)
    assert len(load_model(six_decimals).objects) == 1
    first, second = load_model(written_as(tmp_path, "obj", both, faces)).objects
    assert (first.name, second.name) == ("a_1", "a_2")
    assert (mesh_of(first).transform == np.eye(4)).all()
    joined = np.vstack([faces, [[0, 1, len(TORUS.vertices)]]])
    assert len(load_model(written_as(tmp_path, "obj", both, joined)).objects) == 1
    floats = Part("p", both.astype(np.float32), faces)  # as in glTF and most binary files
    assert parts_apart(floats, ModelImages()) == [floats]


def test_too_many_small_parts_share_origins_and_cost_a_line(tmp_path: Path) -> None:
    places = np.random.default_rng(1).uniform(-1, 1, (600, 1, 3))
    points = (places * (1, 1, 0) + 1e-4 * np.eye(3)).reshape(-1, 3)
    path = written_as(tmp_path, "obj", points, np.arange(len(points)).reshape(-1, 3))
    model = load_model(path)
    assert 1 < len(model.objects) <= MOST
    (note,) = model.notes
    assert "'a' has too many small pieces far apart; coordinates lose up to 6.1e-05" in note
    off = np.abs(points[:, None] - in_world(model.objects)).max(axis=2).min(axis=1)
    assert off.max() <= 6.2e-5 * 1e-4
