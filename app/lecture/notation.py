"""A lecture's text in a notation, and the letters in it that serve twice."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from app.lecture.model import Step
from app.lecture.text import (
    Block,
    Code,
    DisplayedFormula,
    ItemList,
    Line,
    Math,
    Paragraph,
    Span,
    Words,
    formulas,
)
from app.state.options.shared import Notation
from app.ui.explaining import symbols

_VECTOR = re.compile(r"\\mathbf\{([a-z])\}")
_APART = re.compile(r"\\(?:mathbf|mathrm|mathit|text)\{[^{}]*\}|\\[A-Za-z]+")
_SCALAR = re.compile(r"(?<![A-Za-z])[a-z](?![A-Za-z])")


class TwiceUsed(Paragraph):
    """The line that says how letters that serve twice differ. In code none does."""


@lru_cache(512)
def in_notation(blocks: tuple[Block, ...], notation: Notation) -> tuple[Block, ...]:
    """Return a text that is written with the book's letters in a notation."""
    if notation == "book":
        return blocks
    return tuple(_block(block, notation) for block in blocks if not isinstance(block, TwiceUsed))


def _block(block: Block, notation: Notation) -> Block:
    match block:
        case DisplayedFormula(latex=latex):
            return DisplayedFormula(symbols.latex(latex, notation))
        case Code(text=text):
            return replace(block, text=symbols.lettered(text, notation))
        case ItemList(items=items):
            return replace(block, items=tuple(_line(item, notation) for item in items))
    return replace(block, line=_line(block.line, notation))


def _line(line: Line, notation: Notation) -> Line:
    spans: list[Span] = []
    for span in line:
        shown, before = _span(span, notation), spans[-1] if spans else None
        if isinstance(before, Words) and isinstance(shown, Words) and shown != span:
            # The eye **e** is the **eye**, not the eye **eye**.
            spans[-1] = before._replace(text=before.text.removesuffix(f"{shown.text} "))
        spans.append(shown)
    return tuple(spans)


def _span(span: Span, notation: Notation) -> Span:
    if isinstance(span, Math):
        return Math(symbols.latex(span.latex, notation))
    if span.code:
        return span._replace(text=symbols.lettered(span.text, notation))
    return span._replace(text=symbols.vector(span.text, notation)) if span.bold else span


def explained(builds: Sequence[Step]) -> tuple[Step, ...]:
    """Return a lecture's builds. The first text that has a letter as a vector and as a number says
    so, also in the later builds of its step.
    """
    out = list(builds)
    found: Step | None = None
    for place, build in enumerate(out):
        twice = sorted(_vectors(build.blocks) & _scalars(build.blocks))
        if not twice or (found is not None and build.number != found.number):
            continue
        letter = twice[0]
        line = (
            Words("Bold and upright, a letter is a vector; in italics, a number: "),
            Words(letter, bold=True),
            Words(" is not "),
            Math(letter),
            Words("."),
        )
        found = build
        out[place] = replace(build, blocks=(*build.blocks, TwiceUsed(line)))
    return tuple(out)


def _vectors(blocks: tuple[Block, ...]) -> set[str]:
    return {letter for latex in formulas(blocks) for letter in _VECTOR.findall(latex)}


def _scalars(blocks: tuple[Block, ...]) -> set[str]:
    bare = (_APART.sub(" ", latex) for latex in formulas(blocks))
    return {letter for latex in bare for letter in _SCALAR.findall(latex)}
