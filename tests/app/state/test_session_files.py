"""Sessions as files: whatever stands in the file's place, nothing is lost."""

import threading
from dataclasses import replace
from pathlib import Path

import pytest
from option_changes import with_options
from test_session import ARRANGEMENT
from waiting import PATIENT_S

from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window.session_store import Keeper, take_place
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

ROOT = Path(__file__).parents[3]


def close(start):
    start.keeper.close(session_of(start.state, Arrangement()))


def saved(folder, state):
    place = take_place(folder)
    assert place is not None
    place.save(to_bytes(session_of(state, ARRANGEMENT)))
    place.release()
    return place.path


def test_the_window_goes_on_with_the_session(tmp_path, state, begin):
    saved(tmp_path, state)
    start = begin(folder=tmp_path)
    assert replace(start.state, scene=state.scene) == state
    assert start.state.scene.name == "spheres"
    assert start.message == ""
    assert start.session is not None
    assert start.session.arrangement == ARRANGEMENT


def test_without_a_session_the_window_begins_as_ever(tmp_path, begin):
    start = begin(folder=tmp_path / "new" / "folder")
    assert start.session is None
    assert start.message == ""
    assert start.state.scene.name == "still life"
    close(start)
    assert (tmp_path / "new" / "folder" / "session-1.json").exists()


def test_fresh_begins_without_it(tmp_path, state, begin):
    path = saved(tmp_path, state)
    start = begin(fresh=True, folder=tmp_path)
    assert start.session is None
    assert start.state.preferences.theme == "dark"
    assert path.exists()


@pytest.mark.parametrize("content", [b"nonsense", b'{"lucida_session": 99, "of": "the future"}'])
def test_a_file_that_is_of_no_use_is_kept_and_told(tmp_path, content, begin):
    (tmp_path / "session-1.json").write_bytes(content)
    kept = []
    for number in (1, 2):
        (tmp_path / "session-1.json").write_bytes(content)
        start = begin(folder=tmp_path)
        assert start.session is None
        assert "could not be restored" in start.message
        close(start)
        kept = sorted(tmp_path.glob("session-1.*.json"))
        assert len(kept) == number  # the older one was not overwritten
        assert any(path.name in start.message for path in kept)
    assert all(path.read_bytes() == content for path in kept)


def test_a_scene_that_is_gone_is_told_and_the_rest_comes_back(tmp_path, state, begin):
    (tmp_path / "scene.toml").write_text('[[objects]]\ntype = "sphere"\n')
    gone = load_scene(tmp_path / "scene.toml")
    saved(tmp_path, replace(state, scene=gone))
    (tmp_path / "scene.toml").unlink()
    start = begin(folder=tmp_path)
    assert "scene.toml" in start.message
    assert start.state.scene.name == "still life"
    assert start.state.view == start.state.scene.view  # the session's saw another scene
    assert start.state.options == state.options


def test_a_scene_file_is_found_from_another_folder(tmp_path, state, monkeypatch, begin):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "scene.toml").write_text('name = "own"\n[[objects]]\ntype = "sphere"\n')
    monkeypatch.chdir(tmp_path / "here")
    scene = load_scene("scene.toml")
    saved(tmp_path / "sessions", replace(state, scene=scene))
    monkeypatch.chdir(tmp_path)
    start = begin(folder=tmp_path / "sessions")
    assert start.state.scene.name == "own"


def test_two_windows_have_two_sessions(tmp_path, state, begin):
    first = begin(folder=tmp_path)
    second = begin(folder=tmp_path)
    second.keeper.close(session_of(state, Arrangement()))
    close(first)
    again = begin(folder=tmp_path)
    assert again.state.scene.name == "still life"  # the first one's
    assert len(list(tmp_path.glob("session-*.json"))) == 2


def test_a_save_that_comes_after_the_last_one_does_not_replace_it(tmp_path, state):
    place = take_place(tmp_path)
    assert place is not None
    last = session_of(state, ARRANGEMENT)
    Keeper(place, lambda: None).close(last)
    place.save(b"late")
    assert from_bytes(place.path.read_bytes()) == last


def test_the_keeper_saves_after_a_while_and_tells_a_failure_once(tmp_path, state, monkeypatch):
    place = take_place(tmp_path)
    assert place is not None
    saved = threading.Semaphore(0)
    keeper = Keeper(place, saved.release)
    now_s = [100.0]
    monkeypatch.setattr("lucida.app.window.session_store.time.monotonic", lambda: now_s[0])
    assert not keeper.due()
    keeper.mark()
    assert not keeper.due()
    now_s[0] += 1.0
    keeper.mark()
    now_s[0] += 1.5
    assert not keeper.due()  # it is changing
    now_s[0] += 1.0
    assert keeper.due()
    keeper.save(session_of(state, ARRANGEMENT))
    monkeypatch.undo()
    assert saved.acquire(timeout=PATIENT_S)
    assert from_bytes(place.path.read_bytes()) == session_of(state, ARRANGEMENT)

    def full(data):
        raise LucidaError("", "cannot be written: no space left on device", source="session")

    monkeypatch.setattr(place, "save", full)
    for exposure, told in ((1.0, True), (2.0, False)):
        keeper.message = ""
        keeper.save(session_of(with_options(state, images={"exposure_ev": exposure}), ARRANGEMENT))
        assert saved.acquire(timeout=PATIENT_S)
        keeper.due()
        assert ("no space left" in keeper.message) == told
    monkeypatch.undo()
    keeper.close(session_of(state, ARRANGEMENT))
    assert from_bytes(place.path.read_bytes()) == session_of(state, ARRANGEMENT)
