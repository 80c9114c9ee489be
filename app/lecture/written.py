"""The texts in a lecture's file, and the lines in which their formulas begin."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate
from typing import Any

from lucida.renderer.files.places import Places

from . import text as texts
from .model import Written

TEXTS = ("text", "instead", "notes", "question", "feedback", "answer")  # fields of Markdown
_SOLID = re.compile(r"[^\s>]+")


def texts_of(table: dict[str, Any], field: str) -> Iterator[tuple[str, str]]:
    """Yield the texts of a step, or of a table in it, each with its path. field: the table's."""
    for name, value in table.items():
        path = f"{field}.{name}"
        if name in TEXTS and isinstance(value, str):
            yield path, value
        elif name == "exercise" and isinstance(value, dict):
            yield from texts_of(value, path)
        elif isinstance(value, list):
            for number, entry in enumerate(value):
                if isinstance(entry, dict):
                    yield from texts_of(entry, f"{path}[{number}]")


def formulas_written(
    text: str, blocks: tuple[texts.Block, ...], field: str, places: Places, source: str
) -> Iterator[Written]:
    """Yield all formulas of a text. field: its path. source: the file's name."""
    formulas = texts.formulas(blocks)
    first = places.line(field)
    for latex, line in zip(formulas, _lines(formulas, text), strict=True):
        yield Written(latex, field, source, first + line)


def _lines(formulas: tuple[str, ...], text: str) -> Iterator[int]:
    """Yield the line of the text, from 0, in which each formula begins.

    Text and formulas are compared without white space and without `>`, because a formula may
    continue on the next line. Each search starts after the previous formula, in one pass.
    """
    pieces = list(_SOLID.finditer(text))
    solid = "".join(piece[0] for piece in pieces)
    ends = list(accumulate(len(piece[0]) for piece in pieces))  # ends of the pieces in `solid`
    at = line = counted = 0
    for latex in formulas:
        bare = f"${''.join(_SOLID.findall(latex))}$"
        start = solid.find(bare, at)
        if start >= 0:
            here = pieces[bisect_right(ends, start + 1)].start()
            line += text.count("\n", counted, here)
            counted, at = here, start + len(bare)
        yield line
