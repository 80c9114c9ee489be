"""The mistakes' panel: the program with its wrong lines struck out, the choices of the quiz, and
what is said.

Owns their look. Gets values and returns what was asked for; what is wrong is model.py's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from imgui_bundle import ImVec2, ImVec4, imgui

from app.checking.mistakes.program import Mistake, Mistakes, Program
from app.instruments.mistakes import model
from app.instruments.mistakes.question import LETTERS, switched_to
from app.instruments.outside.paint import role_color
from app.state.options.mistakes import MistakesOptions, Mode
from app.state.options.shared import Notation
from app.ui import theme
from app.ui.areas import press_area
from app.ui.checks import checkbox, radio_button
from app.ui.explaining import symbols
from app.ui.formula import vector_colors
from app.ui.lettering import lettering
from app.ui.rows import button_width, follow
from app.ui.theme import Fonts

Wish = Literal["", "reveal", "next", "right"]

MODES: dict[Mode, tuple[str, str]] = {
    "laboratory": ("laboratory", "switch wrong lines on, and see what they do"),
    "which-line": ("which line?", "a quiz: a wrong picture, and four lines of code"),
    "which-picture": ("which picture?", "a quiz: a wrong line, and four pictures"),
}
LINE = 1.25  # a line's height, in parts of the type's
INSET = 0.6  # left of the code, likewise
POPUP_ROWS = 14
SAID = {True: ", correct", False: ", your answer", None: ""}


@dataclass(frozen=True)
class LineAnswer:
    """A mistake to switch on or off; or, without one, the line to correct."""

    key: str
    mistake: Mistake | None


def wrong_color() -> ImVec4:
    """Return the text colour for a wrong line: that of its camera in the outside view."""
    return theme.legible(role_color("other"))


def controls(options: MistakesOptions, is_asked: bool) -> tuple[MistakesOptions, Wish]:
    """Draw the mode, and the controls of that mode.

    is_asked: there is a question.
    """
    wish: Wish = ""
    mode = _modes(options.mode)
    if mode != options.mode:
        options = switched_to(options, mode)
    if options.mode == "laboratory":
        follow(imgui.calc_text_size("difference").x + 1.5 * imgui.get_frame_height())
        _, on = checkbox("difference", options.difference)
        imgui.set_item_tooltip("a picture of the pixels that the wrong lines change")
        options = replace(options, difference=on)
        if options.chosen and _button("Undo all mistakes", "every line correct again"):
            wish = "right"
        return options, wish
    imgui.begin_disabled(not is_asked or bool(options.answer))
    shown = "hide" if options.revealed and not options.answer else "reveal"
    if _button(f"{shown}###reveal", "which one it is (U)"):
        wish = "reveal"
    imgui.end_disabled()
    if _button("next question", "another one (Shift+U)"):
        wish = "next"
    right, count = options.score
    if count:
        text = f"{right} of {count} correct"
        follow(imgui.calc_text_size(text).x)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, text)
    return options, wish


def _modes(now: Mode) -> Mode:
    """Draw the modes in a row. Return the selected one."""
    for number, (mode, (name, said)) in enumerate(MODES.items()):
        if number:
            follow(imgui.calc_text_size(name).x + 1.5 * imgui.get_frame_height())
        if radio_button(f"{name}##mode", now == mode):
            now = mode
        imgui.set_item_tooltip(said)
    return now


def _button(label: str, said: str) -> bool:
    follow(button_width(label))
    clicked = bool(imgui.button(label))
    imgui.set_item_tooltip(said)
    return clicked


# The program.


def rows_of(instead: str | None, letters: int) -> list[str]:
    """Return the rows that are shown instead of a line."""
    return [] if instead is None else model.folded(instead, letters)


def letters_in(width: float) -> int:
    """Return the number of letters of code that fit, between an inset and a caret."""
    return max(8, int((width / imgui.get_font_size() - INSET - 1.6) * 2))


def program_lines(
    program: Program,
    mistakes: Mistakes,
    width: float,
    fonts: Fonts,
    notation: Notation,
    can_change: bool = True,
) -> LineAnswer | None:
    """The program: what is wrong struck out, and what is written instead below it. A click on a
    line opens what may be wrong in it."""
    size_px, letters = imgui.get_font_size(), letters_in(width)
    answer = None
    height = LINE * size_px
    for line in program.text(mistakes):
        rows = model.folded(line.code, letters)
        instead = rows_of(line.instead, letters)
        corner = imgui.get_cursor_screen_pos()
        extent = ImVec2(width, height * (len(rows) + len(instead)))
        draw, popup = imgui.get_window_draw_list(), f"mistakes of {line.key}"
        if can_change:
            if press_area(f"line {line.key}", extent):
                imgui.open_popup(popup)
            if imgui.is_item_hovered() or imgui.is_item_focused() or imgui.is_popup_open(popup):
                far = ImVec2(corner.x + width, corner.y + extent.y)
                draw.add_rect_filled(corner, far, theme.u32(theme.FRAME_HOVERED), theme.px(3))
            if not mistakes:  # then the line below is what is to be read
                left = line.code.partition(" = ")[0]
                imgui.set_item_tooltip(f"what may be wrong in the line of {left}: click")
        else:
            imgui.dummy(extent)
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
                    _vectors(draw, at, text, notation)
                if is_struck:
                    _strike(draw, at, text, wrong)
        if can_change:
            caret = ImVec2(corner.x + width - 1.1 * size_px, corner.y + 0.5 * height)
            _caret(draw, caret, 0.28 * size_px)
            answer = _popup(popup, program, line.key, mistakes, width, fonts) or answer
    return answer


def _vectors(draw: imgui.ImDrawList, at: ImVec2, text: str, notation: Notation) -> None:
    """Draw the vectors of a line once more, in the colours that they have in formulas."""
    letter = imgui.calc_text_size("0").x
    for column, word, name in symbols.vectors(text, notation):
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
    """The mistakes of a line, by their names, with the code of each."""
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
                    imgui.text_unformatted("\n".join(rows_of(code, letters_in(width))))
            imgui.unindent()
            imgui.pop_style_color()
    imgui.end_popup()
    return answer


# The quiz.


def choose_line(
    choices: Sequence[tuple[str, ...]], verdicts: Sequence[bool | None], width: float, fonts: Fonts
) -> int | None:
    """Draw four choices of code with their letters, and the verdicts. Return the clicked one."""
    clicked = None
    imgui.push_style_var(imgui.StyleVar_.button_text_align, ImVec2(0.0, 0.5))
    for letter, rows, verdict in zip(LETTERS, choices, verdicts, strict=True):
        text = "\n   ".join(rows)
        said = f"{SAID[verdict]}\n" if verdict is not None else ""
        imgui.push_style_color(imgui.Col_.text, verdict_color(verdict) or wrong_color())
        with lettering(fonts.mono):
            if imgui.button(f"{letter}{said}  {text}###choice {letter}", ImVec2(width, 0.0)):
                clicked = LETTERS.index(letter)
        imgui.pop_style_color()
    imgui.pop_style_var()
    return clicked


def verdict_color(verdict: bool | None) -> ImVec4 | None:
    if verdict is None:
        return None
    return theme.GOOD if verdict else theme.legible(theme.ERROR)


def key_answer() -> int | None:
    """The answer whose key was pressed while the view has the keyboard: 1 to 4, or A to D."""
    key, focused = imgui.Key, int(imgui.InputFlags_.route_focused)
    table = (
        (key._1, key.keypad1, key.a),
        (key._2, key.keypad2, key.b),
        (key._3, key.keypad3, key.c),
        (key._4, key.keypad4, key.d),
    )
    for number, keys in enumerate(table):
        if any([imgui.shortcut(int(one), focused) for one in keys]):
            return number
    return None
