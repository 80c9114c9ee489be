"""Texts broken into lines and put into their places."""

from __future__ import annotations

import numpy as np
import pytest

from app.lecture.flow import Laid, Piece, PieceSize, fitted, lay
from app.lecture.text import parse


def measure(piece: Piece) -> PieceSize:
    """Letters half as wide as high; formulas twice as high as their text, as fractions are."""
    high = 2.0 if piece.style == "math" else 1.0
    return PieceSize(
        0.5 * piece.size * len(piece.text), 0.8 * high * piece.size, 0.2 * high * piece.size
    )


def laid(text: str, width: float = 100.0, size: float = 10.0) -> Laid:
    return lay(parse(text), width, size, measure)


def rows(result: Laid) -> list[list[str]]:
    """The pieces by their baselines."""
    found: dict[float, list[str]] = {}
    for placed in result.pieces:
        found.setdefault(placed.baseline, []).append(placed.piece.text)
    return [found[baseline] for baseline in sorted(found)]


def test_lines_break_between_words_only():
    result = laid("one two three four five six seven")
    assert rows(result) == [["one", "two", "three", "four"], ["five", "six", "seven"]]
    assert all(p.x + measure(p.piece).width <= 100 for p in result.pieces)
    # A word that is wider than the column has a line to itself.
    assert rows(laid("a " + 30 * "b" + " c")) == [["a"], [30 * "b"], ["c"]]


def test_signs_stay_with_the_formulas_that_they_touch():
    pieces = laid("word ($x$), end").pieces
    texts = [placed.piece.text for placed in pieces]
    assert texts == ["word", "(", "x", "),", "end"]
    opened, formula, closed = pieces[1:4]
    assert formula.x == opened.x + measure(opened.piece).width
    assert closed.x == formula.x + measure(formula.piece).width
    # The three are never apart: all of them go to the next line.
    assert rows(laid("word word word w ($x$), end")) == [
        ["word", "word", "word", "w"],
        ["(", "x", "),", "end"],
    ]


def test_where_everything_stands():
    """By hand, for text of size 10: a line is 13.2 high, its baseline 9.6 below its top."""
    text = (
        "# Head\n\nText *is* **so** `code`.\n\n- a\n- b\n\n1. x\n\n> Why?\n\n$$\nx\n$$\n\n"
        "```\nif x:\n\n    y\n```\n"
    )
    result = laid(text, 200)
    found = [
        (p.piece.text, p.piece.style, p.piece.size, p.x, p.baseline, p.kind) for p in result.pieces
    ]
    expected = [
        ("Head", "bold", 12.5, 0, 12, "heading"),  # to 16.5
        ("Text", "text", 10, 0, 32.3, "text"),  # from 6.2 below
        ("is", "italic", 10, 25, 32.3, "text"),
        ("so", "bold", 10, 40, 32.3, "text"),
        ("code", "code", 9.2, 55, 32.3, "text"),
        (".", "text", 10, 73.4, 32.3, "text"),  # to 35.9
        ("a", "text", 10, 12.5, 51.7, "item"),
        ("•", "text", 10, 3.5, 51.7, "mark"),  # its right edge 4 before the item
        ("b", "text", 10, 12.5, 67.9, "item"),  # 3 between items
        ("•", "text", 10, 3.5, 67.9, "mark"),  # to 71.5
        ("x", "text", 10, 14, 87.3, "item"),  # the mark is wide
        ("1.", "text", 10, 0, 87.3, "mark"),  # to 90.9
        ("Why?", "text", 10, 8, 110.2, "question"),  # 3.5 above and below it
        ("x", "math", 11.2, 12.5, 142.92, "formula"),  # 1.5 above and below 17.92 + 4.48
        ("if x:", "code", 9.2, 5, 167.46, "code"),  # 5 above it
        ("    y", "code", 9.2, 5, 190.46, "code"),
    ]
    assert [piece[:2] + piece[5:] for piece in found] == [
        piece[:2] + piece[5:] for piece in expected
    ]
    np.testing.assert_allclose([p[2:5] for p in found], [p[2:5] for p in expected], atol=1e-9)
    assert [p.piece.display for p in result.pieces].index(True) == 13
    assert [p.piece.display for p in result.pieces].count(True) == 1
    assert [box.kind for box in result.boxes] == ["question", "code"]
    edges = [(box.left, box.top, box.right, box.bottom) for box in result.boxes]
    np.testing.assert_allclose(edges, [(0, 97.1, 200, 117.3), (0, 155.1, 200, 198.68)])
    assert result.height == pytest.approx(198.68)
    assert result.width == pytest.approx(78.4)


