"""A double click that is faster than frames is one, and what is typed after it is text."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from imgui_bundle import ImVec2, imgui

from lucida.app.window.clicks import ClickTime


@pytest.fixture
def io() -> Iterator[imgui.IO]:
    before = imgui.get_current_context()
    imgui.set_current_context(context := imgui.create_context())
    io = imgui.get_io()
    io.set_ini_filename("")  # it would be written to the current folder
    io.display_size = ImVec2(400, 300)
    io.backend_flags |= int(imgui.BackendFlags_.renderer_has_textures)
    yield io
    imgui.set_current_context(before) if before is not None else None
    imgui.destroy_context(context)


class Panel:
    """Two fields, drawn in frames that take frame_s each. shortcuts: digits that no field took."""

    def __init__(self, io: imgui.IO, frame_s: float, clicks: ClickTime | None) -> None:
        self.io, self.clicks, self.now_s = io, clicks, 0.0
        self.values, self.shortcuts, self.middles = [1.0, 2.0], 0, [ImVec2(0, 0)] * 2
        io.delta_time = frame_s

    def frame(self) -> None:
        if self.clicks is not None:
            self.clicks.begin_frame(self.now_s)
        imgui.new_frame()
        imgui.begin("panel")
        for number, value in enumerate(self.values):
            self.values[number] = imgui.drag_float(f"##{number}", value)[1]
            low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
            self.middles[number] = ImVec2((low.x + high.x) / 2, (low.y + high.y) / 2)
        pressed = imgui.is_key_pressed(imgui.Key._5, False)
        self.shortcuts += pressed and not self.io.want_text_input
        imgui.end()
        imgui.end_frame()
        self.now_s += self.io.delta_time
        if self.clicks is not None:
            self.clicks.end_frame(self.now_s)

    def double_click_and_type(self, field: int) -> None:
        """All between two frames, as while the window is busy."""
        for _ in range(3):
            self.frame()
        self.io.add_mouse_pos_event(self.middles[field].x, self.middles[field].y)
        for is_down in (True, False, True, False):
            self.io.add_mouse_button_event(0, is_down)
        for is_down in (True, False):
            self.io.add_key_event(imgui.Key._5, is_down)
            if is_down:
                self.io.add_input_character(ord("5"))
        for is_down in (True, False):
            self.io.add_key_event(imgui.Key.enter, is_down)
        for _ in range(12):
            self.frame()


@pytest.mark.parametrize("frame_s", [1 / 60, 0.2, 0.5, 1.5])
@pytest.mark.parametrize("field", [0, 1])
def test_the_clicked_field_takes_what_is_typed(io: imgui.IO, frame_s: float, field: int) -> None:
    panel = Panel(io, frame_s, ClickTime())
    panel.double_click_and_type(field)
    assert panel.values == [5.0, 2.0] if field == 0 else [1.0, 5.0]
    assert panel.shortcuts == 0


def test_without_it_digits_are_shortcuts(io: imgui.IO) -> None:
    """Else there would be nothing to do for it."""
    panel = Panel(io, 0.5, None)
    panel.double_click_and_type(0)
    assert panel.values == [1.0, 2.0] and panel.shortcuts == 1


def test_slow_single_clicks_stay_single(io: imgui.IO) -> None:
    """Frames that are quick again do not join two clicks that are apart."""
    panel = Panel(io, 0.5, ClickTime())
    panel.frame()
    io.delta_time = 0.1
    for _ in range(3):
        panel.frame()
    io.add_mouse_pos_event(panel.middles[0].x, panel.middles[0].y)
    for is_down in (True, False):
        io.add_mouse_button_event(0, is_down)
    for _ in range(9):
        panel.frame()
    for is_down in (True, False):
        io.add_mouse_button_event(0, is_down)
    panel.frame()
    assert not imgui.is_mouse_double_clicked(0)
