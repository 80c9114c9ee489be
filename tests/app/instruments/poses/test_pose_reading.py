"""Files of cameras: known by their names, opened as a set or as a view; their mistakes."""

from __future__ import annotations

import json
import threading
from pathlib import Path

import numpy as np
import pytest
from format_cameras import colmap_model, transforms_json
from sets_of_cameras import a_set, colmap, ring, transforms
from waiting import wait_for

from lucida.app.cameras.taken import TakenCamera
from lucida.app.instruments.poses import reading
from lucida.app.instruments.poses.model import PoseSet
from lucida.app.instruments.poses.reading import PosesReader, is_cameras, open_cameras
from lucida.app.lecture.reading import load_lecture
from lucida.app.state.paths import stored
from lucida.app.window.opening import OpenedPoses, OpenedScene, OpenedView, open_sources
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import written
from lucida.renderer.system.errors import LucidaError


def test_a_transforms_json_is_a_set(tmp_path: Path) -> None:
    poses = open_cameras(str(transforms(tmp_path / "transforms.json")))
    assert isinstance(poses, PoseSet)
    assert poses.format == "nerf" and len(poses.cameras) == 5
    assert poses.names == ("000.png", "001.png", "002.png", "003.png", "004.png")
    for posed, wanted in zip(poses.cameras, ring(5), strict=True):
        assert np.allclose(posed.camera.basis, wanted.camera.basis)
        assert np.allclose(posed.camera.eye, wanted.camera.eye)


def test_a_set_keeps_its_lenses(tmp_path: Path) -> None:
    path = transforms(tmp_path / "transforms.json")
    table = json.loads(path.read_text())
    path.write_text(json.dumps(table | {"k1": 0.2, "camera_model": "OPENCV"}))
    poses = open_cameras(str(path))
    assert isinstance(poses, PoseSet)
    assert poses.view(0).camera.lens == Lens("brown", {"k1": 0.2})


@pytest.mark.parametrize("given", ["", "sparse/0", "sparse/0/images.txt"])
def test_a_colmap_model_is_a_set_with_its_points(tmp_path: Path, given: str) -> None:
    colmap(tmp_path / "sparse" / "0")
    poses = open_cameras(str(tmp_path / given))
    assert isinstance(poses, PoseSet)
    assert poses.format == "colmap" and len(poses.points) == 50
    assert (poses.colors == (200, 100, 50)).all()
    assert np.abs(poses.points + poses.origin).max() < 0.6


@pytest.mark.parametrize(
    ("name", "file"), [("opencv", "camera.yml"), ("nerf", "camera.json"), ("colmap", "sparse")]
)
def test_a_file_with_one_camera_is_a_view(tmp_path: Path, name: str, file: str) -> None:
    path = tmp_path / file
    camera = ring(1)[0]
    if name == "colmap":
        colmap_model(path, [camera])
    elif name == "nerf":
        path.write_text(transforms_json([camera]))
    else:
        path.write_bytes(written([camera], name))
    found = open_cameras(str(path))
    assert isinstance(found, TakenCamera)
    assert found.said.startswith(f"The camera is {path.name}'s: ")
    view = found.view
    assert view.fit
    assert np.allclose(view.camera.eye, camera.camera.eye)
    opened = open_sources(["spheres", str(path)])
    assert opened.things[1] == OpenedView(view, found.said)
    assert opened.find(OpenedScene) is not None


def test_the_window_opens_a_set_over_the_scene(tmp_path: Path) -> None:
    first = transforms(tmp_path / "transforms.json")
    second = colmap(tmp_path / "sparse" / "0")
    opened = open_sources([str(first), str(second)], dropped=True)
    [set_] = opened.things
    assert isinstance(set_, OpenedPoses) and set_.poses.path == first
    assert opened.sources == (str(first), str(second))


def test_what_is_a_scene_stays_one(tmp_path: Path) -> None:
    assert not is_cameras("spheres")
    for ending in (".toml", ".obj", ".ply", ".glb", ".gltf", ".py"):
        assert not is_cameras(str(tmp_path / f"x{ending}"))
    assert is_cameras("Transforms.JSON") and is_cameras(str(tmp_path))
    assert not is_cameras("x\0y")


