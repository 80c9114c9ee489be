"""Unsaved edits come back with the session."""

import pytest
from opened_things import found
from random_edits import SCENE, TENT

from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.state.app_state import AppState
from lucida.app.state.kept_scene import KeptScene
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window import start
from lucida.app.window.opening import OpenedScene
from lucida.app.window.session_store import take_place
from lucida.renderer.editing import changing, documents, objects
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene


@pytest.fixture
def edited(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(SCENE)
    scene = load_scene(tmp_path / "scene.toml")
    rows = outline(scene)
    scene = changing.set_field(scene, [rows[1].item], "radius", 0.9)
    scene, _ = objects.add(scene, objects.new_table(scene, "cone"))
    return objects.delete(scene, [rows[4].item])


def restored(scene):
    """The scene of a session's file, as a window that was killed has left it."""
    session = from_bytes(to_bytes(session_of(AppState.for_scene(scene), Arrangement())))
    return session.load_scene()


def test_an_edited_scene_comes_back_unsaved_and_is_saved_as_if_nothing_had_been(edited, tmp_path):
    found = restored(edited)
    assert found.origin.tables == edited.origin.tables and found.lights == edited.lights
    assert [e.name for e in found.objects] == [e.name for e in edited.objects]
    assert (found.name, found.view) == (edited.name, edited.view)
    assert documents.is_unsaved(found)
    assert documents.file_of(found) == tmp_path / "scene.toml"
    documents.save(found)
    once = (tmp_path / "scene.toml").read_text()
    (tmp_path / "scene.toml").write_text(SCENE)
    documents.save(edited)
    assert (tmp_path / "scene.toml").read_text() == once
    assert "# --- the objects ---" in once and "# no more of the ball" in once


def test_a_file_that_was_changed_meanwhile_is_not_written_over(edited, tmp_path):
    found = restored(edited)
    (tmp_path / "scene.toml").write_text(SCENE + "# theirs\n")
    with pytest.raises(documents.ChangedOnDiskError, match="changed by another program"):
        documents.save(found)


@pytest.mark.parametrize("source", ["tent.obj", "still-life"])
def test_edited_models_and_built_in_scenes_come_back(tmp_path, source):
    (tmp_path / "tent.obj").write_text(TENT)
    scene = load_scene(tmp_path / source if source.endswith("obj") else source)
    scene, _ = objects.add(scene, objects.new_table(scene, "torus", (1, 2, 3)))
    found = restored(scene)
    assert found.origin.tables == scene.origin.tables
    assert documents.suggested_file(found).name == documents.suggested_file(scene).name
    assert documents.is_unsaved(found) and documents.file_of(found) is None


def test_the_window_begins_with_the_edited_scene(edited, tmp_path):
    crashed(edited, tmp_path / "sessions")
    begun = start.begin_session(folder=tmp_path / "sessions")
    begun.keeper.close(None)
    assert begun.state.scene.origin.tables == edited.origin.tables and begun.message == ""


def test_where_its_model_is_gone_the_edited_scene_is_kept_as_a_file(edited, tmp_path):
    crashed(edited, tmp_path / "sessions")
    (tmp_path / "tent.obj").rename(tmp_path / "away.obj")
    begun = start.begin_session(folder=tmp_path / "sessions")
    begun.keeper.close(None)
    kept = tmp_path / "sessions" / "unsaved-1.toml"
    assert str(kept) in begun.message and "does not exist" in begun.message
    (tmp_path / "away.obj").rename(tmp_path / "tent.obj")
    assert len(load_scene(kept).objects) == len(edited.objects)


def crashed(scene, folder):
    """The folder of sessions as a window that was killed leaves it, the scene not saved."""
    place = take_place(folder)
    place.save(to_bytes(session_of(AppState.for_scene(scene), Arrangement())))
    place.release()


@pytest.mark.parametrize("model", ["there", "gone"])
@pytest.mark.parametrize(
    "begin",
    [
        lambda own, folder: start.kept(start.begin_scene(own), folder=folder),
        lambda own, folder: start.kept(start.begin_scene("spheres"), fresh=True, folder=folder),
        lambda own, folder: start.begin_session(fresh=True, folder=folder),
        lambda own, folder: start.begin_lecture(load_lecture(BUILTIN), folder=folder),
    ],
    ids=["its file", "another scene", "fresh", "lecture"],
)
def test_what_takes_the_session_s_place_loses_no_edit(edited, tmp_path, begin, model):
    folder = tmp_path / "sessions"
    crashed(edited, folder)
    begun = begin(str(tmp_path / "scene.toml"), folder)
    assert not documents.is_unsaved(begun.state.scene)
    begun.keeper.close(session_of(begun.state, Arrangement()))
    assert str(folder / "unsaved-1.toml") in begun.unsaved.told
    if model == "gone":
        (tmp_path / "tent.obj").unlink()
        assert begun.unsaved.edited.open().things == ()
        return
    assert len(load_scene(folder / "unsaved-1.toml").objects) == len(edited.objects)
    restored = found(begun.unsaved.edited.open(), OpenedScene).scene
    assert restored.origin.tables == edited.origin.tables
    assert documents.file_of(restored) == tmp_path / "scene.toml"


def test_an_edit_that_cannot_be_written_is_set_aside_with_its_session(
    edited, tmp_path, monkeypatch
):
    folder = tmp_path / "sessions"
    crashed(edited, folder)
    monkeypatch.setattr(KeptScene, "rescue", lambda self, folder: None)  # a full disk
    begun = start.kept(start.begin_scene("spheres"), folder=folder)
    begun.keeper.close(session_of(begun.state, Arrangement()))
    aside = folder / "session-1.unsaved-1.json"
    assert str(aside) in begun.unsaved.told
    assert from_bytes(aside.read_bytes()).edited.tables == edited.origin.tables
