"""The bars' backgrounds: drawn by ImGui only where a window floats, which they might cover."""

from __future__ import annotations

import pytest
from imgui_bundle import imgui

from app.host.bars import Bars
from app.images.underlay import Underlay


@pytest.mark.parametrize("floats", [False, True])
def test_imgui_draws_bars_while_a_window_floats(floats: bool) -> None:
    before, context = imgui.get_current_context(), imgui.create_context()
    imgui.set_current_context(context)
    io, bars, underlay = imgui.get_io(), Bars(), Underlay()
    io.set_ini_filename("")  # it would be written to the current folder
    io.display_size, io.delta_time = imgui.ImVec2(200, 200), 1 / 60
    io.backend_flags |= int(imgui.BackendFlags_.renderer_has_textures)

    def alpha(slot: imgui.Col_) -> float:
        return imgui.get_style_color_vec4(slot).w

    slots = imgui.Col_.menu_bar_bg, imgui.Col_.title_bg, imgui.Col_.window_bg
    try:
        for _ in range(3):
            imgui.new_frame()
            bars.begin_frame()
            drawn = [alpha(slot) > 0 for slot in slots]
            bars.show(underlay)
            assert all(alpha(slot) == 1 for slot in slots)
            for name in ("StatusBar", *["box"] * floats):
                imgui.begin(name)
                imgui.end()
            imgui.end_frame()
        assert drawn == [floats] * 3
        assert len(underlay.grounds) == 3
    finally:
        imgui.set_current_context(before) if before is not None else None
        imgui.destroy_context(context)
