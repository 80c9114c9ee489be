"""The window's beginning: at once with what is quick, and with large models afterwards."""

from dataclasses import replace

import pytest
from opened_things import found
from option_changes import with_options

from lucida.app.cli import main
from lucida.app.state.options import Options
from lucida.app.state.session import Arrangement, session_of
from lucida.app.window import start
from lucida.app.window.opening import OpenedScene, OpenedView
from lucida.app.window.session_store import Keeper, take_place
from lucida.app.window.start import UNKEPT, begin_scene, begin_session, kept
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def model(tmp_path, monkeypatch):
    """One that counts as large."""
    path = tmp_path / "model.obj"
    path.write_text(TRIANGLE)
    monkeypatch.setattr(start, "is_large", lambda path: path.name == "model.obj")
    return path


def test_what_is_quick_is_there_at_once(tmp_path):
    (tmp_path / "small.obj").write_text(TRIANGLE)
    begun = begin_scene(str(tmp_path / "small.obj"))
    assert begun.later is None
    assert begun.state.scene.name == "small"
    assert begun.opened.endswith("small.obj")
    assert begin_scene().state.scene.name == load_scene("still-life").name
    with pytest.raises(LucidaError, match=r"missing\.obj"):
        begin_scene(str(tmp_path / "missing.obj"))


def test_a_large_model_comes_later_with_the_view_that_was_asked_for(model):
    asked = load_scene("canonical").view
    begun = begin_scene(str(model), asked, lambda view: replace(view, fit=not view.fit))
    assert begun.state.scene.name == load_scene("still-life").name
    assert begun.later is not None
    opened = begun.later.open()
    read = found(opened, OpenedScene)
    assert read.scene.name == "model"
    assert found(opened, OpenedView).view == replace(asked, fit=not asked.fit)
    assert opened.sources == (str(model),)
    assert read.use == "first"
    assert read.prepared is not None


def test_a_scene_with_a_large_model_comes_later_too(tmp_path, model):
    scene = tmp_path / "scene.toml"
    scene.write_text('[[objects]]\ntype = "model"\nfile = "model.obj"\n')
    begun = begin_scene(str(scene))
    assert begun.later is not None
    assert begin_scene(str(scene), wait=True).state.scene.name == "scene"
    model.write_text("nothing")
    opened = begun.later.open()
    assert opened.things == ()
    assert "model.obj" in opened.problems[0]


def test_a_view_file_that_is_wrong_is_told_before_a_model_is_read(tmp_path, model, capsys):
    (tmp_path / "view.toml").write_text("[camera]\ndistance = -1\n")
    model.write_text("nothing")
    assert main([str(model), "--view", str(tmp_path / "view.toml")]) == 2
    assert "view.toml: camera.distance: " in capsys.readouterr().err


def test_a_session_of_a_large_model_goes_on_once_that_is_read(tmp_path, model):
    scene = load_scene(model)
    view = load_scene("canonical").view
    kept = begin_scene(str(model), wait=True).state.with_view(view)
    kept = with_options(kept, shadows=True)
    place = take_place(tmp_path / "sessions")
    assert place is not None
    Keeper(place, lambda: None).close(session_of(kept, Arrangement()))
    begun = begin_session(folder=tmp_path / "sessions")
    assert begun.later is not None
    assert begun.state.options.shadows
    opened = begun.later.open()
    assert found(opened, OpenedScene).scene.name == scene.name
    assert found(opened, OpenedView).view == view
    assert begun.keeper is not None
    begun.keeper.close(session_of(kept, Arrangement()))


def test_a_named_scene_is_the_session_from_then_on_with_the_user_s_own_settings(tmp_path):
    before = begin_session(folder=tmp_path)
    state = with_options(
        before.state,
        preferences={"theme": "light", "presentation": True},
        language="julia",
        shadows=True,
    )
    assert before.keeper is not None
    before.keeper.close(session_of(state, Arrangement()))
    (tmp_path / "small.obj").write_text(TRIANGLE)
    begun = kept(begin_scene(str(tmp_path / "small.obj")), folder=tmp_path)
    options = begun.state.options
    assert (options.preferences.theme, options.language) == ("light", "julia")
    assert not options.preferences.presentation
    assert not options.shadows  # which belonged to the scene before
    assert begun.keeper is not None
    moved = begun.state.with_camera(replace(begun.state.camera, eye=(3.0, 4.0, 5.0)))
    begun.keeper.close(session_of(moved, Arrangement()))
    again = begin_session(folder=tmp_path)
    assert again.keeper is not None
    again.keeper.close(None)
    assert again.state.scene.name == "small"
    assert again.state.camera.eye == (3.0, 4.0, 5.0)
    (tmp_path / "small.obj").unlink()
    gone = begin_session(folder=tmp_path)
    assert gone.message.count("\n") == 0
    assert "small.obj" in gone.message
    assert gone.state.view == load_scene("still-life").view
    assert gone.keeper is not None
    gone.keeper.close(None)


def test_fresh_takes_nothing_for_a_named_scene(tmp_path):
    before = begin_session(folder=tmp_path)
    assert before.keeper is not None
    light = with_options(before.state, preferences={"theme": "light"})
    before.keeper.close(session_of(light, Arrangement()))
    begun = kept(begin_scene("canonical"), fresh=True, folder=tmp_path)
    assert begun.keeper is not None
    begun.keeper.close(None)
    assert begun.fresh  # the window's layout, too
    assert begun.state.options == Options()


def test_a_session_that_cannot_be_kept_is_reported(tmp_path):
    (tmp_path / "file").write_text("")
    for begun in (
        begin_session(folder=tmp_path / "file"),
        kept(begin_scene(), folder=tmp_path / "file"),
    ):
        assert begun.keeper is None
        assert begun.message == UNKEPT
