"""Large and hostile lecture files: read in linear time, or refused in one line."""

from __future__ import annotations

import contextlib
import time
from functools import lru_cache
from pathlib import Path

import pytest

from app.lecture import reading
from app.lecture import text as texts
from app.lecture.reading import PIECES, lecture_from_toml
from app.lecture.text import Math, Paragraph, Words, parse
from renderer.errors import LucidaError
from renderer.scene.limits import TOML_BYTES
from renderer.scene.places import Places

STEP = '[[steps]]\ntitle = "T"\ntext = """\n{}"""\n'
SMALL = 40_000  # characters


def lecture(text: str):
    return lecture_from_toml(text, Path(), "x.toml")


def steps_of(size: int, line: str, of_a_step: int = 4000) -> str:
    """A lecture of about `size` characters, every step of other text."""
    body = line * (of_a_step // len(line)) + "\n"
    steps = [STEP.format(f"Number {number}.\n{body}") for number in range(size // of_a_step)]
    return 'title = "L"\n' + "".join(steps)


def seconds(text: str) -> float:
    """Of the processor, the least of three."""
    taken = []
    for _ in range(3):
        begin_s = time.process_time()
        with contextlib.suppress(LucidaError):
            lecture(text)
        taken.append(time.process_time() - begin_s)
        parse.cache_clear()
    return min(taken)


@pytest.mark.parametrize(
    "line",
    [
        "Here is $x_1 + y^2$ and **bold** and *it* of text.\n",
        " *a",  # none of them is closed
        "`a **b ",
        "*",
        r"\*",
        "$x$ ",
        ">>$x$ y\n",
        "- a\n" + "b\n" * 500,
        "$$\nx\n$$\n",
    ],
    ids=range(9),
)
def test_time_grows_with_the_size_not_with_its_square(line: str) -> None:
    small, large = (seconds(steps_of(SMALL * factor, line)) for factor in (1, 12))
    assert large < 36 * small  # 144 times, were it the square


@pytest.mark.parametrize(
    "text",
    [
        "\n".join(f"key{k} = {k}" for k in range(SMALL // 16)),
        "[[steps]]\n" * (SMALL // 10),
        "a = [\n" + "1,\n" * (SMALL // 3) + "]\n",
    ],
    ids=["keys", "steps", "numbers"],
)
def test_lines_are_found_in_linear_time(text: str) -> None:
    """Counted by how many characters are looked at for line breaks, whatever the machine."""

    class Counted(str):
        looked = 0

        def count(self, *arguments) -> int:
            Counted.looked += len(self)
            return str.count(self, *arguments)

    places = Places(Counted(text))
    assert Counted.looked <= 4 * len(text)
    assert places.line("") == 1


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


def test_formulas_keep_their_lines() -> None:
    text = 'title = "L"\n' + STEP.format(
        "An x is\n> asked: $a\n> + b$ $x$\n\n$$\nw\n$$\n\n- an item\n  $y$ goes on\n\n**$z$**\n"
    )
    found = {entry.latex: entry.line - 4 for entry in lecture(text).formulas}
    assert found == {"a + b": 2, "x": 3, "w": 6, "y": 10, "z": 12}


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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (STEP.format("a" * 60_000), "text: is a text of 60000 characters; stay within 50000"),
        ('[[steps]]\ntitle = "' + "a" * 4000 + '"\n', "title: is 4000 characters long; stay"),
        ("[[steps]]\n" * 1001, "steps: holds 1001 steps; give 1 to 1000"),
        (
            '[[steps]]\ntitle = "T"\n[steps.exercise]\nkind = "choice"\nquestion = "?"\n'
            + '[[steps.exercise.options]]\ntext = "a"\nfeedback = "b"\n' * 9,
            "options: holds 9; give at most 8",
        ),
        (
            '[[steps]]\ntitle = "T"\n[steps.exercise]\nkind = "vector"\nquestion = "?"\n'
            + '[[steps.exercise.answers]]\nname = "a"\nvalue = [1, 2, 3]\n' * 9,
            "answers: holds 9; give at most 8",
        ),
        ("a = " + "[" * 100_000, "is nested too deeply"),
        (
            "".join(f"[scenes.s{number}]\n" for number in range(1001)) + STEP,
            "scenes: holds 1001; give at most 1000",
        ),
    ],
    ids=range(7),
)
def test_what_is_too_much_is_refused(text: str, message: str) -> None:
    with pytest.raises(LucidaError) as caught:
        lecture('title = "L"\n' + text)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("own", [True, False])
def test_all_scenes_together_have_a_bound(tmp_path: Path, monkeypatch, own: bool) -> None:
    """Each by itself would do; a few lines can name many."""
    monkeypatch.setattr(reading, "TRIANGLES", 30)
    text, fields = 'title = "L"\n', []
    for number in range(3):
        box = "objects = [{ type = 'box' }]\n"
        (tmp_path / f"s{number}.toml").write_text(box)
        text += f"[scenes.s{number}]\n{box}" if own else ""
        fields.append(f"scenes.s{number}" if own else f"steps[{number}].scene")
    for number in range(3):
        text += f"[[steps]]\ntitle = 'T'\nscene = 's{number}{'' if own else '.toml'}'\n"
    with pytest.raises(LucidaError) as caught:
        lecture_from_toml(text, tmp_path, "x.toml")
    assert fields[2] in str(caught.value)
    assert "brings the lecture's scenes to more than 30 triangles; divide it" in str(caught.value)
