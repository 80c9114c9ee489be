"""Text with code in it, between backticks as in source text: set in a fixed-width font."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.ui import theme
from lucida.app.ui.lettering import lettering
from lucida.app.ui.theme import Fonts

TICK = "`"
Measure = Callable[[str, bool], float]  # the width of words, and whether they are code


@dataclass(frozen=True)
class CodedWord:
    """A placed word. x: from the line's beginning. row: from 0."""

    text: str
    is_code: bool
    x: float
    row: int


def is_coded(text: str) -> bool:
    """Return True if the text contains code. A single backtick does not count."""
    return TICK in text and text.count(TICK) % 2 == 0


def placed(text: str, width: float, measure: Measure) -> list[CodedWord]:
    """Place the words in lines of this width. A word that is too wide is broken.

    Neighbouring words of one kind on one line are joined.
    """
    words: list[CodedWord] = []
    x, row, space = 0.0, 0, measure(" ", False)
    gap = False  # whether the next word may begin a line: a space comes before it
    for number, part in enumerate(text.split(TICK)):
        is_code = number % 2 == 1
        for k, word in enumerate(part.split(" ")):
            gap = gap or k > 0
            for piece, is_rest in _pieces(word, is_code, width, measure):
                last = words[-1] if words else None
                start = x + (space if gap and x > 0 else 0.0)
                wide = measure(piece, is_code)
                if is_rest or (last is not None and gap and start + wide > width):
                    start, row = 0.0, row + 1
                elif last is not None and k > 0 and (last.row, last.is_code) == (row, is_code):
                    piece = f"{words.pop().text} {piece}"
                    start, wide = last.x, measure(piece, is_code)
                words.append(CodedWord(piece, is_code, start, row))
                x, gap = start + wide, False
    return words


def _pieces(word: str, is_code: bool, width: float, measure: Measure) -> Iterator[tuple[str, bool]]:
    """Yield the word, or parts of it that fit in a line, and whether each is a continuation."""
    is_rest = False
    while word:
        most = len(word)
        while most > 1 and measure(word[:most], is_code) > width:
            most -= 1
        yield word[:most], is_rest
        word, is_rest = word[most:], True


def coded_text(text: str, width: float, color: ImVec4, fonts: Fonts) -> None:
    """Draw the text at the cursor, in the current font and size, in lines of this width."""
    if not is_coded(text):
        imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + width)
        imgui.text_colored(color, text)
        imgui.pop_text_wrap_pos()
        return
    draw, corner = imgui.get_window_draw_list(), imgui.get_cursor_screen_pos()
    line = imgui.get_text_line_height()
    pad = 0.12 * line
    words = placed(text, width, _measure(fonts))
    for word in words:
        at = corner + ImVec2(word.x, word.row * line)
        if not word.is_code:
            draw.add_text(at, theme.u32(color), word.text)
            continue
        with lettering(fonts.mono):
            far = at + ImVec2(imgui.calc_text_size(word.text).x + pad, line)
            draw.add_rect_filled(at - (pad, 0), far, theme.u32(theme.FRAME), pad)
            draw.add_text(at, theme.u32(color), word.text)
    imgui.dummy((width, _line_count(words) * line))


def _line_count(words: list[CodedWord]) -> int:
    return 1 + (words[-1].row if words else 0)


def _measure(fonts: Fonts) -> Measure:
    def measure(word: str, is_code: bool) -> float:
        with lettering(fonts.mono if is_code else None):
            return float(imgui.calc_text_size(word).x)

    return measure
