"""A scene's file that is saved while the window shows it: read again, the user's view kept."""

from __future__ import annotations

import os
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from opened_things import found
from waiting import wait_for

from lucida.app.state.app_state import AppState, History
from lucida.app.ui import watching
from lucida.app.ui.watching import LOOK_S, REST_S, SceneWatch
from lucida.app.window import opening
from lucida.app.window.files import Files
from lucida.app.window.opening import Opened, OpenedScene
from lucida.app.window.taking import take_newer, take_opened
from lucida.renderer.editing.changing import set_scene_field
from lucida.renderer.editing.documents import save
from lucida.renderer.files import load_scene

BALL = "[[objects]]\ntype = 'sphere'\n"
MODEL = "[[objects]]\ntype = 'model'\nfile = 'm.obj'\n"
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class Clock:
    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        self.now_s += max(LOOK_S, REST_S)
        return self.now_s


@pytest.fixture
def path(tmp_path):
    (tmp_path / "m.obj").write_text(TRIANGLE)
    path = tmp_path / "scene.toml"
    path.write_text(BALL + MODEL)
    return path


@pytest.fixture
def files(monkeypatch):
    # There only: who waits for a process has the real clock.
    monkeypatch.setattr("lucida.app.window.files.time", SimpleNamespace(monotonic=Clock()))
    files = Files(lambda: None, native=False)
    yield files
    files.close()


def follow(files, scene, looks=4):
    """Return what some frames find in which the scene is shown."""
    for _ in range(looks):
        files.follow(scene)
    came = []
    wait_for(lambda: came.append(files.poll()) or not files.busy)
    return next((opened for opened in came if opened is not None), None)


def newer(files, scene):
    """The scene that is read again."""
    opened = follow(files, scene)
    assert opened is not None
    read = found(opened, OpenedScene)
    assert read.replaces is scene and read.use == "newer"
    return read.scene


def loaded(files):
    """Return the result of the loading that is under way."""
    while (opened := files.poll()) is None:
        pass
    return opened


def test_it_is_looked_at_now_and_then_not_in_every_frame(path, monkeypatch):
    looks = []
    look = watching.stamp
    monkeypatch.setattr(watching, "stamp", lambda p: looks.append(p) or look(p))
    watch = SceneWatch()
    watch.shown(load_scene(path))
    assert not any(watch.changed(5.0 + frame / 60) for frame in range(60))
    assert 2 < len(looks) <= 2 * (1 + 1 / LOOK_S)
    assert set(looks) == {path, path.parent / "m.obj"}
    looks.clear()
    watch.shown(load_scene("spheres"))
    assert not any(watch.changed(9.0 + number) for number in range(9))
    assert not looks  # nothing in a disk's way for what is built in


def test_a_saved_scene_is_read_again_once(path, files):
    old = load_scene(path)
    path.write_text(BALL * 2 + MODEL)  # before the window shows it
    scene = newer(files, old)
    assert len(scene.objects) == 3
    path.write_text(BALL * 3 + MODEL)  # before the window shows what was read
    scene = newer(files, scene)
    assert len(scene.objects) == 4
    assert follow(files, scene) is None
    assert follow(files, old) is None  # undo to an older version of a file reads nothing
    path.with_name("m.obj").write_text(TRIANGLE + "v 1 1 0\nf 2 4 3\n")
    scene = newer(files, scene)
    assert len(scene.objects[3].shape.faces) == 2
    path.with_name("m.obj").unlink()  # a model that is not named any more
    path.write_text(BALL)
    assert len(newer(files, scene).objects) == 1


def test_a_model_that_is_missing_is_awaited(path, files):
    scene = load_scene(path)
    follow(files, scene)
    path.write_text(BALL + MODEL.replace("m.obj", "later.obj"))
    assert follow(files, scene) is None
    assert "later.obj: does not exist" in files.message
    assert follow(files, scene) is None
    path.with_name("later.obj").write_text(TRIANGLE)
    opened = newer(files, scene)
    assert opened.objects[1].name == "later"
    assert files.message == ""
    assert follow(files, opened) is None


GLTF = """{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"uri": "m.bin", "byteLength": 36}]}"""


