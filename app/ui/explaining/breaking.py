"""Line breaks in formulas and code that are wider than the available space. Pure."""

from __future__ import annotations

import functools
import textwrap

_BREAKS = (" = ", " + ", " - ")
_OPENING, _CLOSING = "({", ")}"
CONTINUED = 4  # extra indentation of a continued line, in letters


@functools.lru_cache(maxsize=1024)
def breakable(formula_text: str) -> tuple[str, ...]:
    """Split a formula at possible line breaks: before an equals sign, plus or minus outside
    brackets.

    Joined by single spaces, the parts are the whole formula.
    """
    parts, depth, start = [], 0, 0
    for at, letter in enumerate(formula_text):
        depth += (letter in _OPENING) - (letter in _CLOSING)
        if depth == 0 and at > start and formula_text[at : at + 3] in _BREAKS:
            parts.append(formula_text[start:at])
            start = at + 1
    return (*parts, formula_text[start:])


@functools.lru_cache(maxsize=1024)
def broken(line: str, letters: int) -> tuple[str, ...]:
    """Break a line of code between words into rows of `letters`; indent all but the first."""
    if len(line) <= letters:
        return (line,)
    indent = min(len(line) - len(line.lstrip()) + CONTINUED, letters // 2)
    return tuple(
        textwrap.wrap(line, letters, subsequent_indent=indent * " ", break_on_hyphens=False)
    )


@functools.cache
def narrowed(lines: tuple[str, ...]) -> tuple[str, ...]:
    """Return the lines with half the indentation, so that deep loops fit in larger type."""
    indents = [len(line) - len(line.lstrip()) for line in lines]
    return tuple(line[indent // 2 :] for line, indent in zip(lines, indents, strict=True))
