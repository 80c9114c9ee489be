"""Letters typed right after Tab go to the next field: ImGui without a window."""

from collections.abc import Iterator

import pytest
from imgui_bundle import hello_imgui, imgui

from lucida.app.ui.focusing import Focusing

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
        self.is_pressed = False

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
