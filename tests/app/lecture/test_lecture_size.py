"""Large and hostile lecture files: read in linear time, or refused in one line."""

from __future__ import annotations

import contextlib
import re
import sys
from functools import lru_cache
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from lucida.app.lecture import text as texts
from lucida.app.lecture.reading import PIECES, lecture_from_toml
from lucida.app.lecture.text import Math, Paragraph, Words, parse
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.system.errors import LucidaError

STEP = '[[steps]]\ntitle = "T"\ntext = """\n{}"""\n'
SMALL = 8_000  # characters


def lecture(text: str):
    return lecture_from_toml(text, Path(), "x.toml")


def steps_of(size: int, line: str, of_a_step: int = 4000) -> str:
    """A lecture of about `size` characters, every step of other text."""
    body = line * (of_a_step // len(line)) + "\n"
    steps = [STEP.format(f"Number {number}.\n{body}") for number in range(size // of_a_step)]
    return 'title = "L"\n' + "".join(steps)


class Work:
    """The work done within it: lines of Python that run, and patterns that are searched for."""

    def __init__(self) -> None:
        self.lines = self.searches = 0

    def __enter__(self) -> Work:
        sys.setprofile(self._note_call)
        sys.settrace(self._note_line)
        return self

    def __exit__(self, *_: object) -> None:
        sys.settrace(None)
        sys.setprofile(None)

    def _note_line(self, _frame: FrameType, _event: str, _value: Any) -> Any:
        self.lines += 1
        return self._note_line

    def _note_call(self, _frame: FrameType, _event: str, called: Any) -> None:
        self.searches += isinstance(getattr(called, "__self__", None), re.Pattern)


def lines_of(text: str) -> int:
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
def test_work_grows_with_the_size_not_with_its_square(line: str) -> None:
    one, two, four = (lines_of(steps_of(SMALL * factor, line, 200)) for factor in (1, 2, 4))
    assert four - two < 2.2 * (two - one)  # 4 times, were it the square


@pytest.mark.parametrize("line", [" *a", "a *b "])
def test_what_nothing_closes_is_looked_for_once(line: str) -> None:
    """Each search may go to the text's end."""
    with Work() as work:
        parse(line * 1000)
    assert work.searches < 50


def test_a_lecture_of_the_largest_size_is_read() -> None:
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


@pytest.mark.parametrize(
    "line",
    ["$x$ ", "*a* ", "`a` ", "- a\n", "# a\n", "a\n\n", "> a\n\n", "$$\nx\n$$\n", "```\n```\n"],
)
def test_a_lecture_of_more_pieces_than_anybody_shows_is_refused_at_once(line, monkeypatch) -> None:
    laid_out = 0
    real = texts.parse.__wrapped__

    def counted(text):
        nonlocal laid_out
        laid_out += len(text)
        return real(text)

    monkeypatch.setattr(texts, "parse", lru_cache(256)(counted))
    text = steps_of(TOML_BYTES // 4, line)
    with pytest.raises(LucidaError) as caught:
        lecture(text)
    said = str(caught.value)
    assert f"brings the lecture to more than {PIECES} formulas and runs of words" in said
    assert said.startswith("x.toml:") and "steps[" in said and "\n" not in said
    assert laid_out < PIECES * len(line) * 2 + 10_000


def test_signs_that_are_never_closed_stand_as_they_are() -> None:
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
