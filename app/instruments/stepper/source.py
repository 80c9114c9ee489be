"""The source of a teaching renderer as the stepper shows it, and the roles of its lines."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from lucida.app.ui.explaining import symbols
from lucida.renderer.camera.pixels import Indexing

# Changes from Python that counts pixels from 0 to counting from 1; arrays still count from 0.
_FROM_ONE = (
    (re.compile(r"\brange\((\w+)\)"), r"range(1, \1 + 1)"),
    (re.compile(r"\b([ij]) \+ 0\.5"), r"\1 - 0.5"),
    (re.compile(r"\[i, j\]"), "[i-1, j-1]"),
)


@dataclass(frozen=True, eq=False)
class Source:
    """The source of one of the loops.

    lines: its lines without the docstring.
    first_line: the number subtracted from Python's line numbers.
    pixels: the lines of the body of the loop over columns j, inside that over rows.
    objects: those of the loop over objects, or over triangles.
    """

    lines: tuple[str, ...]
    first_line: int
    pixels: range
    objects: range


@cache
def source_of(program: Callable[..., Any]) -> Source:
    """Return the source of one of the loops, whose docstrings have one line."""
    header, _docstring, *rest = inspect.getsource(program).rstrip().split("\n")
    lines = header, *rest
    return Source(
        lines,
        program.__code__.co_firstlineno + 1,
        _body(lines, "for j in"),
        _body(lines, "for object in", "for triangle in"),
    )


def _body(lines: tuple[str, ...], *headers: str) -> range:
    """Return the numbers of the lines inside a loop."""
    indents = [len(line) - len(line.lstrip()) for line in lines]
    first = next(n for n, line in enumerate(lines) if line.lstrip().startswith(headers)) + 1
    after = (n for n in range(first, len(lines)) if indents[n] < indents[first])
    return range(first, next(after))


@cache
def shown_lines(lines: tuple[str, ...], indexing: Indexing = Indexing.ARRAY) -> tuple[str, ...]:
    """Return lines of the loops with letters, with pixels counted as `indexing` says."""
    text = "\n".join(lines)
    if indexing is Indexing.LECTURE:
        for pattern, instead in _FROM_ONE:
            text = pattern.sub(instead, text)
    return tuple(symbols.program(line) for line in text.split("\n"))
