"""Sessions of the real window: killed or closed, the next one goes on where it was."""

import signal
import sys

import pytest
from launching import launch

from lucida.app.state.session import from_bytes

pytestmark = pytest.mark.timeout(560)

WINDOW = """
import sys
from pathlib import Path
import numpy as np
from numba import njit
from stepped import session_window, stepped
from lucida.app.ui import layout

folder, mode = Path(sys.argv[1]), sys.argv[2]
run = session_window(folder)
window, file = run.window, folder / "session-1.json"

@njit
def write(array, place):
    array[place] = 1.0

def saved():
    data = file.read_bytes() if file.exists() else b""
    return b"spheres" in data and b'"Compare"' in data and b'"light"' in data

def step():
    if not window.settled or window.is_rearranging:
        return
    if mode == "go on":
        views = sorted(view.name for view in window.shell.stage.shown)
        theme = window.state.preferences.theme
        opened = window.views["Camera"].sections
        print(layout.current().name, views, theme, window.state.scene.name, opened, sep="|")
        run.params.app_shall_exit = True
    elif layout.current().name != "Compare":
        layout.switch("Compare")
        window.views["Camera"].open_sections(("Look at",))
    elif window.state.scene.name != "spheres":
        window.shell.stage.show("Raster", False)
        light = window.state.options.with_changes({"preferences": {"theme": "light"}})
        window.change(window.state.with_options(light))
        window.open("spheres")
    elif mode == "close":
        run.params.app_shall_exit = True
    elif saved():
        window.renderers.live.make_tracer = lambda _: write(np.zeros(1), 1 << 45)
        shadows = window.state.options.with_changes({"shadows": True})
        window.change(window.state.with_options(shadows))

stepped(run, step)
"""


def window(folder, mode):
    return launch(["-c", WINDOW, str(folder), mode], folder)


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's signals")
@pytest.mark.parametrize(("mode", "status"), [("crash", -signal.SIGSEGV), ("close", 0)])
def test_the_window_comes_back_as_it_was(tmp_path, mode, status):
    """Layout, hidden views, theme and scene: after a kernel that wrote into memory that is not
    there, and after an ordinary end."""
    path = tmp_path / "session-1.json"
    done = window(tmp_path, mode)
    assert done.returncode == status, done.stderr
    left = from_bytes(path.read_bytes()).arrangement
    assert left.layout == "Compare" and "Raster" not in left.visible
    done = window(tmp_path, "go on")
    assert done.returncode == 0, done.stderr
    layout, views, theme, scene, sections = done.stdout.strip().split("|")
    assert (layout, theme, scene) == ("Compare", "light", "spheres")
    assert sections == "('Look at',)"
    assert views == str(sorted(left.visible))


def test_a_broken_session_is_told_in_the_window_and_kept(tmp_path):
    (tmp_path / "session-1.json").write_bytes(b"\x00 nothing of use")
    done = window(tmp_path, "go on")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("Side by side|")
    assert (tmp_path / "session-1.broken.json").read_bytes() == b"\x00 nothing of use"
    assert from_bytes((tmp_path / "session-1.json").read_bytes()).scene == "still-life"


SIZES = """
import sys
from pathlib import Path
from lucida.app.window import viewer
from lucida.app.window.platform import start_platform
from lucida.app.window.start import begin_scene

viewer.settings_file = lambda fresh=False: Path(sys.argv[1]) / "window.ini"
viewer.user_folder = lambda: None
start = begin_scene()
for size in (None, (640, 400)):
    run = viewer.WindowRun(start_platform(want_display=False), start.state, size, start=start)
    made = run.params.app_window_params
    print(made.restore_previous_geometry, *made.window_geometry.size)
"""


def test_a_size_that_is_asked_for_wins_over_that_of_the_last_window(tmp_path):
    done = launch(["-c", SIZES, str(tmp_path)], tmp_path)
    assert done.stdout.split("\n")[:2] == ["True 1280 720", "False 640 400"], done.stderr
