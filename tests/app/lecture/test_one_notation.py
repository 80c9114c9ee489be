"""Every symbol on every screen, in both notations: none is spelled as in the other one.

Walks the texts that the rooms' pure models produce: the lecture's steps and exercises, the probe,
the mistakes, the stepper, the labels of the outside view, the laboratory, tasks and what is copied.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

import numpy as np
import pytest
from both_lectures import both_lectures

from lucida.app.cameras.camera_panel import panel, projection
from lucida.app.checking.mistakes.rays import RayTask, ray_program
from lucida.app.checking.own_words import starter
from lucida.app.checking.task_file import builtin_tasks
from lucida.app.instruments.laboratory.page import Page
from lucida.app.instruments.laboratory.ruler import ruler
from lucida.app.instruments.laboratory.sheet import Look
from lucida.app.instruments.outside import figure
from lucida.app.instruments.outside.camera_diagram import Content
from lucida.app.instruments.outside.diagram import Label, RayEnd
from lucida.app.instruments.outside.growing import grown_diagram
from lucida.app.instruments.probe.copying import all_lines, as_latex, as_python
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.stepper.loops import PROGRAMS
from lucida.app.instruments.stepper.source import shown_lines, source_of
from lucida.app.lecture import text as texts
from lucida.app.lecture.notation import in_notation
from lucida.app.state.options.laboratory import LaboratoryOptions
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining import symbols
from lucida.app.ui.explaining.symbols import TABLE
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files import load_scene

LECTURE = both_lectures()
STEPS = LECTURE.builds
NOTATIONS: tuple[Notation, ...] = ("book", "code")
Found = Iterator[tuple[str, str, str]]  # where, the kind of text, the text


def parts_of(block: texts.Block) -> list:
    if isinstance(block, texts.Code | texts.DisplayedFormula):
        return [block]
    lines = block.items if isinstance(block, texts.ItemList) else [block.line]
    return [span for line in lines for span in line]


def lecture(notation: Notation) -> Found:
    for number, step in enumerate(STEPS, start=1):
        written = [step.text, getattr(step.exercise, "question", "")]
        written += getattr(step.exercise, "replies", ())
        if hasattr(step.exercise, "solution"):
            written.append(step.exercise.solution())
        for text in written:
            for block in in_notation(texts.parse(text), notation):
                for span in parts_of(block):
                    if isinstance(span, texts.Code) or getattr(span, "code", False):
                        yield f"step {number}", "program", span.text
                    elif isinstance(span, texts.Math | texts.DisplayedFormula):
                        yield f"step {number}", "latex", span.latex
                    elif span.bold:
                        yield f"step {number}", "vector", span.text


def probe(notation: Notation) -> Found:
    for name in ("still-life", "spheres"):
        scene = load_scene(name)
        reading = Probe(scene).at((24, 32), scene.view.for_size((64, 48)), (64, 48))
        for line in all_lines(reading, Indexing.LECTURE, notation):
            yield "probe", "latex", f"{line.latex} {line.latex_numbers}"
            yield "probe", "plain", line.name
        yield "copied", "latex", as_latex(reading, Indexing.ARRAY, notation).partition("\n")[2]
        if notation == "code":
            yield "copied", "program", as_python(reading, Indexing.LECTURE)


def mistakes(notation: Notation) -> Found:
    for projection_ in ("perspective", "parallel"):
        for indexing in Indexing:
            shown = ray_program(RayTask(projection_, indexing)).in_notation(notation)
            yield from (("mistakes", "program", line.code) for line in shown.lines)
            for mistake in shown.mistakes:
                yield from ((mistake.name, "program", code) for _, code in mistake.lines)
                yield mistake.name, "words", mistake.hint


def stepper(notation: Notation) -> Found:
    for program in PROGRAMS:
        for indexing in Indexing:
            for line in shown_lines(source_of(program).lines, notation, indexing):
                yield "stepper", "program", line


def drawn(notation: Notation) -> Found:
    both = OutsideOptions(target=(0, 0, 0)), OutsideOptions(half_line=4.0)
    for step, options in itertools.product(STEPS, both):
        camera = step.view.for_size((64, 48))
        end = RayEnd((24, 32), 2.0)
        content = Content(camera, (64, 48), options, 9.0, (), end, notation=notation)
        for item in grown_diagram(content):
            if isinstance(item, Label):
                yield "outside view", "label", item.text


def others(notation: Notation) -> Found:
    options = LaboratoryOptions(page="ruler", progress=4.0)
    look, none = Look(*[(0.0, 0.0, 0.0)] * 10), np.zeros((1, 1, 3), np.float32)
    page = Page((400, 300), look, options, none, 0.0, (0.5, 0.5), notation)
    for part in ruler(page).parts:
        if isinstance(part, figure.Label):
            yield "laboratory", "label", part.text
    tips = [*(tip for *_, tip in panel.ROLES.values()), panel.PERSPECTIVE, panel.PARALLEL]
    for tip in (*tips, projection.DISTANCE, projection.DOLLY, projection.FIELD_OF_VIEW):
        yield "camera panel", "words", symbols.words(tip, notation)
    for task in builtin_tasks(notation):
        head = re.findall(r"^def (.*):$|^ +(\w[\w.]*): ", starter([task]), re.MULTILINE)
        yield task.name, "interface", " ".join(map(" ".join, head))


def foreign(kind: str, text: str, notation: Notation) -> set[str]:
    """Return the symbols in a text that are the other notation's."""
    letters, words = ({getattr(one, name) for one in TABLE} for name in ("letter", "code"))
    book, code = (
        {one.book for one in TABLE if one.is_vector}, {one.code for one in TABLE if one.is_vector}
    )  # fmt: skip
    if kind == "words":
        found = [foreign("program", part, notation) for part in text.split("`")[1::2]]
        return set().union(*found)
    if kind == "latex":
        vectors = set(re.findall(r"\\mathbf\{(\w+)\}", text))
        other = vectors & (code - book if notation == "book" else book - code)
        long_ones = set(re.findall(r"\\mathit\{(\w+)\}", text))
        bare = re.sub(r"\\[a-z]+\{[^{}]*\}|\\[A-Za-z]+|_(\{[^{}]*\}|\w)", " ", text)
        short = set(re.findall(r"(?<![A-Za-z])[uvWHd](?![A-Za-z])", bare))
        return other | (long_ones if notation == "book" else short)
    if kind in ("vector", "label"):
        alone = {text} if kind == "vector" else set(re.findall(r"\w+", text))
        return alone & (code - book if notation == "book" else book - code - {"x"})
    if kind == "plain":
        vectors = set(re.findall(r"vec\((\w+)\)", text))
        other = vectors & (code - book if notation == "book" else book - code)
        rest = set(re.findall(r"(?<![\w.(])\w+(?!\w|\))", text))
        return other | rest & ({"width", "height"} if notation == "book" else {"W", "H", "d"})
    names = set(re.findall(r"(?<![\w.])(?:cam(?:era)?\.)?[A-Za-z_]\w*", text.replace("%d", "")))
    if kind == "interface":
        return names & ({"width", "height"} if notation == "book" else {"W", "H", "camera.e"})
    return names & (words - letters - set("uvw") if notation == "book" else letters - words)


ROOMS = (lecture, probe, mistakes, stepper, drawn, others)


@pytest.mark.parametrize("notation", NOTATIONS)
@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.__name__)
def test_no_symbol_is_spelled_as_in_the_other_notation(room, notation):
    count = 0
    for where, kind, text in room(notation):
        count += 1
        assert not foreign(kind, text, notation), (where, kind, text)
    assert count > 20
    other = NOTATIONS[notation == "book"]
    assert any(foreign(kind, text, other) for _, kind, text in room(notation))  # it can fail


def test_a_word_and_its_symbol_are_one_in_code():
    (block,) = in_notation(
        texts.parse("An origin **p** at the eye **e**, a direction **d**:"), "code"
    )
    assert "".join(span.text for span in block.line) == "An origin at the eye, a direction:"
