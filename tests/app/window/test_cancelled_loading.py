"""Scenes that take long to open: cancelled by a newer one, by the user, and by the window's end."""

import time
from pathlib import Path

import pytest
from opened_things import found
from waiting import wait_for

from lucida.app.window import opening
from lucida.app.window.files import Files
from lucida.app.window.opening import OpenedScene
from lucida.renderer.files import load_scene
from lucida.renderer.system.cancelling import check_cancelled


@pytest.fixture
def begun(monkeypatch):
    """Scenes that are named "long" end only if they are cancelled; return what they did."""
    events = []

    def load(source):
        if Path(source).stem == "long":
            events.append("begun")
            try:
                while True:
                    check_cancelled()
                    time.sleep(0.01)
            finally:
                events.append("ended")
        return load_scene(source)

    monkeypatch.setattr(opening, "load_scene", load)
    return events


def scene_file(folder, name):
    path = folder / f"{name}.toml"
    path.write_text('[[objects]]\ntype = "sphere"\n')
    return str(path)


def test_of_several_that_are_opened_at_once_the_last_one_wins(tmp_path, begun):
    files = Files(lambda: None, native=False)
    names = ["long", "b", "long", "c", "last"]
    for name in names:
        files.open(scene_file(tmp_path, name))
    came = []
    wait_for(lambda: (opened := files.poll()) and (came.append(opened) or True))
    wait_for(lambda: not files.busy)
    assert [found(opened, OpenedScene).scene.name for opened in came] == ["last"]
    assert files.poll() is None
    assert files.message == ""
    assert files.poll_said() == [f"Loading {name}.toml was cancelled." for name in names[:-1]]
    files.close()


def test_the_user_and_the_windows_end_cancel(tmp_path, begun):
    files = Files(lambda: None, native=False)
    for count, end in enumerate((files.cancel, files.close), 1):
        files.open(scene_file(tmp_path, "long"))
        wait_for(lambda count=count: begun.count("begun") == count)
        assert files.loading == "long.toml"
        end()
        wait_for(lambda count=count: begun.count("ended") == count)
    assert files.poll() is None
    assert files.poll_said() == ["Loading long.toml was cancelled."]
    assert files.message == ""
