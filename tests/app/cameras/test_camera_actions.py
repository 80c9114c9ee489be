"""The camera's actions: their keys, and what they do with a window."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from lucida.app.cameras.camera_panel import actions as camera_actions
from lucida.app.cameras.camera_panel.actions import CAMERA, EDIT
from lucida.app.cameras.presets import PRESETS
from lucida.app.state.app_state import AppState
from lucida.app.window.action_table import ACTIONS
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import Focus, scene_focus


@dataclass
class Window:
    """As much of a window as the actions ask for."""

    state: AppState
    size: tuple[int, int] = (160, 90)
    said: list[str] = field(default_factory=list)
    message: str = ""

    @property
    def focus(self) -> Focus:
        return scene_focus(self.state.scene)

    @property
    def files(self) -> Any:
        return self

    @property
    def renderers(self) -> Any:
        size = self.size if min(self.size) else (1, 1)
        return SimpleNamespace(size=self.size, camera=lambda state: state.view.for_size(size))

    def say(self, text: str) -> None:
        self.said.append(text)

    def travel(self, state: AppState) -> None:
        self.state = state

    change = travel


@pytest.fixture
def window() -> Window:
    return Window(AppState.for_scene(load_scene("spheres")))


@pytest.fixture
def clipboard(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    held = [""]
    imgui = SimpleNamespace(
        get_clipboard_text=lambda: held[0],
        set_clipboard_text=lambda text: held.__setitem__(0, text),
    )
    monkeypatch.setattr(camera_actions, "imgui", imgui)
    return held


def run(window: Window, name: str) -> None:
    next(action for action in (*CAMERA, *EDIT) if action.name == name).run(window)


def test_look_there_turns_the_camera_or_says_why_not(window: Window) -> None:
    eye = window.state.camera.eye
    camera_actions.look_there(window, (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    camera = window.state.camera
    assert camera.eye == eye
    assert camera.project(np.zeros((1, 3)), (3, 3)).row[0] == pytest.approx(1.0)
    camera_actions.look_there(window, (0.0, 0.0, 0.0), eye)
    assert window.state.camera == camera
    assert "along the view direction" in window.message


def test_no_two_actions_have_a_key() -> None:
    chords = Counter(chord for action in ACTIONS for chord in action.chords)
    assert [chord for chord, count in chords.items() if count > 1] == []


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_each_preset_is_in_the_menu(window: Window, preset) -> None:
    run(window, preset.name)
    camera = window.state.camera
    assert (camera.u, camera.v, camera.w) == (preset.u, preset.v, preset.w)
    assert camera.is_parallel
    assert window.state.keep_orthonormal is not (preset.name in ("Cavalier", "Cabinet"))


def test_a_preset_before_the_first_layout(window: Window) -> None:
    window.size = (0, 0)
    run(window, "Top")
    left, right, bottom, top = window.state.camera.viewport
    assert right - left == pytest.approx(top - bottom)


def test_from_an_oblique_view_home_and_presets_lead_back(window: Window) -> None:
    start = window.state
    run(window, "Cabinet")
    assert not window.state.keep_orthonormal
    run(window, "Front")
    assert window.state.keep_orthonormal
    run(window, "Scene's view")
    assert window.state.view == start.view
    run(window, "Canonical camera")
    assert window.state.camera == Camera.canonical()
    run(window, "Parallel projection")
    assert window.state.camera.is_parallel


def test_framing_keeps_the_directions(window: Window) -> None:
    was = window.state.camera
    window.state = window.state.with_camera(replace(was, eye=(500.0, 3.0, 2.0)))
    run(window, "Frame the scene")
    camera = window.state.camera
    assert (camera.u, camera.v, camera.w) == (was.u, was.v, was.w)
    seen = camera.project(window.focus.framed, (100, 100))
    assert (seen.parameter > 0).all()
    assert -0.5 <= seen.column.min() <= seen.column.max() <= 99.5


def test_a_copied_camera_is_pasted_back(window: Window, clipboard: list[str]) -> None:
    start = window.state
    for name in ("Copy camera", "View file"):
        run(window, name)
        run(window, "Canonical camera")
        run(window, "Paste camera")
        assert window.state == start
    assert len(window.said) == 4
    run(window, "Python")
    assert clipboard[0].startswith("from lucida import Camera")


def test_a_clipboard_without_a_camera_is_told_and_changes_nothing(
    window: Window, clipboard: list[str]
) -> None:
    start = window.state
    clipboard[0] = "3.14"
    run(window, "Paste camera")
    assert window.state is start
    assert window.message.startswith("clipboard: holds no camera; copy a view file")
    assert "\n" not in window.message
