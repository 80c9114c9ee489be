"""Large and hostile lecture files: read in linear time, or refused in one line."""

import contextlib
import sys
from pathlib import Path

import pytest

from lucida.app.lecture.reading import PIECES, lecture_from_toml
from lucida.app.lecture.text import Math, Paragraph, Words, parse
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.system.errors import LucidaError

STEP = '[[steps]]\ntitle = "T"\ntext = """\n{}"""\n'
SMALL = 400  # characters


def lecture(text):
    return lecture_from_toml(text, Path(), "x.toml")


def steps_of(size, line, of_a_step=4000):
    """A lecture of about `size` characters, every step of other text."""
    body = line * (of_a_step // len(line)) + "\n"
    steps = [STEP.format(f"Number {number}.\n{body}") for number in range(size // of_a_step)]
    return 'title = "L"\n' + "".join(steps)


class Work:
    """The work done within it: the number of lines of Python that run."""

    def __init__(self):
        self.lines = 0

    def __enter__(self):
        sys.settrace(self._note_line)
        return self

    def __exit__(self, *_):
        sys.settrace(None)

    def _note_line(self, _frame, _event, _value):
        self.lines += 1
        return self._note_line


def lines_of(text):
    """The reading of a lecture."""
    parse.cache_clear()
    with Work() as work, contextlib.suppress(LucidaError):
        lecture(text)
    return work.lines


@pytest.mark.parametrize(
    "line",
    [
        "Here is $x_1 + y^2$ and **bold** and *it* of text.\n",
        " *a",  # none of them is closed
        "`a **b ",
        "*",
        r"\\*",
        "$x$ ",
        ">>$x$ y\n",
        "- a\n" + "b\n" * 40,
        "$$\nx\n$$\n",
    ],
    ids=range(9),
)
def test_work_grows_with_the_size_not_with_its_square(line):
    # The first reading fills caches.
    _, one, two, four = (lines_of(steps_of(SMALL * k, line, 200)) for k in (1, 1, 2, 4))
    assert four - two < 2.05 * (two - one)  # 4 times, were it the square


def test_a_lecture_of_the_largest_size_is_read():
    """Prose, with as many formulas as a lecture may have."""
    formulas = "Here is $x_1$ and **bold**.\n\n" * (PIECES // 1000 // 8)
    prose = "Words, and more words, and a word to end the line of words.\n" * 67
    steps = [STEP.format(formulas + prose) for _ in range(998)]
    text = 'title = "L"\n' + "".join(steps)
    assert 0.95 * TOML_BYTES < len(text) < TOML_BYTES
    read = lecture(text)
    assert len(read.formulas) > 1900
    formula = read.formulas[1900]
    assert text.split("\n")[formula.line - 1].startswith("Here is")


def test_signs_that_are_never_closed_stand_as_they_are():
    assert parse("a *b *c d") == (Paragraph((Words("a *b *c d"),)),)
    assert parse("*a* *b $x$ *c") == (
        Paragraph((Words("a", italic=True), Words(" *b "), Math("x"), Words(" *c"))),
    )
    assert parse("**a *b* c**") == (
        Paragraph(
            (Words("a ", bold=True), Words("b", bold=True, italic=True), Words(" c", bold=True))
        ),
    )
    parse("*" * 40_000)  # no depth of calls
