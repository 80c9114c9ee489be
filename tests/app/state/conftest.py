"""Sessions that a window may have left."""

import pytest
from option_changes import with_options

from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Bookmark
from lucida.app.state.session import Arrangement, session_of
from lucida.app.window.start import begin_session
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene import View


@pytest.fixture(scope="module")
def scene():
    return load_scene("spheres")


@pytest.fixture
def state(scene):
    view = View(Camera((1 / 3, 2, 3), distance=0.1, near=0.25), fit=False)
    marks = (Bookmark(1, view), Bookmark(9, scene.view))
    return with_options(
        AppState.for_scene(scene, view),
        images={"exposure_ev": 1.5, "samples": 4, "resolution": (16, 9)},
        compare={"mode": "wipe"},
        outside={"camera": Camera((9, 9, 9)), "bundle": (3, 4)},
        preferences={"theme": "light", "font_scale": 1.25},
        marked=(3, 4),
        shadows=True,
        bookmarks=marks,
    )


@pytest.fixture
def begin():
    """Begin a window's session: begin_session(), whose place is released at the end of the test."""
    starts = []

    def make(**options):
        starts.append(begin_session(**options))
        return starts[-1]

    yield make
    for start in starts:
        if start.keeper is not None:
            start.keeper.close(session_of(start.state, Arrangement()))
