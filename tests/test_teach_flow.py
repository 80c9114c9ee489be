"""Texts broken into lines and put into their places."""

from __future__ import annotations

from app.lecture.flow import Extent, Laid, Piece, fitted, lay
from app.lecture.text import parse


def measure(piece: Piece) -> Extent:
    """Letters half as wide as high; formulas twice as high as their text, as fractions are."""
    high = 2.0 if piece.style == "math" else 1.0
    return Extent(
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


def test_high_formulas_push_lines_apart():
    flat, high = laid("one two three four five"), laid("one $x$ three four five")
    assert high.height > flat.height
    for result in (flat, high):
        baselines = sorted({placed.baseline for placed in result.pieces})
        tops = [
            min(p.baseline - measure(p.piece).ascent for p in result.pieces if p.baseline == b)
            for b in baselines
        ]
        assert tops[0] >= 0 and tops[1] > baselines[0]


def test_blocks_stand_below_one_another():
    text = "# Head\n\nText.\n\n- a\n- b\n\n> Why?\n\n$$\nx\n$$\n\n```\nif x:\n    y\n```\n"
    result = laid(text, 200)
    kinds = [placed.kind for placed in sorted(result.pieces, key=lambda p: (p.baseline, p.x))]
    assert kinds == [
        "heading", "text", "mark", "item", "mark", "item", "question", "formula", "code", "code",
    ]  # fmt: skip
    boxes = {box.kind: box for box in result.boxes}
    assert set(boxes) == {"question", "code"}
    assert boxes["question"].bottom < boxes["code"].top < boxes["code"].bottom <= result.height
    code = [placed.piece.text for placed in result.pieces if placed.kind == "code"]
    assert code == ["if x:", "    y"]
    question = next(placed for placed in result.pieces if placed.kind == "question")
    assert boxes["question"].top < question.baseline < boxes["question"].bottom


def test_code_is_made_smaller_rather_than_broken():
    result = laid("```\n" + 40 * "x" + "\n```")
    (placed,) = result.pieces
    assert placed.x + measure(placed.piece).width <= 100
    assert placed.piece.size < 10


def test_texts_are_as_large_as_they_fit():
    blocks = parse("one two three four five six seven eight nine ten " * 3)
    roomy, size = fitted(blocks, (200, 400), (5, 20), measure)
    assert size == 20 and roomy.height <= 400
    tight, smaller = fitted(blocks, (200, 120), (5, 20), measure)
    assert 5 < smaller < 20 and tight.height <= 120
    full, smallest = fitted(blocks, (200, 10), (5, 20), measure)
    assert smallest == 5 and full.height > 10


def test_an_empty_text_takes_no_room():
    assert laid("").height == 0
