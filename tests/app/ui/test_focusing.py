"""ImGui without a window: letters typed right after Tab go to the next field, and a tooltip
comes before frames end."""

from collections.abc import Iterator

import pytest
from imgui_bundle import hello_imgui, imgui

from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.background import Background
from lucida.app.ui.focusing import Focusing
from lucida.app.window.platform import Platform
from lucida.app.window.viewer import WindowRun
from lucida.renderer.files import load_scene

FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
KEYS = {"3": imgui.Key._3, "1": imgui.Key._1, "4": imgui.Key._4, "\t": imgui.Key.tab}


@pytest.fixture
def io(monkeypatch: pytest.MonkeyPatch) -> Iterator[imgui.IO]:
    monkeypatch.setattr(hello_imgui, "request_refresh", lambda: None)
    context = imgui.create_context()
    io = imgui.get_io()
    io.display_size = (800, 600)
    io.set_ini_filename("")
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
    io.config_flags |= imgui.ConfigFlags_.nav_enable_keyboard
    yield io
    imgui.destroy_context(context)


class Box:
    """Two fields and a button."""

    def __init__(self) -> None:
        self.texts = {"row": "181", "column": "241"}
        self.focusing = Focusing()
        self.begun = False
        self.is_pressed = self.has_tooltip = False

    def frame(self, time_s: float = 1 / 60) -> None:
        """Draw a frame after the one before has taken a time."""
        imgui.get_io().delta_time = time_s
        self.focusing.before_frame()
        imgui.new_frame()
        self.focusing.begin_frame()
        imgui.begin("box")
        for name in self.texts:
            if not self.begun:
                imgui.set_keyboard_focus_here()
                self.begun = True
            _, self.texts[name] = imgui.input_text(f"##{name}", self.texts[name], int(FLAGS))
        self.is_pressed |= imgui.button("Go")
        self.has_tooltip = imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip)
        imgui.end()
        imgui.render()
        for texture in imgui.get_platform_io().textures:
            texture.set_status(imgui.ImTextureStatus.ok)


@pytest.mark.parametrize("slow_s", [1 / 60, 0.27, 0.5, 3.0])
def test_what_is_typed_after_tab_is_in_the_next_field_however_slow_the_frame(
    io: imgui.IO, slow_s: float
) -> None:
    box = Box()
    for _ in range(5):
        box.frame()
    for letter in "31\t41":  # all in one frame
        io.add_key_event(KEYS[letter], True)
        if letter != "\t":
            io.add_input_character(ord(letter))
        io.add_key_event(KEYS[letter], False)
    for _ in range(40):
        box.frame(slow_s if imgui.get_current_context().nav_move_submitted else 1 / 60)
    io.add_key_event(imgui.Key.enter, True)
    for _ in range(3):
        box.frame()
    assert box.texts == {"row": "31", "column": "41"}
    assert not box.is_pressed


def test_frames_are_drawn_until_a_tooltip_is_shown_and_not_twice_as_long(
    io: imgui.IO, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Background, "wake_window", None)  # a window sets it
    state = AppState.for_scene(load_scene("spheres"))
    run = WindowRun(Platform(True), state, (9, 9), remember=False)
    run.window.end()
    theme.begin(state.preferences)
    box, frames = Box(), 0
    for _ in range(5):
        box.frame()
    for is_down in 2 * (True, False):
        io.add_key_event(imgui.Key.tab, is_down)
    while not box.has_tooltip:  # of the keyboard's button; the mouse must be at rest
        box.frame()
        frames += 1
    longest_s = max(frames / 60, theme.SIZES["hover_stationary_delay"])
    assert longest_s < run.params.fps_idling.time_active_after_last_event < 2 * longest_s
