"""Sessions: what was open comes back; whatever stands in the file's place, nothing is lost."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.state.app_state import AppState
from app.state.options import Bookmark
from app.storage.session import (
    LARGEST_BYTES,
    VERSION,
    Arrangement,
    NewerVersionError,
    from_bytes,
    session_of,
    to_bytes,
)
from app.storage.session_store import Keeper, take_place
from app.window.start import begin_session
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, View, load_scene

ROOT = Path(__file__).parents[2]
PATIENT_S = 60.0


@pytest.fixture(scope="module")
def scene():
    return load_scene("spheres")


@pytest.fixture
def state(scene):
    view = View(Camera((1 / 3, 2, 3), distance=0.1, near=0.25), fit=False)
    marks = (Bookmark(1, "a 'name' with \" and é", view), Bookmark(9, "far", scene.view))
    return AppState.for_scene(scene, view).with_options(
        images={"exposure_ev": 1.5, "pixel_size": 4, "resolution": (16, 9)},
        compare={"mode": "wipe"},
        outside={"camera": Camera((9, 9, 9)), "bundle": (3, 4)},
        preferences={"theme": "light", "font_scale": 1.25},
        marked=(3, 4),
        shadows=True,
        bookmarks=marks,
    )


ARRANGEMENT = Arrangement(
    "Compare",
    ("Camera", "Raster"),
    "[Window][Camera]\nPos=0,24\n",
    {"Camera": ("Look at",)},
    parts={"Lecture/RightSpace": 0.36},
)


def damaged(data: bytes, **changes: object) -> bytes:
    """A session with other values: section__field=value."""
    table = json.loads(data)
    for path, value in changes.items():
        *parents, last = path.split("__")
        part = table
        for name in parents:
            part = part[name]
        part[last] = value
    return json.dumps(table).encode()


def test_a_session_comes_back_as_it_was(state, scene):
    session = session_of(state, ARRANGEMENT)
    assert session.scene == "spheres"
    read = from_bytes(to_bytes(session))
    assert read == session
    assert read.state(scene) == state
    assert read.arrangement == ARRANGEMENT


@given(
    eye=st.tuples(*[st.floats(-1e12, 1e12)] * 3),
    distance=st.floats(1e-12, 1e12),
    name=st.text(max_size=30),
)
def test_numbers_and_names_are_kept_exactly(eye, distance, name):
    view = View(Camera(eye, distance=distance))
    state = AppState.for_scene(load_scene("spheres"), view)
    state = state.with_options(bookmarks=(Bookmark(5, name, view),))
    # JSON is UTF-8: a lone surrogate, which no widget gives, cannot be in it.
    if name.isprintable():
        assert from_bytes(to_bytes(session_of(state, Arrangement()))).view == view


def test_of_a_scene_from_no_file_the_first_built_in_one_is_kept(scene, tmp_path):
    (tmp_path / "scene.toml").write_text('[[objects]]\ntype = "sphere"\n')
    for origin, kept in (
        (None, BUILTIN_SCENES[0]),
        (replace(scene.origin, source=""), BUILTIN_SCENES[0]),
        (load_scene(tmp_path / "scene.toml").origin, str(tmp_path / "scene.toml")),
    ):
        state = AppState.for_scene(replace(scene, origin=origin))
        assert session_of(state, Arrangement()).scene == kept


def test_a_session_of_the_largest_size_is_read_and_a_larger_one_refused(state):
    data = to_bytes(session_of(state, ARRANGEMENT))
    assert from_bytes(data.ljust(LARGEST_BYTES)) == from_bytes(data)
    with pytest.raises(LucidaError, match="more than a session has"):
        from_bytes(data.ljust(LARGEST_BYTES + 1))


def test_options_keep_their_places_in_the_file(state):
    """Shared ones and the instruments' side by side: sessions of other versions are read."""
    options = json.loads(to_bytes(session_of(state, ARRANGEMENT)))["options"]
    names = "images preferences marked highlight shadows mirrors one_based language bookmarks"
    rooms = "compare outside probe stepper costs laboratory"
    assert set(options) >= {*names.split(), *rooms.split(), "presets_in_perspective"}
    assert options["stepper"]["canvas"] == [16, 12] and options["outside"]["bundle"] == [3, 4]


