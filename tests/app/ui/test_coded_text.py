"""Words with code in them take as many lines as they need."""

from __future__ import annotations

import pytest
from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.coded_text import coded_text


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_words_are_measured_in_the_size_that_they_are_drawn_in(scale: float) -> None:
    context = imgui.create_context()
    imgui.set_current_context(context)
    io = imgui.get_io()
    io.display_size = (800, 600)
    io.set_ini_filename("")
    io.backend_flags |= int(imgui.BackendFlags_.renderer_has_textures)
    font = io.fonts.add_font_default()
    imgui.get_style().font_scale_main = scale
    imgui.new_frame()
    imgui.begin("words")
    imgui.push_font(font, theme.TEXT_PX)
    text = "as if `a b`, not `c`."
    width = imgui.calc_text_size(text.replace("`", "")).x
    heights = []
    for room in (width + 1, 0.7 * width):
        coded_text(text, room, theme.TEXT, theme.Fonts(font, font, font))
        heights.append(imgui.get_item_rect_size().y / imgui.get_text_line_height())
    imgui.pop_font()
    imgui.end()
    imgui.end_frame()
    imgui.destroy_context(context)
    assert heights == [1.0, 2.0]
