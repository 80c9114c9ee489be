"""The point that the dolly zoom keeps, as the panel asks for it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from option_changes import with_options

from lucida.app.cameras.camera_panel.view import CameraView
from lucida.app.state.app_state import AppState
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import scene_focus


def test_before_images_have_a_size_a_mark_of_the_last_session_is_nowhere() -> None:
    state = with_options(AppState.for_scene(load_scene("canonical")), marked=(3, 4))
    focus = scene_focus(state.scene)
    renderers = SimpleNamespace(size=(0, 0), camera=lambda state: state.camera)
    host = SimpleNamespace(renderers=renderers, focus=focus)
    with np.errstate(all="raise"):
        assert CameraView().focus_point(host, state) == focus.center
        renderers.size = (64, 48)
        assert CameraView().focus_point(host, state) is not None
