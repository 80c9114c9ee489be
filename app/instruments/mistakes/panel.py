"""The mistakes' panel: the program, with a list of mistakes for each line.

Takes values and returns the user's requests.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.checking.mistakes.program import Mistake, Mistakes, Program
from lucida.app.instruments.outside.paint import role_color
from lucida.app.ui import theme
from lucida.app.ui.areas import press_area
from lucida.app.ui.explaining import symbols
from lucida.app.ui.formula import vector_colors
from lucida.app.ui.lettering import lettering
from lucida.app.ui.theme import Fonts

from . import model

LINE = 1.25  # a line's height, relative to the type's
INSET = 0.6  # left of the code, relative to the type's height
POPUP_ROWS = 14


@dataclass(frozen=True)
class LineAnswer:
    """A mistake to switch on or off; without one, the line to correct."""

    key: str
    mistake: Mistake | None


def wrong_color() -> ImVec4:
    """Return the text colour for a wrong line, that of its camera in the outside view."""
    return theme.legible(role_color("other"))


def letters_in(width: float) -> int:
    """Return the number of letters of code that fit, between an inset and a caret."""
    return max(8, int((width / imgui.get_font_size() - INSET - 1.6) * 2))


def program_lines(
    program: Program,
    mistakes: Mistakes,
    width: float,
    fonts: Fonts,
) -> LineAnswer | None:
    """Draw the program, with correct code struck out above the wrong code that replaces it.

    A click on a line opens the list of its mistakes.
    """
    size_px, letters = imgui.get_font_size(), letters_in(width)
    answer = None
    height = LINE * size_px
    for line in program.text(mistakes):
        rows = model.folded(line.code, letters)
        instead = [] if line.instead is None else model.folded(line.instead, letters)
        corner = imgui.get_cursor_screen_pos()
        extent = ImVec2(width, height * (len(rows) + len(instead)))
        draw, popup = imgui.get_window_draw_list(), f"mistakes of {line.key}"
        if press_area(f"line {line.key}", extent):
            imgui.open_popup(popup)
        if imgui.is_item_hovered() or imgui.is_item_focused() or imgui.is_popup_open(popup):
            far = ImVec2(corner.x + width, corner.y + extent.y)
            draw.add_rect_filled(corner, far, theme.u32(theme.FRAME_HOVERED), theme.px(3))
        if not mistakes:  # A tooltip would hide the wrong code in the line below.
            left = line.code.partition(" = ")[0]
            imgui.set_item_tooltip(f"click for possible mistakes in the line of {left}")
        wrong = wrong_color()
        with lettering(fonts.mono):
            for number, text in enumerate([*rows, *instead]):
                is_struck = number < len(rows) and line.instead is not None
                is_wrong = number >= len(rows)
                at = ImVec2(corner.x + INSET * size_px, corner.y + number * height)
                at.y += 0.5 * (height - imgui.get_text_line_height())
                color = wrong if is_wrong else theme.DIM if is_struck else theme.TEXT
                draw.add_text(at, theme.u32(color), text)
                if not (is_wrong or is_struck):
                    _vectors(draw, at, text)
                if is_struck:
                    _strike(draw, at, text, wrong)
        caret = ImVec2(corner.x + width - 1.1 * size_px, corner.y + 0.5 * height)
        _caret(draw, caret, 0.28 * size_px)
        answer = _popup(popup, program, line.key, mistakes, width, fonts) or answer
    return answer


def _vectors(draw: imgui.ImDrawList, at: ImVec2, text: str) -> None:
    """Draw the vectors of a line again, in their colours in formulas."""
    letter = imgui.calc_text_size("0").x
    for column, word, name in symbols.vectors(text):
        color = theme.legible(vector_colors().get(name, theme.TEXT))
        draw.add_text(ImVec2(at.x + column * letter, at.y), theme.u32(color), word)


def _strike(draw: imgui.ImDrawList, at: ImVec2, text: str, color: ImVec4) -> None:
    indent = imgui.calc_text_size(text[: len(text) - len(text.lstrip())]).x
    y = at.y + 0.52 * imgui.get_text_line_height()
    end = at.x + imgui.calc_text_size(text).x
    width = max(theme.px(1), 0.06 * imgui.get_font_size())
    draw.add_line(ImVec2(at.x + indent, y), ImVec2(end, y), theme.u32(color), width)


def _caret(draw: imgui.ImDrawList, at: ImVec2, half: float) -> None:
    draw.add_triangle_filled(
        ImVec2(at.x - half, at.y - 0.5 * half),
        ImVec2(at.x + half, at.y - 0.5 * half),
        ImVec2(at.x, at.y + 0.7 * half),
        theme.u32(theme.PLAIN),
    )


def _popup(
    name: str, program: Program, key: str, mistakes: Mistakes, width: float, fonts: Fonts
) -> LineAnswer | None:
    """Draw the list of a line's mistakes, each with its name and its code."""
    row = 2.1 * imgui.get_text_line_height_with_spacing()
    imgui.set_next_window_size_constraints(ImVec2(0, 0), ImVec2(max(width, 20.0), POPUP_ROWS * row))
    if not imgui.begin_popup(name):
        return None
    answer = None
    chosen = {mistake.name for mistake in mistakes}
    is_right = not any(key in mistake.keys for mistake in mistakes)
    if imgui.menu_item("correct", "", is_right)[0]:
        answer = LineAnswer(key, None)
    for mistake in model.of_line(program, key):
        if imgui.menu_item(mistake.name, "", mistake.name in chosen)[0]:
            answer = LineAnswer(key, mistake)
        imgui.set_item_tooltip(mistake.hint.replace("`", ""))
        with lettering(fonts.mono):
            imgui.push_style_color(imgui.Col_.text, theme.DIM)
            imgui.indent()
            for line_key, code in mistake.lines:
                if line_key == key:
                    imgui.text_unformatted("\n".join(model.folded(code, letters_in(width))))
            imgui.unindent()
            imgui.pop_style_color()
    imgui.end_popup()
    return answer