@pytest.mark.parametrize(
    ("name", "text", "problem"),
    [
        ("transforms.json", "{}", "not a recognised camera format; export the cameras as glTF"),
        ("transforms.json", "{", "line 1, column 2: expecting property name"),
        ("transforms.json", '{"frames": []}', "frames with a transform_matrix (nerf)"),
        (
            "transforms.json",
            '{"frames": [{"w": 4, "h": 3}]}',
            "frames with a transform_matrix (nerf)",
        ),
        ("notes.txt", "milk, bread", "camera_matrix, K, P, or fx and fy (opencv)"),
    ],
)
def test_a_broken_file_is_one_line(tmp_path: Path, name: str, text: str, problem: str) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(LucidaError) as caught:
        open_cameras(str(path))
    assert str(caught.value).startswith(str(path)) and problem in str(caught.value)
    assert "\n" not in str(caught.value) and "--" not in str(caught.value)


def test_a_set_is_read_in_a_thread_and_the_latest_is_kept(tmp_path: Path) -> None:
    reader = PosesReader()
    try:
        paths = [str(transforms(tmp_path / f"{k}.json", k + 2)) for k in range(3)]
        assert reader.of(paths[0]) is None and reader.busy
        for k, path in enumerate(paths):
            wait_for(lambda path=path: reader.of(path) is not None)
            found = reader.of(path)
            assert found is not None and len(found.names) == k + 2
        assert not reader.busy
        assert reader.of("") is None and reader.of(paths[2]) is found  # at once
        assert reader.of(paths[0]) is None and reader.busy  # forgotten: it is read again
        assert reader.of("") is None and not reader.busy  # nobody wants it any more
        broken = tmp_path / "broken.json"
        broken.write_text("{")
        assert reader.of(str(broken)) is None
        wait_for(lambda: reader.of(str(broken)) is None and str(broken) in reader.problems)
        assert "line 1, column 2: expecting property" in reader.problems[str(broken)]
        assert not reader.busy
        mended = a_set(3, str(broken))
        reader.give(mended)
        assert reader.of(str(broken)) is mended and not reader.problems
    finally:
        reader.close()


def test_the_end_of_an_older_reading_is_not_the_newer_one_s(tmp_path: Path, monkeypatch) -> None:
    old, new = (str(transforms(tmp_path / f"{name}.json")) for name in ("old", "new"))
    gates = {old: threading.Event(), new: threading.Event()}
    begun, read = [], reading.load_poses

    def held(path: Path):
        begun.append(str(path))
        assert gates[str(path)].wait(60)
        return read(path)

    monkeypatch.setattr(reading, "load_poses", held)
    reader = PosesReader()
    try:
        assert reader.of(old) is None
        wait_for(lambda: begun == [old])
        assert reader.of(new) is None
        gates[old].set()
        wait_for(lambda: reader.of(new) is None and begun == [old, new])
        assert reader.busy and reader.of(new) is None
        gates[new].set()
        wait_for(lambda: reader.of(new) is not None)
        assert not reader.busy and begun == [old, new]  # each once
    finally:
        reader.close()


@pytest.mark.parametrize("name", ["transforms.json", "sparse/0"])
def test_a_lecture_names_a_set_beside_itself(tmp_path: Path, name: str) -> None:
    transforms(tmp_path / "transforms.json")
    colmap(tmp_path / "sparse" / "0")
    path = tmp_path / "lecture.toml"
    path.write_text(
        'title = "Poses"\n[[steps]]\ntitle = "a set"\nviews = ["poses", "outside"]\n'
        f'options.poses.file = "{name}"\noptions.poses.pose = 2\n'
    )
    (step,) = load_lecture(path).steps
    assert step.changes["poses"] == {"file": stored(str(tmp_path / name)), "pose": 2}
    path.write_text(path.read_text().replace(name, "away.json"))
    with pytest.raises(LucidaError, match=r"'away\.json' does not exist"):
        load_lecture(path)


@pytest.mark.parametrize(
    ("name", "text", "is_camera"),
    [
        ("a.gltf", '{"asset": {}, "cameras": [{}]}', True),
        ("a.gltf", '{"asset": {}, "cameras": [{}], "meshes": [{}]}', False),
        ("a.gltf", '{"asset": {}, "cameras": [], "nodes": []}', False),
        ("a.gltf", "[1", False),
        ("a.py", "import numpy", False),
    ],
)
def test_what_ends_as_programs_and_models_do_is_looked_into(
    tmp_path: Path, name: str, text: str, is_camera: bool
) -> None:
    path = tmp_path / name
    assert not is_cameras(str(path))
    path.write_text(text)
    assert is_cameras(str(path)) is is_camera
