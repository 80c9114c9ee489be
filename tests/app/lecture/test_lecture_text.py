"""A step's text: its blocks and words, and mistakes with their line."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from plain_text import plain_text, words_of

from lucida.app.lecture import text as texts


def test_a_text_is_parsed_into_its_blocks():
    blocks = texts.parse(
        "# One\n\nA *slanted* **bold $x$** `code`\ngoes on.\n> Why\n> so?\n"
        "- a\n- b\n  c\n\n1. x\n2. y\n\n$$\na\nb\n$$\n$$ c $$\n```python\n  x = $1\n```\n"
    )
    words = texts.Words
    assert blocks == (
        texts.Heading(1, (words("One"),)),
        texts.Paragraph(
            (
                words("A "),
                words("slanted", italic=True),
                words(" "),
                words("bold ", bold=True),
                texts.Math("x"),
                words(" "),
                words("code", code=True),
                words(" goes on."),
            )
        ),
        texts.Question((words("Why so?"),)),
        texts.ItemList(((words("a"),), (words("b c"),))),
        texts.ItemList(((words("x"),), (words("y"),)), numbered=True),
        texts.DisplayedFormula("a\nb"),
        texts.DisplayedFormula("c"),
        texts.Code("  x = $1"),
    )
    assert texts.formulas(blocks) == ("x", "a\nb", "c")
    assert "slanted" in plain_text(blocks) and "*" not in plain_text(blocks)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("*a* b", (texts.Words("a", italic=True), texts.Words(" b"))),
        ("-5 is", (texts.Words("-5 is"),)),
        ("[a *b*](#c)", (texts.Words("a "), texts.Words("b", italic=True))),
        (r"a\$", (texts.Words("a$"),)),
        (r"a\*b", (texts.Words("a*b"),)),
        (r"$x$$y$ a\#", (texts.Math("x"), texts.Math("y"), texts.Words(" a#"))),
        (r"**a\*** b", (texts.Words("a*", bold=True), texts.Words(" b"))),
        (r"${\{}{a}$", (texts.Math(r"{\{}{a}"),)),
    ],
)
def test_neighbours_of_one_style_are_one(text, line):
    assert texts.parse(text) == (texts.Paragraph(line),)


def test_of_what_a_text_consists():
    text = "# $x$ head\n\n- one *two*\n- three\n\n```\na\nb\n```\n$$y$$\n> who $z$?\n\nso"
    blocks = texts.parse(text)
    assert texts.pieces(blocks) == 2 + 3 + 1 + 1 + 3 + 1
    assert texts.formulas(blocks) == ("x", "y", "z")
    assert texts.pieces(()) == 0


def test_how_long_a_text_may_be():
    assert texts.parse("a" * texts.LETTERS)
    with pytest.raises(texts.TextError, match="is a text of 50001 characters"):
        texts.parse("a" * (texts.LETTERS + 1))


@pytest.mark.parametrize(
    ("text", "line"), [("a\n\n$x", 2), ("a\n$$\nb", 1), ("x\n\n```\ny", 2), ("- a\n- $", 1)]
)
def test_mistakes_have_a_line(text, line):
    with pytest.raises(texts.TextError) as error:
        texts.parse(text)
    assert error.value.line == line


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        ("a\n\n- so **$$x$$**", 2, "$$ is inside a line; give it lines of its own"),
        ("a\n$$x$$ is", 1, "$$ is inside a line"),
        ("$$\nx", 0, "a formula does not end; close it by $"),
        ("a\n$}{$", 1, "the braces of '}{' do not match"),
        ("${a{b}$", 0, "the braces of '{a{b}' do not match"),
        ("- a\n  ```\n  b\n  ```", 1, "contains a program; move it below"),
    ],
)
def test_a_mistake_has_a_remedy(text, line, told):
    with pytest.raises(texts.TextError) as error:
        texts.parse(text)
    assert told in str(error.value)
    assert error.value.line == line


@given(st.text(alphabet="$*`\\\\a1.,()[]{}_^#>-", min_size=1, max_size=12))
def test_an_escaped_text_is_shown_as_it_stands(typed):
    (block,) = texts.parse("typed: " + texts.escaped(typed))
    assert words_of(block.line) == ("typed: " + typed)
