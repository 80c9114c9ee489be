"""Programs that are written with words are shown with the lecture's letters, like its formulas."""

import re

import pytest

from lucida.app.checking.mistakes.rays import RayTask, ray_program
from lucida.app.checking.own_words import starter
from lucida.app.checking.task_file import builtin_tasks
from lucida.app.instruments.stepper.loops import PROGRAMS
from lucida.app.instruments.stepper.source import shown_lines, source_of
from lucida.app.ui.explaining import symbols
from lucida.renderer.camera.pixels import Indexing

WORDS = {one.code for one in symbols.TABLE} - {one.letter for one in symbols.TABLE} - set("uvw")


def mistakes():
    for projection_ in ("perspective", "parallel"):
        for indexing in Indexing:
            shown = ray_program(RayTask(projection_, indexing)).shown()
            yield from (line.code for line in shown.lines)
            for mistake in shown.mistakes:
                yield from (code for _, code in mistake.lines)
                yield from mistake.hint.split("`")[1::2]


def stepper():
    for program in PROGRAMS:
        for indexing in Indexing:
            yield from shown_lines(source_of(program).lines, indexing)


def starters():
    """Yield the functions' arguments; tasks have no letters for a point's x and y."""
    for task in builtin_tasks("book"):
        (head,) = re.findall(r"^def (.*):$", starter([task]), re.MULTILINE)
        yield re.sub(r"\b(x|y|point)\b", "", head)


@pytest.mark.parametrize("shown", [mistakes, stepper, starters])
def test_no_symbol_is_spelled_as_a_word(shown):
    found = list(shown())
    assert found and not any(words_in(text) for text in found)


def words_in(code):
    return WORDS & set(re.findall(r"(?<![\w.])[A-Za-z_]\w*", code))


def test_the_same_texts_are_written_with_words():
    assert any(any(map(words_in, source_of(one).lines)) for one in PROGRAMS)
