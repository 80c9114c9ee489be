"""Unsaved edits are kept with the session, as a scene file."""

import pytest
from both_lectures import first_lecture
from random_edits import SCENE, TENT

from lucida.app.state.app_state import AppState
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window import start
from lucida.app.window.session_store import take_place
from lucida.renderer.editing import changing, documents, objects
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError


@pytest.fixture
def edited(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(SCENE)
    scene = load_scene(tmp_path / "scene.toml")
    rows = outline(scene)
    scene = changing.set_field(scene, [rows[1].item], "radius", 0.9)
    scene, _ = objects.add(scene, objects.new_table(scene, "cone"))
    return objects.delete(scene, [rows[4].item])


def crashed(scene, folder):
    """The folder of sessions as a window that was killed leaves it, the scene not saved."""
    place = take_place(folder)
    place.save(to_bytes(session_of(AppState.for_scene(scene), Arrangement())))
    place.release()


@pytest.mark.parametrize(
    "begin",
    [
        lambda own, folder: start.begin_session(folder=folder),
        lambda own, folder: start.kept(start.begin_scene(own), folder=folder),
        lambda own, folder: start.kept(start.begin_scene("spheres"), fresh=True, folder=folder),
        lambda own, folder: start.begin_session(fresh=True, folder=folder),
        lambda own, folder: start.begin_lecture(first_lecture(), folder=folder),
    ],
    ids=["the session", "its file", "another scene", "fresh", "lecture"],
)
def test_no_start_loses_an_edit(edited, tmp_path, begin):
    folder = tmp_path / "sessions"
    crashed(edited, folder)
    begun = begin(str(tmp_path / "scene.toml"), folder)
    begun.keeper.close(session_of(begun.state, Arrangement()))
    assert not documents.is_unsaved(begun.state.scene)
    assert begun.unsaved == folder / "unsaved.toml"
    found = load_scene(begun.unsaved)
    assert [one.name for one in found.objects] == [one.name for one in edited.objects]
    assert (found.lights, found.name) == (edited.lights, edited.name)
    again = start.begin_session(folder=folder)
    again.keeper.close(session_of(again.state, Arrangement()))
    assert again.unsaved is None


@pytest.mark.parametrize("source", ["tent.obj", "still-life"])
def test_edited_models_and_built_in_scenes_are_kept(tmp_path, source):
    (tmp_path / "tent.obj").write_text(TENT)
    scene = load_scene(tmp_path / source if source.endswith("obj") else source)
    scene, _ = objects.add(scene, objects.new_table(scene, "torus", (1, 2, 3)))
    kept = from_bytes(to_bytes(session_of(AppState.for_scene(scene), Arrangement()))).unsaved
    (tmp_path / "kept.toml").write_text(kept)
    assert len(load_scene(tmp_path / "kept.toml").objects) == len(scene.objects)


def test_of_a_saved_scene_nothing_is_kept(edited):
    for scene in (load_scene("still-life"), documents.save(edited)):
        assert session_of(AppState.for_scene(scene), Arrangement()).unsaved == ""


def test_an_edit_that_cannot_be_written_is_set_aside_with_its_session(
    edited, tmp_path, monkeypatch
):
    folder = tmp_path / "sessions"
    crashed(edited, folder)

    def full(path):
        raise LucidaError("", "the disk is full", source=str(path))

    monkeypatch.setattr(start, "atomic_write", full)
    begun = start.kept(start.begin_scene("spheres"), folder=folder)
    begun.keeper.close(session_of(begun.state, Arrangement()))
    assert begun.unsaved == folder / "session-1.unsaved.json"
    assert from_bytes(begun.unsaved.read_bytes()).unsaved
