"""Texts broken into lines and put into their places."""

import numpy as np
import pytest

from lucida.app.lecture.flow import PieceSize, lay
from lucida.app.lecture.text import parse


def measure(piece):
    """Letters half as wide as high; formulas twice as high as their text, as fractions are."""
    high = 2.0 if piece.style == "math" else 1.0
    return PieceSize(
        0.5 * piece.size * len(piece.text), 0.8 * high * piece.size, 0.2 * high * piece.size
    )


def laid(text, width=100.0, size=10.0):
    return lay(parse(text), width, size, measure)


def rows(result):
    """The pieces by their baselines."""
    found = {}
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


def test_everything_stands_where_it_was_computed_by_hand():
    """By hand, for text of size 10: a line is 11.8 high, its baseline 8.9 below its top."""
    text = (
        "# Head\n\nText *is* **so** `code`.\n\n- a\n- b\n\n1. x\n\n> Why?\n\n$$\nx\n$$\n\n"
        "```\nif x:\n\n    y\n```\n"
    )
    result = laid(text, 200)
    found = [
        (p.piece.text, p.piece.style, p.piece.size, p.x, p.baseline, p.kind) for p in result.pieces
    ]
    expected = [
        ("Head", "bold", 12.5, 0, 11.125, "heading"),  # to 14.75
        ("Text", "text", 10, 0, 28.65, "text"),  # from 5 below
        ("is", "italic", 10, 25, 28.65, "text"),
        ("so", "vector", 10, 40, 28.65, "text"),
        ("code", "code", 10, 55, 28.65, "text"),
        (".", "text", 10, 75, 28.65, "text"),  # to 31.55
        ("a", "text", 10, 12.5, 45.45, "item"),
        ("•", "text", 10, 3.5, 45.45, "mark"),  # its right edge 4 before the item
        ("b", "text", 10, 12.5, 59.25, "item"),  # 2 between items
        ("•", "text", 10, 3.5, 59.25, "mark"),  # to 62.15
        ("x", "text", 10, 14, 76.05, "item"),  # the mark is wide
        ("1.", "text", 10, 0, 76.05, "mark"),  # to 78.95
        ("Why?", "text", 10, 8, 96.35, "question"),  # 3.5 above and below it
        ("x", "math", 10, 12.5, 125.25, "formula"),  # 1.5 above and below 16 + 4
        ("if x:", "code", 10, 5, 148.75, "code"),  # 5 above it
        ("    y", "code", 10, 5, 170.75, "code"),
    ]
    assert [piece[:2] + piece[5:] for piece in found] == [
        piece[:2] + piece[5:] for piece in expected
    ]
    np.testing.assert_allclose([p[2:5] for p in found], [p[2:5] for p in expected], atol=1e-9)
    assert [p.piece.display for p in result.pieces].index(True) == 13
    assert [p.piece.display for p in result.pieces].count(True) == 1
    assert [box.kind for box in result.boxes] == ["question", "code"]
    edges = [(box.left, box.top, box.right, box.bottom) for box in result.boxes]
    np.testing.assert_allclose(edges, [(0, 83.95, 200, 102.75), (0, 135.75, 200, 177.75)])
    assert result.height == pytest.approx(177.75)
    assert result.width == pytest.approx(80.0)


def test_the_numbers_of_a_long_list_do_not_reach_its_items():
    result = laid("\n".join(f"{k}. item" for k in range(1, 13)), 200)
    marks = [placed for placed in result.pieces if placed.kind == "mark"]
    assert [mark.piece.text for mark in marks] == [f"{k}." for k in range(1, 13)]
    (item,) = {placed.x for placed in result.pieces if placed.kind == "item"}
    assert {mark.x + measure(mark.piece).width for mark in marks} == {item - 4}
    assert min(mark.x for mark in marks) == 0


def test_what_is_too_wide_goes_on_in_the_next_row():
    """The column is 100 wide, of which code has 90; a letter is 5 wide. Sizes stay."""
    formula = laid("$$\nabcdefgh = ijklmnop + qrstuvw\n$$").pieces
    assert [placed.piece.text for placed in formula] == ["abcdefgh = ijklmnop", "+ qrstuvw"]
    assert [placed.x for placed in formula] == [5, 5]  # indented as far as there is room
    code = laid("```\nfor i in range(9):\n    total = total + i\n```").pieces
    assert [placed.piece.text for placed in code] == [
        "for i in range(9):", "  total = total +", "      i",
    ]  # fmt: skip
    assert {placed.piece.size for placed in (*formula, *code)} == {10}
    baselines = [placed.baseline for placed in code]
    assert baselines == sorted(set(baselines))


def test_an_empty_text_takes_no_room():
    assert laid("").height == laid("").width == 0
    assert laid("- ` `\n- a").pieces[0].baseline == 0  # the mark of an item without words
