"""The window where a driver does not take a shader: it opens, says so, and tries again."""

import json
import sys

import numpy as np
import pytest
from PIL import Image
from test_window import LIMIT_S, run

from lucida.app.state.session import Arrangement, session_of, to_bytes
from lucida.app.window.session_store import take_place
from lucida.app.window.start import begin_scene, is_large

pytestmark = pytest.mark.timeout(LIMIT_S + 60)

WINDOW = """
import json, sys
from pathlib import Path
from PIL import Image
from imgui_bundle import hello_imgui
from stepped import stepped
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun
from lucida.renderer.raster import sources
from lucida.renderer.files import load_scene

broken, view = sys.argv[1], sys.argv[2]
good = sources.read_shader
state = AppState.for_scene(load_scene("still-life"))
run = WindowRun(start_platform(want_display=False), state, (1100, 720), remember=False)
window, told = run.window, {}
frames = iter(range(10**9))
waited = 0

def read(name):
    text = good(name)
    return text + "oh no;\\n" if name == broken else text

sources.read_shader = read

def failure():
    stage = window.shell.stage
    return window.renderers.failure or stage.failed.errors.get(view)

def step():
    global waited
    if next(frames) == 3 and view != "Raster":
        window.shell.stage.show(view)
    if not told:
        waited += failure() is not None and not window.renderers.live.busy
        if waited > 5:
            told["error"] = str(failure())
            told["ray"] = str(window.renderers.ray_error)
            assert window.renderers.ray_image is not None  # traced, whether it can be shown or not
            run.on_drawn = picture
    elif run.on_drawn is None and failure() is None and window.settled:
        told["mended"] = True
        run.params.app_shall_exit = True

def picture(drawn):
    run.on_drawn = None
    Image.fromarray(drawn.read()).save("told.png")
    sources.read_shader = good
    window.retry()
    for failed in list(window.shell.stage.failed.errors):
        window.shell.stage.failed._retry(failed)  # the button in that view

stepped(run, step)
Path("told.json").write_text(json.dumps(told))
"""


@pytest.mark.parametrize(
    ("shader", "view"),
    [
        ("triangles.frag", "Raster"),
        ("plane.frag", "Outside"),
        ("display.frag", "Raster"),
    ],
)
def test_a_shader_that_fails_at_the_start_is_told_and_survived(tmp_path, shader, view):
    done = run(["-c", WINDOW, shader, view], tmp_path)
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["error"].startswith(f"shaders/{shader}: ")
    assert "update the graphics driver" in told["error"]
    assert (told["ray"] == "None") == (shader != "display.frag")  # which both images go through
    assert told["mended"]
    picture = np.asarray(Image.open(tmp_path / "told.png"))
    assert picture.std() > 10


def test_a_picture_of_the_window_without_a_shader_is_one_line(tmp_path):
    script = (
        "from lucida.renderer.raster import sources\n"
        "good = sources.read_shader\n"
        "def read(name):\n"
        "    return good(name) + ('oh no;' if name == 'shade.frag' else '')\n"
        "sources.read_shader = read\n"
        "import sys\n"
        "from lucida.app.cli import main\n"
        "sys.exit(main(['--screenshot', 'out.png']))\n"
    )
    done = run(["-c", script], tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1, done.stderr
    assert "shaders/shade.frag" in done.stderr
    assert not (tmp_path / "out.png").exists()


def test_the_window_is_there_before_a_large_model(tmp_path):
    side = 200
    grid = [(x, y) for y in range(side) for x in range(side)]
    corner = [y * side + x + 1 for x, y in grid if x + 1 < side and y + 1 < side]
    text = "".join(f"v {x:.12f} {y:.12f} {x * y % 7:.12f}\n" for x, y in grid)
    text += "".join(f"f {k} {k + 1} {k + side + 1} {k + side}\n" for k in corner)
    (tmp_path / "large.obj").write_text(text)
    assert is_large(tmp_path / "large.obj")
    script = """
from stepped import stepped
from lucida.app.window.platform import start_platform
from lucida.app.window.start import begin_scene
from lucida.app.window.viewer import WindowRun

start = begin_scene("large.obj")
platform = start_platform(want_display=False)
run = WindowRun(platform, start.state, (900, 600), remember=False, start=start)
window, frames = run.window, 0

def step():
    global frames
    frames += window.state.scene.name != "large"
    if window.state.scene.name == "large" and window.settled:
        assert not window.history.past
        print(frames)
        run.params.app_shall_exit = True

stepped(run, step)
"""
    done = run(["-c", script], tmp_path)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.split()[-1]) > 0, "the model was read before the first frame"


def test_a_window_that_ends_before_its_scene_is_read_leaves_the_session(tmp_path):
    """Meanwhile it shows another scene than the one that was open."""
    script = """
import threading
from pathlib import Path
from stepped import session_window, stepped
from lucida.app.window import start as starting

starting.is_large = lambda path: True
starting.Later.open = lambda self: threading.Event().wait()  # for ever
run = session_window(Path.cwd())
assert run.window.files.awaits_first
frames = iter(range(10**9))

def step():
    frame = next(frames)
    if frame == 5:
        state = run.window.state
        run.window.change(state.with_options(state.options.with_changes({"shadows": True})))
    run.params.app_shall_exit = frame == 20

stepped(run, step)
"""
    (tmp_path / "model.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    place = take_place(tmp_path)
    assert place is not None
    kept = to_bytes(session_of(begin_scene(str(tmp_path / "model.obj")).state, Arrangement()))
    place.save(kept)
    place.release()
    done = run(["-c", script], tmp_path)
    assert done.returncode == 0, done.stderr
    assert place.path.read_bytes() == kept


IMPORTED = {
    *("PIL", "_cython", "_moderngl", "cython_runtime", "glfw", "imgui_bundle", "lucida"),
    *("mapbox_earcut", "markdown_it", "mdit_py_plugins", "mdurl", "moderngl", "msgspec"),
    *("multipledispatch", "numpy", "platformdirs", "pyrr", "tomlkit", "trimesh"),
    *("typing_extensions", "yaml"),
}
MOST_MODULES, MOST_FRAMES = 1250, 6  # 1204 and 5 on 2026-11-29


def test_a_start_takes_few_imports_and_few_frames_to_its_first_picture(tmp_path):
    """Numba and what reads other formats come later: in the tracer's thread, or never."""
    script = """
import sys
from stepped import stepped
from lucida.app.window.platform import start_platform
from lucida.app.window.start import begin_scene
from lucida.app.window.viewer import WindowRun

start = begin_scene()
run = WindowRun(start_platform(want_display=False), start.state, (900, 600), remember=False,
                start=start)
frames, modules = 0, []

def step():
    global frames
    frames += 1
    modules[:] = modules or sys.modules

def look(target):
    run.params.app_shall_exit = True

run.on_drawn = look
stepped(run, step)
print(frames, *modules)
"""
    done = run(["-c", script], tmp_path)
    assert done.returncode == 0, done.stderr
    frames, *modules = done.stdout.split()
    packages = {name.partition(".")[0].partition("_3_")[0] for name in modules}
    others = packages - sys.stdlib_module_names - {"__main__", "_distutils_hack"}
    assert others - IMPORTED - {"glimpses", "stepped", "option_changes"} == set()
    assert len(modules) <= MOST_MODULES and int(frames) <= MOST_FRAMES