def test_what_an_older_session_lacks_has_its_default(state):
    data = to_bytes(session_of(state, ARRANGEMENT))
    table = json.loads(data)
    del table["options"]["compare"], table["arrangement"], table["options"]["images"]["pixel_size"]
    read = from_bytes(json.dumps(table).encode())
    assert read.options.images.pixel_size == 1
    assert read.options.images.exposure_ev == 1.5
    assert read.arrangement == Arrangement()
    del table["keep_orthonormal"]
    assert from_bytes(json.dumps(table).encode()).keep_orthonormal


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x00\xff\xfe",
        b"{",
        b"[]",
        b"null",
        b'{"lucida_session": true}',
        b'{"lucida_session": "1"}',
        b'{"lucida_session": 0}',
        b'{"lucida_session": 1}',
        b"[" * 100_000,
        b'{"lucida_session": 1, "scene": ' + b"9" * 10_000 + b"}",
        b" " * (LARGEST_BYTES + 1),
    ],
)
def test_what_is_no_session_is_one_clear_error(content):
    with pytest.raises(LucidaError) as caught:
        from_bytes(content, "session-1.json")
    assert str(caught.value).startswith("session-1.json: ")
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    "changes",
    [
        {"view__camera__distance": 0},
        {"view__camera__u": [0, 0, 0]},
        {"view__camera__eye": [1, 2]},
        {"view__camera__eye": [1e300, 0, 0]},
        {"view__camera__projection": "fisheye"},
        {"options__images__pixel_size": 7},
        {"options__images__pixel_size": 10**9},
        {"options__images__exposure_ev": 1e9},
        {"options__images__resolution": [10**9, 1]},
        {"options__images__resolution": [0, 0]},
        {"options__images__channel": "smell"},
        {"options__preferences__font_scale": 0},
        {"options__preferences__font_scale": 1e6},
        {"options__preferences__theme": "pink"},
        {"options__marked": [-1, 0]},
        {"options__outside__bundle": [10**6, 10**6]},
        {"options__compare__gain": 1e30},
        {"options__bookmarks": [{"number": 0, "name": "", "view": {"camera": {}}}]},
        {"options__bookmarks": [{"number": 1, "name": 5, "view": {"camera": {}}}]},
        {"options": []},
        {"scene": 3},
        {"arrangement__visible": "Camera"},
    ],
)
def test_values_that_no_window_can_have_left_are_refused(state, changes):
    data = to_bytes(session_of(state, ARRANGEMENT))
    assert from_bytes(damaged(data)) == session_of(state, ARRANGEMENT)
    with pytest.raises(LucidaError):
        from_bytes(damaged(data, **changes))


@pytest.mark.parametrize("version", [0, -1, True, 1.0, "1", None])
def test_a_version_that_never_was_is_no_session(state, version):
    data = damaged(to_bytes(session_of(state, ARRANGEMENT)), lucida_session=version)
    with pytest.raises(LucidaError, match="this is no session"):
        from_bytes(data)


def test_a_newer_session_is_refused_as_such(state):
    data = damaged(to_bytes(session_of(state, ARRANGEMENT)), lucida_session=VERSION + 1)
    with pytest.raises(NewerVersionError, match="update Lucida"):
        from_bytes(data)


# Files.


def saved(folder: Path, state: AppState) -> Path:
    place = take_place(folder)
    assert place is not None
    place.save(to_bytes(session_of(state, ARRANGEMENT)))
    place.release()
    return place.path


def test_the_window_goes_on_with_the_session(tmp_path, state):
    saved(tmp_path, state)
    start = begin_session(folder=tmp_path)
    assert replace(start.state, scene=state.scene) == state
    assert start.state.scene.name == "spheres"
    assert start.message == ""
    assert start.session is not None
    assert start.session.arrangement == ARRANGEMENT
    assert start.keeper is not None
    start.keeper.close(start.session)


def test_without_a_session_the_window_begins_as_ever(tmp_path):
    start = begin_session(folder=tmp_path / "new" / "folder")
    assert start.session is None
    assert start.message == ""
    assert start.state.scene.name == "still life"
    assert start.keeper is not None
    start.keeper.close(session_of(start.state, Arrangement()))
    assert (tmp_path / "new" / "folder" / "session-1.json").exists()


def test_fresh_begins_without_it(tmp_path, state):
    path = saved(tmp_path, state)
    start = begin_session(fresh=True, folder=tmp_path)
    assert start.session is None
    assert start.state.preferences.theme == "dark"
    assert path.exists()
    assert start.keeper is not None
    start.keeper.close(session_of(start.state, Arrangement()))


@pytest.mark.parametrize("content", [b"nonsense", b'{"lucida_session": 99, "of": "the future"}'])
def test_a_file_that_is_of_no_use_is_kept_and_told(tmp_path, content):
    (tmp_path / "session-1.json").write_bytes(content)
    kept = []
    for number in (1, 2):
        (tmp_path / "session-1.json").write_bytes(content)
        start = begin_session(folder=tmp_path)
        assert start.session is None
        assert "could not be restored" in start.message
        assert start.keeper is not None
        start.keeper.close(session_of(start.state, Arrangement()))
        kept = sorted(tmp_path.glob("session-1.*-*.json"))
        assert len(kept) == number  # the older one was not overwritten
        assert kept[-1].name in start.message
    assert all(path.read_bytes() == content for path in kept)


