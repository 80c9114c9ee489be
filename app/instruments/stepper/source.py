"""The source of a teaching renderer as the stepper shows it, and the roles of its lines."""

from __future__ import annotations

import ast
import inspect
import re
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining import symbols
from lucida.renderer.camera.pixels import Indexing

_COMMENT = re.compile(r"(?P<code>[^#\n]+)(?P<comment>(?:#.*)?)")
# Python that counts pixels from 0, and the same from 1; its arrays count from 0 in any case.
_FROM_ONE = (
    (re.compile(r"\brange\((\w+)\)"), r"range(1, \1 + 1)"),
    (re.compile(r"\b([ij]) \+ 0\.5"), r"\1 - 0.5"),
    (re.compile(r"\[i, j\]"), "[i-1, j-1]"),
)


@dataclass(frozen=True)
class Loop:
    """A loop's lines: header, the first and the last of its body; numbers in Source.lines."""

    header: int
    first: int
    last: int

    def runs(self, line: int) -> bool:
        """Return True if a line belongs to the loop's body."""
        return self.first <= line <= self.last


@dataclass(frozen=True, eq=False)
class Source:
    """The source of a function.

    lines: without its docstring.
    first_line: subtracted from Python's line numbers.
    shown: the number in `lines` of each of Python's, -1 for the docstring.
    pixels: the loop over columns j, inside that over rows.
    objects: the loop over objects, or over triangles.
    """

    name: str
    lines: tuple[str, ...]
    first_line: int
    shown: tuple[int, ...]
    pixels: Loop
    objects: Loop


@cache
def source_of(function: Callable[..., Any]) -> Source:
    """Return the source of one of the loops, or of a function with the same parts."""
    text = textwrap.dedent(inspect.getsource(function))
    tree = ast.parse(text).body[0]
    assert isinstance(tree, ast.FunctionDef)
    all_lines = text.rstrip("\n").split("\n")
    hidden = _docstring_lines(tree)
    shown: list[int] = []
    lines: list[str] = []
    for number, line in enumerate(all_lines):
        shown.append(-1 if number in hidden else len(lines))
        if number not in hidden:
            lines.append(line)
    loops = {
        ast.unparse(node.target): Loop(
            shown[node.lineno - 1], shown[node.body[0].lineno - 1], shown[_end(node) - 1]
        )
        for node in ast.walk(tree)
        if isinstance(node, ast.For)
    }
    return Source(
        name=function.__name__,
        lines=tuple(lines),
        first_line=function.__code__.co_firstlineno,
        shown=tuple(shown),
        pixels=loops["j"],
        objects=loops["object"] if "object" in loops else loops["triangle"],
    )


@cache
def shown_lines(
    lines: tuple[str, ...], notation: Notation, indexing: Indexing = Indexing.ARRAY
) -> tuple[str, ...]:
    """Return lines of the loops as they are shown."""
    return tuple(shown_code(line, notation, indexing) for line in lines)


def shown_code(code: str, notation: Notation, indexing: Indexing = Indexing.ARRAY) -> str:
    """Return code of the loops in a notation, with pixels counted as `indexing` does."""
    if indexing is Indexing.LECTURE:
        for pattern, instead in _FROM_ONE:
            code = pattern.sub(instead, code)
    parts = code.split('"""')  # every other one is a docstring
    parts[::2] = [_COMMENT.sub(lambda found: _shown(found, notation), part) for part in parts[::2]]
    return '"""'.join(parts)


def _shown(found: re.Match[str], notation: Notation) -> str:
    return symbols.program(found["code"], notation) + found["comment"]


def _end(node: ast.stmt) -> int:
    assert node.end_lineno is not None
    return node.end_lineno


def _docstring_lines(tree: ast.FunctionDef) -> set[int]:
    """Return the lines of the docstring, counted from 0."""
    if ast.get_docstring(tree) is None:
        return set()
    node = tree.body[0]
    return set(range(node.lineno - 1, _end(node)))
