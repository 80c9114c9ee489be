"""A lecture's text in a notation."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from lucida.app.lecture.text import (
    Block,
    Code,
    DisplayedFormula,
    ItemList,
    Line,
    Math,
    Span,
    Words,
)
from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining import symbols


@lru_cache(512)
def in_notation(blocks: tuple[Block, ...], notation: Notation) -> tuple[Block, ...]:
    """Return a text that is written with the book's letters in a notation."""
    if notation == "book":
        return blocks
    return tuple(_block(block, notation) for block in blocks)


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