def test_a_scene_that_is_gone_is_told_and_the_rest_comes_back(tmp_path, state):
    (tmp_path / "scene.toml").write_text('[[objects]]\ntype = "sphere"\n')
    gone = load_scene(tmp_path / "scene.toml")
    saved(tmp_path, replace(state, scene=gone))
    (tmp_path / "scene.toml").unlink()
    start = begin_session(folder=tmp_path)
    assert "scene.toml" in start.message
    assert start.state.scene.name == "still life"
    assert start.state.view == start.state.scene.view  # the session's saw another scene
    assert start.state.options == state.options
    assert start.keeper is not None
    start.keeper.close(session_of(start.state, Arrangement()))


def test_a_scene_file_is_found_from_another_folder(tmp_path, state, monkeypatch):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "scene.toml").write_text('name = "own"\n[[objects]]\ntype = "sphere"\n')
    monkeypatch.chdir(tmp_path / "here")
    scene = load_scene("scene.toml")
    saved(tmp_path / "sessions", replace(state, scene=scene))
    monkeypatch.chdir(tmp_path)
    start = begin_session(folder=tmp_path / "sessions")
    assert start.state.scene.name == "own"
    assert start.keeper is not None
    start.keeper.close(session_of(start.state, Arrangement()))


def test_two_windows_have_two_sessions(tmp_path, state):
    first = begin_session(folder=tmp_path)
    second = begin_session(folder=tmp_path)
    assert first.keeper is not None
    assert second.keeper is not None
    second.keeper.close(session_of(state, Arrangement()))
    first.keeper.close(session_of(first.state, Arrangement()))
    again = begin_session(folder=tmp_path)
    assert again.state.scene.name == "still life"  # the first one's
    assert again.keeper is not None
    again.keeper.close(session_of(again.state, Arrangement()))
    assert len(list(tmp_path.glob("session-*.json"))) == 2


def test_where_no_session_can_be_kept_the_window_opens(tmp_path):
    (tmp_path / "file").write_text("")
    start = begin_session(folder=tmp_path / "file")
    assert start.keeper is None
    assert start.state.scene.name == "still life"


def test_the_keeper_saves_after_a_while_and_tells_a_failure_once(tmp_path, state, monkeypatch):
    place = take_place(tmp_path)
    assert place is not None
    keeper = Keeper(place, lambda: None)
    now_s = [100.0]
    monkeypatch.setattr("app.storage.session_store.time.monotonic", lambda: now_s[0])
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
    wait_for(place.path.exists)
    assert from_bytes(place.path.read_bytes()) == session_of(state, ARRANGEMENT)

    def full(data: bytes) -> None:
        raise LucidaError("", "cannot be written: no space left on device", source="session")

    monkeypatch.setattr(place, "save", full)
    for exposure in (1.0, 2.0):
        changed = state.with_options(images={"exposure_ev": exposure})
        wait_for(lambda: not keeper.due() and not keeper._saving.busy)
        keeper.save(session_of(changed, ARRANGEMENT))
        wait_for(lambda: not keeper._saving.busy or bool(keeper.due()))
    wait_for(lambda: not keeper._saving.busy)
    keeper.due()
    assert "no space left" in keeper.message
    monkeypatch.undo()
    keeper.close(session_of(state, ARRANGEMENT))
    assert from_bytes(place.path.read_bytes()) == session_of(state, ARRANGEMENT)


def wait_for(condition) -> None:
    end_s = time.monotonic() + PATIENT_S
    while not condition():
        assert time.monotonic() < end_s, "nothing happened"
        time.sleep(0.01)


WRITER = """
import sys
from pathlib import Path
from app.storage.session import Arrangement, session_of, to_bytes
from app.storage.session_store import take_place
from app.state.app_state import AppState
from renderer.scene import load_scene

state = AppState.for_scene(load_scene("spheres"))
place = take_place(Path(sys.argv[1]))
print(place.path.name, flush=True)
number = 0
while True:
    number += 1
    windows = f"{number}" + "x" * 200_000 + f"{number}"
    place.save(to_bytes(session_of(state, Arrangement("", (), windows))))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's signals")
def test_killed_at_any_moment_the_file_is_whole_and_its_place_is_free(tmp_path):
    """The old file or the new one, never a part; and the lock ends with the process."""
    rng = random.Random(4)
    seen = 0
    for _ in range(8):
        writer = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(tmp_path)],
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
        )
        assert writer.stdout is not None
        assert writer.stdout.readline() == "session-1.json\n"
        wait_for((tmp_path / "session-1.json").exists)
        time.sleep(rng.uniform(0, 0.05))
        writer.send_signal(signal.SIGKILL)
        writer.wait()
        writer.stdout.close()
        windows = from_bytes((tmp_path / "session-1.json").read_bytes()).arrangement.windows
        number = windows.partition("x")[0]
        assert windows == number + "x" * 200_000 + number
        seen += 1
    assert seen == 8
    place = take_place(tmp_path)
    assert place is not None
    assert place.load().message == ""
    place.save(b"x")
    place.release()
    assert not list(tmp_path.glob(".*.part"))  # what a killed window left is cleared away
