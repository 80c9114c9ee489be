"""The window, driven: real widgets, real events, real pixels, in processes of their own."""

import ast
import functools
import json
import signal
import sys
from pathlib import Path

import numpy as np
import pytest
from launching import launch
from PIL import Image

DRIVER = Path(__file__).parents[2] / "support" / "window_driver.py"
one_window = pytest.mark.timeout(620)
pytestmark = one_window
drives_take_long = pytest.mark.timeout(1560)  # a window with many drives, on a busy machine
WINDOWS = 8  # each takes seconds to open: topics share them
TOPICS = sorted((Path(__file__).parent / "scenarios").glob("*.py"))
DRIVES = {
    path.stem: [
        f"{path.stem}/{node.name}"
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("drive_")
    ]
    for path in TOPICS
}


def drive(folder, *names):
    report = folder / "report.json"
    arguments = [str(DRIVER), str(report), str(folder), *names]
    done = launch(arguments, folder)
    assert report.exists(), done.stdout[-2000:] + done.stderr[-2000:]
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads(report.read_text())


@pytest.fixture(scope="module")
def driven(request, tmp_path_factory):
    """Return the results of a window's drives, of those that are asked for in this run."""
    asked = [
        item.callspec.params["name"]
        for item in request.session.items
        if hasattr(item, "callspec") and "driven" in item.fixturenames
    ]

    @functools.cache
    def of_window(number):
        names = [name for name in _of_window(number) if name in asked]
        return drive(tmp_path_factory.mktemp(f"window{number}"), *names)

    return of_window


def _of_window(number):
    """The names of its drives."""
    topics = list(DRIVES)[number::WINDOWS]
    return [name for topic in topics for name in DRIVES[topic]]


def _tests_of(number):
    """A class of tests: one process gets it whole, so that its drives share one window."""

    @drives_take_long
    @pytest.mark.parametrize("name", _of_window(number))
    def test(self, driven, name):
        assert driven(number)[name] == ""

    return type(f"Test_window_{number}", (), {"test": test})


globals().update((f"Test_window_{number}", _tests_of(number)) for number in range(WINDOWS))


def test_closing_while_the_tracer_works(tmp_path):
    """It prepares, which nothing can cancel."""
    script = """
import threading
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun
from lucida.renderer.files import load_scene

state = AppState.for_scene(load_scene("still-life"))
run = WindowRun(start_platform(want_display=False), state, (900, 600), remember=False)

def prepare(scene):
    run.params.app_shall_exit = True
    threading.Event().wait()

run.window.renderers.live.make_tracer = prepare
run.run()
assert run.window.renderers.live.busy
"""
    done = launch(["-c", script], tmp_path)
    assert done.returncode == 0, done.stderr


def check_picture(path, size):
    """Both images are there, side by side, and nearly equal."""
    picture = np.asarray(Image.open(path).convert("RGB")).astype(int)
    assert picture.shape == (size[1], size[0], 3)
    assert picture.std() > 20
    panel = round(19.5 * 16)
    images = picture[60 : size[1] - 60, panel + 12 :]
    middle = images.shape[1] // 2
    left, right = images[:, 20 : middle - 20], images[:, middle + 20 : -20]
    width = min(left.shape[1], right.shape[1])
    # The dividing line may lie a pixel or two beside the middle.
    best = min(
        np.abs(left[:, 4 + k : width - 8 + k] - right[:, 4 : width - 8]).mean()
        for k in range(-4, 5)
    )
    assert best < 3


def test_without_a_display_a_picture_is_saved_beside_what_is_there(tmp_path):
    mine = tmp_path / "lucida.png"
    mine.write_text("a user's own picture")
    done = launch(["-m", "lucida"], tmp_path, fresh=True)
    assert done.returncode == 0, done.stderr
    first, last = done.stdout.splitlines()
    assert "no display" in first
    assert "lucida-2.png" in last
    check_picture(tmp_path / "lucida-2.png", (1280, 720))
    assert mine.read_text() == "a user's own picture"
    assert not (tmp_path / "config").exists()  # pictures neither read nor write settings
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lucida-2.png", "lucida.png"]