@pytest.mark.parametrize("there", [False, True])
def test_what_a_model_names_is_read_again_too(path, files, there):
    """Its numbers and its materials: saved anew, or missing at first."""
    folder = path.parent
    (folder / "m.gltf").write_text(GLTF)
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")
    (folder / "m.bin").write_bytes(corners.tobytes())
    (folder / "m.obj").write_text("mtllib m.mtl\n" + TRIANGLE.replace("\nf", "\nusemtl red\nf"))
    if there:
        (folder / "m.mtl").write_text("newmtl red\nKd 0 1 0\n")
    path.write_text(BALL + MODEL + MODEL.replace(".obj", ".gltf"))
    scene = load_scene(path)
    assert follow(files, scene) is None
    (folder / "m.mtl").write_text("newmtl red\nKd 1.0 0 0\n")
    scene = newer(files, scene)
    assert scene.objects[1].material.diffuse == (1.0, 0.0, 0.0)
    (folder / "m.bin").write_bytes((2 * corners).tobytes())
    assert newer(files, scene).objects[2].shape.vertices.max() == 2.0


def test_a_mistake_is_one_line_until_it_is_mended(path, files):
    scene = load_scene(path)
    follow(files, scene)
    path.write_text(BALL + "radius = 'x'\n" + MODEL)
    assert follow(files, scene) is None
    assert files.message == f"{path}: objects[0].radius: is text in quotes; give a number"
    path.write_text(BALL + "radius = 2\n" + MODEL)
    assert newer(files, scene)
    assert files.message == ""


def test_a_file_that_is_away_for_a_moment_is_no_change(path, files):
    scene, text = load_scene(path), path.read_text()
    follow(files, scene)
    path.unlink()
    assert follow(files, scene) is None
    assert files.message == ""
    path.write_text(text + BALL)
    assert follow(files, scene) is not None


def test_what_the_window_saves_itself_is_not_read_again(path, files):
    scene = load_scene(path)
    follow(files, scene)
    os.utime(path, (1, 1))
    saved = save(set_scene_field(scene, "name", "renamed"))
    files.know(saved)
    assert "renamed" in path.read_text()
    assert follow(files, saved) is None


def test_a_dropped_scene_that_now_names_a_file_elsewhere_is_refused(path, files):
    (path.parent.parent / "out.obj").write_text(TRIANGLE)
    files.open_all([str(path)], dropped=True)
    scene = found(loaded(files), OpenedScene).scene
    follow(files, scene)
    path.write_text(BALL + MODEL.replace("m.obj", "../out.obj"))
    assert follow(files, scene) is None
    assert "outside of its folder" in files.message


class Window:
    """As much of the window as takes newer scenes."""

    def __init__(self, state):
        self.history = History(state)
        self.files = self
        self.said: list[str] = []
        self.asked: list[str] = []
        self.renderers = SimpleNamespace(textures=None)
        self.opened: Opened | None = None

    def poll(self):
        return self.opened

    def animate(self):
        pass

    @property
    def state(self):
        return self.history.present

    def change(self, state):
        self.history = self.history.change(state)

    def say(self, text):
        self.said.append(text)

    def ask(self, text, answers):
        self.asked.append(text)
        (self.then,) = answers.values()


@pytest.mark.parametrize("moved", [False, True])
def test_the_users_camera_stays_and_undo_goes_back(path, moved):
    old = load_scene(path)
    window = Window(AppState.for_scene(old))
    if moved:
        camera = replace(old.view.camera, eye=(0.0, 1.0, 9.0))
        window.change(window.state.with_camera(camera))
    path.write_text(BALL + "center = [9, 0, 0]\n" + MODEL)
    new = load_scene(path)
    before = window.state
    take_newer(window, old, new)
    assert window.state.scene is new
    assert window.state.view == (before.view if moved else new.view)
    assert window.state.view != (new.view if moved else before.view)
    assert window.said == ["scene was read again: its file was saved."]
    assert window.history.undo().present == before


def test_a_scene_that_is_edited_while_its_file_is_read_is_asked_about(path):
    old = load_scene(path)
    window = Window(AppState.for_scene(old))
    path.write_text(BALL * 2 + MODEL)
    newer = opening.reread(str(path), old, None)
    edited = set_scene_field(old, "name", "edited meanwhile")
    window.change(replace(window.state, scene=edited))
    window.opened = newer
    take_opened(window)
    assert window.state.scene is edited
    assert len(window.asked) == 1 and "is unsaved" in window.asked[0]
    window.then()
    assert window.state.scene is found(newer, OpenedScene).scene
    window.change(replace(window.state, scene=load_scene("spheres")))
    window.opened = newer
    take_opened(window)
    assert window.state.scene is not found(newer, OpenedScene).scene
    assert len(window.asked) == 1
