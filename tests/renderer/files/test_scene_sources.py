"""The sources of scenes: built in, by names and endings; and how they are framed."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from test_scene_files import BALL, TRIANGLE, scene

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene import Mesh, View, flatten
from lucida.renderer.system.errors import LucidaError

# Built-in scenes.


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_built_in_scenes_are_whole(name: str) -> None:
    read = load_scene(name)
    names = [entry.name for entry in read.objects]
    assert all(names)
    assert len(set(names)) == len(names)
    assert read.view.fit
    flat = flatten(read)
    assert all(np.isfinite(array).all() for array in flat)
    assert len(flat.faces) < 20_000  # fast everywhere


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_nothing_coincides_in_built_in_scenes(name: str) -> None:
    """No horizontal face lies in another object's horizontal plane where they overlap."""
    read = load_scene(name)
    meshes = [(e.name, _world(e.shape)) for e in read.objects if isinstance(e.shape, Mesh)]
    for number, (first, a) in enumerate(meshes):
        for second, b in meshes[number + 1 :]:
            apart = (a.max(0) < b.min(0)) | (b.max(0) < a.min(0))
            if apart[0] or apart[2]:
                continue
            heights = [np.unique(np.round(vertices[:, 1], 4)) for vertices in (a, b)]
            planes = [(h.min(), h.max()) for h in heights]
            gaps = [abs(p - q) for p in planes[0] for q in planes[1]]
            assert min(gaps) > 0.009, f"{first} and {second}"


def _world(mesh: Mesh) -> np.ndarray:
    return mesh.vertices @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]


# Names and endings.


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("spherez", "scene: 'spherez' is neither a built-in scene nor a file; did you mean 'sph"),
        ("nonsense", "scene: 'nonsense' is neither a built-in scene nor a file; give one of"),
        ("", "scene: '' is empty"),
        ("a/b", "a/b: does not exist in "),
        ("a.toml", "a.toml: does not exist in "),
        ("a.obj", "a.obj: does not exist in "),
        ("a.png", "a.png: does not exist in "),
        ("a\0b.toml", "a\\x00b.toml: cannot be read: "),
        ("a" * 5000, "scene: 'aaaa"),
        ("a" * 5000 + ".obj", "aaaa"),
    ],
)
def test_an_unknown_source_is_refused_with_a_remedy(
    source: str, message: str, tmp_path: Path, monkeypatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(LucidaError) as caught:
        load_scene(source)
    assert str(caught.value).startswith(message)
    assert caught.value.remedy


def test_endings_decide_and_a_built_in_name_wins_over_a_file(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("still-life").write_text("")
    assert load_scene("still-life").objects
    with pytest.raises(LucidaError, match=r"^still-life: has no ending; give files ending in"):
        load_scene("./still-life")
    Path("x.PLY").write_text("")
    with pytest.raises(LucidaError, match=r"^x\.PLY: is empty"):
        load_scene("x.PLY")
    Path("bunny.obj").write_text(TRIANGLE)
    with pytest.raises(LucidaError, match=r"^buny\.obj: does not exist in .*; check its name"):
        load_scene("buny.obj")
    assert load_scene(Path("bunny.obj")).name == "bunny"


# Framing.


@pytest.mark.parametrize("stretch", [(1, 1, 1), (10, 1, 1), (1, 10, 1), (1, 1, 10)])
def test_a_scene_without_a_camera_is_seen_whole(stretch: tuple[int, int, int]) -> None:
    read = scene(
        f"[[objects]]\ntype = 'torus'\nscale = {list(stretch)}\ntranslate = [100, 0, 0]\n"
        "[[objects]]\ntype = 'sphere'\ncenter = [100, 2, 0]\nradius = 0.5"
    )
    points = [_world(e.shape) for e in read.objects if isinstance(e.shape, Mesh)]
    points.append(np.array([[100, 2.5, 0], [100.5, 2, 0], [99.5, 2, 0], [100, 2, 0.5]]))
    for size in ((200, 200), (400, 100), (100, 400)):
        camera = read.view.for_size(size)
        seen = camera.project(np.concatenate(points), size)
        assert np.isfinite(seen.row).all()
        assert seen.row.min() > -0.5
        assert seen.row.max() < size[1] - 0.5
        assert seen.column.min() > -0.5
        assert seen.column.max() < size[0] - 0.5
    # It is not lost in the picture either: it reaches over a third of it.
    seen = read.view.for_size((200, 200)).project(np.concatenate(points), (200, 200))
    assert max(np.ptp(seen.row), np.ptp(seen.column)) > 67


def test_an_empty_scene_is_seen_by_the_canonical_camera() -> None:
    assert scene("objects = []").view == View(Camera.canonical(), fit=True)


@pytest.mark.parametrize("radius", [1e-8, 1e12])
def test_a_scene_out_of_reach_says_so(radius: float) -> None:
    with pytest.raises(LucidaError, match="across; scale it"):
        scene(f"{BALL}radius = {radius}")
    assert math.isfinite(scene(f"{BALL}radius = {radius}\n[camera]").view.camera.eye[0])


# A missing file, what is beside it, and which of these is suggested.