def test_screenshot_of_any_size_and_scene(tmp_path):
    picture = tmp_path / "out.png"
    done = launch(
        ["-m", "lucida", "spheres", "--screenshot", str(picture), "--size", "2000x1300"], tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == ""
    check_picture(picture, (2000, 1300))  # larger than the null platform's own window


def test_mistakes_are_one_line(tmp_path):
    done = launch(["-m", "lucida", "nowhere.obj"], tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "nowhere.obj" in done.stderr
    done = launch(["-m", "lucida", "--screenshot", "no/such/folder.png"], tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_no_opengl_is_one_clear_error(monkeypatch):
    from lucida.app.window import platform
    from lucida.renderer.system.errors import LucidaError

    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr(platform.glfw, "create_window", lambda *_: None)
    with pytest.raises(LucidaError, match=r"OpenGL 3\.3.*install"):
        platform.start_platform(want_display=False)
    platform.glfw.terminate()


def test_the_window_is_shown_with_its_first_picture(tmp_path, xvfb):
    """The window is not to be seen before there is a picture to see in it."""
    script = """
import glfw
from pathlib import Path
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun, save_png
from lucida.renderer.files import load_scene

platform = start_platform()
assert platform.has_display, platform.reason
state = AppState.for_scene(load_scene("still-life"))
run = WindowRun(platform, state, (1280, 720), take_picture=True)
visible = []

def look(target):
    visible.append(glfw.get_window_attrib(glfw.get_current_context(), glfw.VISIBLE))

run.on_drawn = look
save_png(Path("out.png"), run.run())
assert visible[0] == 0 and set(visible[1:]) == {1}, visible
"""
    done = launch(["-c", script], tmp_path, xvfb)
    assert done.returncode == 0, done.stderr
    check_picture(tmp_path / "out.png", (1280, 720))


def test_a_window_that_is_resized(tmp_path, xvfb):
    """At every size the two images stand where their views are; pictures of it are as large."""
    script = """
import glfw
import numpy as np
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun, save_png
from lucida.renderer.files import load_scene

platform = start_platform()
assert platform.has_display, platform.reason
run = WindowRun(platform, AppState.for_scene(load_scene("still-life")), (900, 600), remember=False)
run.params.fps_idling.enable_idling = False
sizes, still = [(900, 600), (640, 480), (1100, 700)], 0

def look(target):
    global still
    still = still + 1 if run.window.settled and target.size == sizes[0] else 0
    if still < 5:
        return
    picture = target.read()
    assert picture.shape[1::-1] == sizes[0], picture.shape
    pictures = run.window.renderers.textures._pictures._pictures
    for name, shown in (("Raster", "pane"), ("Ray", "pane ray")):
        texture = pictures[shown].texture
        width, height = texture.size
        left, _, _, bottom = (round(edge) for edge in run.window.shell.stage.rects[name])
        rows = np.frombuffer(texture.read(), np.uint8)
        image = rows.reshape(height, width, -1)[..., :3].astype(int)
        seen = picture[bottom - height : bottom, left : left + width]
        assert image.std() > 20, f"no image at {sizes[0]}"
        differ = (np.abs(seen - image).max(axis=2) > 2).mean()
        assert differ < 0.01, f"{differ:.1%} of the pixels differ at {sizes[0]}"
    still = 0
    sizes.pop(0)
    if sizes:
        glfw.set_window_size(glfw.get_current_context(), *sizes[0])
    else:
        run.params.app_shall_exit = True

run.on_drawn = look
run.run()
assert not sizes
"""
    done = launch(["-c", script], tmp_path, xvfb)
    assert done.returncode == 0, done.stderr


def test_idle_means_idle_and_settings_are_the_users(tmp_path, xvfb):
    """Once all is still, next to no frames are drawn; the layout is kept in the user's folder."""
    script = """
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun
from lucida.renderer.files import load_scene

platform = start_platform()
assert platform.has_display, platform.reason
run = WindowRun(platform, AppState.for_scene(load_scene("spheres")), (900, 600))
idling, waits = run.params.fps_idling, 0

def count():
    global waits
    idle = idling.is_idling and idling.fps_idle <= 0.5 and run.window.settled
    waits = waits + 1 if idle else 0  # in a row, of 2 s each, which nothing has ended
    if waits == 2:
        run.params.app_shall_exit = True

run.params.callbacks.post_new_frame = count
run.run()
"""
    done = launch(["-c", script], tmp_path, xvfb)  # a window that is never idle is never closed
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "config" / "lucida" / "window.ini").exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["config"]


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's signals")
def test_signals_close_the_window_and_its_layout_is_saved(tmp_path, xvfb):
    script = """
import os, signal, sys
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.ui import layout
from lucida.app.window.viewer import WindowRun
from lucida.renderer.files import load_scene

number, wanted = getattr(signal, sys.argv[1]), sys.argv[2]
usual = signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL
signal.signal(number, usual)  # whatever this process has inherited
run = WindowRun(start_platform(), AppState.for_scene(load_scene("spheres")), (900, 600))
shown = []

def follow():
    if run.window.settled:
        shown.append(layout.current().name)
        if shown[-1] == wanted:
            print(shown[0], flush=True)
            os.kill(os.getpid(), number)
        layout.switch(wanted)

run.params.callbacks.post_new_frame = follow
run.run()
"""
    layouts = "Side by side", "Compare"
    for name, begun, left in (("SIGTERM", *layouts), ("SIGINT", *reversed(layouts))):
        done = launch(["-c", script, name, left], tmp_path, xvfb)
        assert done.stdout == f"{begun}\n", done.stderr
        if name == "SIGTERM":
            assert (done.returncode, done.stderr) == (-signal.SIGTERM, "")
        else:
            assert done.stderr.rstrip().endswith("KeyboardInterrupt")  # which the command tells
        assert f"Name={left}\n" in (tmp_path / "config" / "lucida" / "window.ini").read_text()