def test_the_numbers_of_a_long_list_do_not_reach_its_items():
    result = laid("\n".join(f"{k}. item" for k in range(1, 13)), 200)
    marks = [placed for placed in result.pieces if placed.kind == "mark"]
    assert [mark.piece.text for mark in marks] == [f"{k}." for k in range(1, 13)]
    (item,) = {placed.x for placed in result.pieces if placed.kind == "item"}
    assert {mark.x + measure(mark.piece).width for mark in marks} == {item - 4}
    assert min(mark.x for mark in marks) == 0


def test_lines_are_filled_to_the_last_pixel():
    """A word is 5 wide a letter, a space 5."""
    assert rows(laid("abcd efgh", 45)) == [["abcd", "efgh"]]
    assert rows(laid("abcd efgh", 44.9)) == [["abcd"], ["efgh"]]
    assert laid("abcd efgh", 44.9).height == pytest.approx(26.4)
    # A row's air stands above and below the highest: formulas are twice as high.
    assert laid("a $x$ b").pieces[0].baseline == pytest.approx(1.6 + 16)
    assert laid("a $x$ b").height == pytest.approx(1.6 + 20 + 1.6)


def test_a_wide_formula_gives_way_down_to_a_size():
    """A letter is 5.6 wide, the room beside the indent 87.5."""

    def of(letters: int) -> Piece:
        (placed,) = laid(f"$$\n{letters * 'x'}\n$$").pieces
        return placed.piece

    assert of(15).size == pytest.approx(11.2)
    assert of(16).size == pytest.approx(11.2 * 0.98 * 87.5 / (16 * 5.6)) and of(16).display
    assert of(40).size == pytest.approx(0.6 * 11.2)
    # As wide as the room, it is left alone.
    (placed,) = lay(parse("$$x$$"), 62.5, 10, lambda _: PieceSize(50, 8, 2)).pieces
    assert placed.piece.size == pytest.approx(11.2)


def test_code_gives_way_to_what_is_inside_its_box():
    """Of a box 100 wide, 5 on each side; a letter is 4.6 wide."""

    def size(letters: int, width: float = 100.0) -> float:
        return laid("```\n" + letters * "x" + "\n```", width).pieces[0].piece.size

    assert size(19) == pytest.approx(9.2)
    assert size(20) == pytest.approx(9.2 * 90 / 92)
    assert size(60) == pytest.approx(9.2 / 2)  # no smaller
    assert laid("```\n```").height == pytest.approx(5 + 11.5 + 5 - 0.92)  # an empty line


def test_code_with_letters_of_whole_pixels_keeps_no_text_small():
    """Its type gives way until its lines do; not the text above it, which has room."""

    def in_pixels(piece: Piece) -> PieceSize:
        one = measure(piece)
        wide = len(piece.text) * round(0.5 * piece.size) if piece.style == "code" else one.width
        return PieceSize(wide, one.ascent, one.descent)

    blocks = parse("Large.\n\n```\n" + 40 * "x" + "\n```")
    for width in range(230, 400, 10):
        result, size = fitted(blocks, (width, 1000), (5, 20), in_pixels)
        assert size == 20, width
        code = [placed for placed in result.pieces if placed.kind == "code"]
        assert all(placed.x + in_pixels(placed.piece).width <= width for placed in code)


def test_sizes_are_tried_from_the_largest_down_by_a_twentieth():
    """One line of four letters: half as wide as they are high, together, and 1.32 times as high."""
    blocks = parse("abcd")

    def size(width: float, height: float, smallest: float = 1.0) -> float:
        return fitted(blocks, (width, height), (smallest, 10.0), measure)[1]

    assert size(100, 13.2 + 1e-9) == 10  # exactly
    assert size(100, 13.2 - 1e-9) == 9.5
    # By a pixel it may be wider, which rounding takes.
    assert size(19, 100) == 10
    assert size(18.9, 100) == 9.5
    assert size(18, 100) == 9.5
    assert size(17.9, 100) == pytest.approx(9.025)
    assert size(100, 5, smallest=9.9) == 9.9
    assert fitted(parse(""), (0, 0), (1, 10.0), measure)[1] == 10


def test_an_empty_text_takes_no_room():
    assert laid("").height == laid("").width == 0
    assert laid("- ` `\n- a").pieces[0].baseline == 0  # the mark of an item without words
