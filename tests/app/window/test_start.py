"""The window's beginning: a scene of the command line's, the last session, or the default scene."""

from dataclasses import replace

import pytest
from option_changes import with_options

from lucida.app.cli import main
from lucida.app.state.options import Options
from lucida.app.state.session import Arrangement, session_of
from lucida.app.window.start import UNKEPT, begin_scene, begin_session, kept
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def test_a_scene_is_seen_by_the_view_that_was_asked_for(tmp_path):
    (tmp_path / "small.obj").write_text(TRIANGLE)
    asked = load_scene("canonical").view
    changed = replace(asked, fit=not asked.fit)
    begun = begin_scene(str(tmp_path / "small.obj"), asked, lambda view: changed)
    assert (begun.state.scene.name, begun.state.view) == ("small", changed)
    assert begun.opened.endswith("small.obj")
    assert begin_scene().state.scene.name == load_scene("still-life").name
    with pytest.raises(LucidaError, match=r"missing\.obj"):
        begin_scene(str(tmp_path / "missing.obj"))


def test_a_view_file_that_is_wrong_is_told_before_a_model_is_read(tmp_path, capsys):
    model = tmp_path / "model.obj"
    (tmp_path / "view.toml").write_text("[camera]\ndistance = -1\n")
    model.write_text("nothing")
    assert main([str(model), "--view", str(tmp_path / "view.toml")]) == 2
    assert "view.toml: camera.distance: " in capsys.readouterr().err


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
    again.keeper.close(session_of(again.state, Arrangement()))
    assert again.state.scene.name == "small"
    assert again.state.camera.eye == (3.0, 4.0, 5.0)
    (tmp_path / "small.obj").unlink()
    gone = begin_session(folder=tmp_path)
    assert gone.message.count("\n") == 0
    assert "small.obj" in gone.message
    assert gone.state.view == load_scene("still-life").view
    assert gone.keeper is not None
    gone.keeper.close(session_of(gone.state, Arrangement()))


def test_fresh_takes_nothing_for_a_named_scene(tmp_path):
    before = begin_session(folder=tmp_path)
    assert before.keeper is not None
    light = with_options(before.state, preferences={"theme": "light"})
    before.keeper.close(session_of(light, Arrangement()))
    begun = kept(begin_scene("canonical"), fresh=True, folder=tmp_path)
    assert begun.keeper is not None
    begun.keeper.close(session_of(begun.state, Arrangement()))
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
