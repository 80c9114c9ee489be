"""The window on a display of 200 %: type and spacing double, the images are sharp and agree."""

import numpy as np
from launching import launch
from PIL import Image

SCRIPT = """
from pathlib import Path
from imgui_bundle import imgui
from lucida.app.ui import theme
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun, save_png
from lucida.renderer.files import load_scene

state = AppState.for_scene(load_scene("spheres"))
state = state.with_options(state.options.with_changes({"preferences": {"font_scale": 1.25}}))
run = WindowRun(start_platform(want_display=False), state, (1700, 1080), take_picture=True)
run.params.dpi_aware_params.dpi_window_size_factor = 2.0
told = []

def look():
    style = imgui.get_style()
    told[:] = [imgui.get_font_size(), style.frame_padding.x, theme.line_px(), style._main_scale]

run.params.callbacks.post_new_frame = look
save_png(Path("out.png"), run.run())
verdict = run.window.renderers.verdict(run.window.state)
print(*told, verdict.comparison.unexplained, *run.window.renderers.size)
"""


def test_everything_is_twice_as_large(tmp_path):
    done = launch(["-c", SCRIPT], tmp_path)
    assert done.returncode == 0, done.stderr
    font, padding, line, main, unexplained, width, height = map(float, done.stdout.split())
    scale = 2 * 1.25
    assert (font, padding, line, main) == (16 * scale, 6 * scale, scale, scale)
    assert unexplained == 0
    picture = np.asarray(Image.open(tmp_path / "out.png").convert("RGB"))
    # As many pixels as the screen has for them: half the window, less the camera's panel.
    assert width > 0.2 * picture.shape[1]
    assert height > 0.5 * picture.shape[0]
    assert picture.std() > 20
