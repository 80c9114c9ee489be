"""The window where a driver does not take a shader: it opens, says so, and tries again."""

import json
import sys

import numpy as np
import pytest
from launching import launch
from PIL import Image
from test_window import one_window

pytestmark = one_window

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
run = WindowRun(start_platform(want_display=False), state, (800, 520), remember=False)
window, told = run.window, {}

def read(name):
    text = good(name)
    return text + "oh no;\\n" if name == broken else text

sources.read_shader = read

def failure():
    stage = window.shell.stage
    return window.renderers.failure or stage.failed.errors.get(view)

def is_told():
    both = broken == "display.frag"  # which both images go through
    traced = window.renderers.ray_image is not None  # whether it can be shown or not
    return traced and failure() is not None and both == (window.renderers.ray_error is not None)

def step():
    shown = window.shell.stage.rects
    if shown and view not in shown:
        window.shell.stage.show(view)
    elif told:
        if run.on_drawn is None and failure() is None and window.settled:
            told["mended"] = True
            run.params.app_shall_exit = True
    elif is_told():
        told["error"] = str(failure())
        run.on_drawn = picture

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
    done = launch(["-c", WINDOW, shader, view], tmp_path)
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["error"].startswith(f"shaders/{shader}: ")
    assert "update the graphics driver" in told["error"]
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
    done = launch(["-c", script], tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1, done.stderr
    assert "shaders/shade.frag" in done.stderr
    assert not (tmp_path / "out.png").exists()


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
import sys, threading
from stepped import stepped
from lucida.app.window.platform import start_platform
from lucida.app.window.start import begin_scene
from lucida.app.window.viewer import WindowRun

start = begin_scene()
run = WindowRun(start_platform(want_display=False), start.state, (900, 600), remember=False,
                start=start)
frames, modules = 0, set()

def hear(event, arguments):
    if event == "import" and threading.current_thread() is threading.main_thread():
        modules.add(arguments[0])

def step():
    global frames
    frames += 1
    modules.update(sys.modules if frames == 1 else ())

def look(target):
    run.on_drawn = None
    print(frames, *modules)
    run.params.app_shall_exit = True

sys.addaudithook(hear)
run.on_drawn = look
stepped(run, step)
"""
    done = launch(["-c", script], tmp_path, fresh=True)
    assert done.returncode == 0, done.stderr
    frames, *modules = done.stdout.split()
    packages = {name.partition(".")[0].partition("_3_")[0] for name in modules}
    others = packages - sys.stdlib_module_names - {"__main__", "_distutils_hack"}
    assert others - IMPORTED - {"glimpses", "stepped", "option_changes"} == set()
    assert len(modules) <= MOST_MODULES and int(frames) <= MOST_FRAMES
