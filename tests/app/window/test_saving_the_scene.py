"""Saving a scene while another is being written: nothing is lost, and nothing old comes back."""

from __future__ import annotations

import threading
from dataclasses import replace
from types import SimpleNamespace

import pytest
from waiting import PATIENT_S, wait_for

from lucida.app.state.app_state import AppState
from lucida.app.window import scene_saving
from lucida.app.window.scene_saving import SceneSaving
from lucida.renderer.editing.changing import set_scene_field
from lucida.renderer.editing.documents import save
from lucida.renderer.files import load_scene
from lucida.renderer.system.file_dependencies import stamp


class Host:
    """A window with a scene; files: what it is told."""

    def __init__(self, path):
        path.write_text("[[objects]]\ntype = 'sphere'\n")
        self.state = AppState.for_scene(load_scene(path))
        self.said: list[str] = []
        self.known: list[object] = []
        self.message = ""

    def rename(self, name):
        self.state = replace(self.state, scene=set_scene_field(self.state.scene, "name", name))

    def amend(self, state):
        self.state = state

    def say(self, text):
        self.said.append(text)

    def know(self, saved):
        self.known.append(saved.origin.files)


@pytest.fixture
def gates(monkeypatch):
    """begun: a scene is about to be written; go: it may be."""
    gates = SimpleNamespace(begun=threading.Semaphore(0), go=threading.Semaphore(0))

    def slow(*given):
        gates.begun.release()
        assert gates.go.acquire(timeout=PATIENT_S)
        return save(*given)

    monkeypatch.setattr(scene_saving, "save", slow)
    return gates


def told(saving, host):
    def is_idle():
        saving.poll(host)
        return not saving.busy

    wait_for(is_idle)


def test_what_is_saved_while_an_older_version_is_written_stays(tmp_path, gates):
    path = tmp_path / "scene.toml"
    host, ended = Host(path), []
    saving = SceneSaving(host, lambda: ended.append(True))
    host.rename("one")
    saving.save(host.state)
    assert gates.begun.acquire(timeout=PATIENT_S)
    host.rename("two")
    saving.save(host.state)
    gates.go.release()
    assert gates.begun.acquire(timeout=PATIENT_S)  # the first is written, and not told yet
    assert "one" in path.read_text()
    wait_for(lambda: saving.poll(host) or bool(host.said))
    assert host.state.scene.name == "two"  # what was edited meanwhile stays
    assert saving.busy and not saving.closes(host.state) and not ended
    gates.go.release()
    told(saving, host)
    assert ended == [True]
    assert host.state.scene.name == "two" and "two" in path.read_text()
    assert host.known[-1] == {path: stamp(path)}
    saving.close()


def test_none_of_several_files_is_left_out(tmp_path, gates):
    host = Host(tmp_path / "scene.toml")
    named = []
    host.ask_name = lambda title, name, kind, chosen: named.append(chosen)
    saving = SceneSaving(host, lambda: None)
    for name in ("a", "b", "c"):
        saving.save_as(host.state)
        named[-1](str(tmp_path / f"{name}.toml"))
    for _ in range(3):
        gates.go.release()
    saving.close()
    told(saving, host)
    assert len(host.said) == 3
    assert all((tmp_path / f"{name}.toml").exists() for name in ("a", "b", "c"))
