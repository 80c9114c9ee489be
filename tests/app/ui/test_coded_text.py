"""Words with code in them: where each stands, whatever the width."""

from __future__ import annotations

import pytest
from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.coded_text import coded_text, is_coded, placed


def measure(text: str, is_code: bool) -> float:
    """Code is twice as wide."""
    return len(text) * (2.0 if is_code else 1.0)


def lines(text: str, width: float) -> list[list[tuple[str, bool, float]]]:
    words = placed(text, width, measure)
    return [
        [(word.text, word.is_code, word.x) for word in words if word.row == row]
        for row in range(1 + max(word.row for word in words))
    ]


def test_a_tick_without_its_other_is_no_code() -> None:
    assert is_coded("as `x = 1`, not `y`")
    assert not is_coded("it's `x") and not is_coded("no code")


def test_code_and_words_stand_beside_one_another() -> None:
    assert lines("as if `a b`, not `c`.", 100) == [
        [
            ("as if", False, 0.0),
            ("a b", True, 6.0),
            (", not", False, 12.0),
            ("c", True, 18.0),
            (".", False, 20.0),
        ]
    ]


@pytest.mark.parametrize("width", [5, 8, 13, 21, 34])
def test_lines_have_room_and_nothing_is_lost(width: int) -> None:
    text = "As if it read `x = left + j / width`, not `w = normalize(target - eye)` here."
    found = lines(text, width)
    for row in found:
        ends = [x + measure(word, is_code) for word, is_code, x in row]
        assert all(end <= width for end in ends[:-1])
        assert ends[-1] <= width + 1  # a full stop stays at its word
        assert all(x >= end for (_, _, x), end in zip(row[1:], ends, strict=False))
        assert row[0][2] == 0.0
    told = "".join(word for row in found for word, _, _ in row).replace(" ", "")
    assert told == text.replace("`", "").replace(" ", "")
    code = "".join(word for row in found for word, is_code, _ in row if is_code).replace(" ", "")
    assert code == "x=left+j/widthw=normalize(target-eye)"


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
