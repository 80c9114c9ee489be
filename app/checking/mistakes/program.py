"""A program of lines, some of which may be wrong. The same text is run and shown.

The lines are this project's own; a student's code is never run here.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from types import CodeType
from typing import Any

import numpy as np

from lucida.app.ui.explaining.symbols import program, words

from .vectors import FUNCTIONS

Swaps = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class CodeLine:
    """A line of code. key: the name of its result, to which mistakes refer."""

    key: str
    code: str


@dataclass(frozen=True)
class Mistake:
    """A wrong line, or several that are wrong in the same way.

    name: the mistake in words, unique in its program.
    lines: (key of the line, the wrong code).
    hint: the explanation for the student, in the lecture's words.
    part: the title of the lecture's step to read again.
    is_common: True if many people make it; common mistakes are reported first.
    swaps: (old, new) texts that apply it to a line that another mistake has already rewritten.
    """

    name: str
    lines: tuple[tuple[str, str], ...]
    hint: str
    part: str
    is_common: bool = True
    swaps: Swaps = ()

    @property
    def keys(self) -> frozenset[str]:
        return frozenset(key for key, _ in self.lines)

    def swapped(self, code: str) -> str:
        """Return a line that another mistake has rewritten, with this mistake added."""
        for old, new in self.swaps:
            code = code.replace(old, new)
        return code


Mistakes = tuple[Mistake, ...]


@dataclass(frozen=True)
class ShownLine:
    """A line to show. code: the correct line. instead: the wrong code that replaces it, perhaps
    several lines; None if the line is correct.
    """

    key: str
    code: str
    instead: str | None = None


@dataclass(frozen=True, eq=False)
class Program:
    """Lines, and possible mistakes in them.

    results: the names of the results.
    paired: one of these lines must be wrong in a pair of mistakes; empty for any.
    """

    lines: tuple[CodeLine, ...]
    mistakes: Mistakes
    results: tuple[str, ...]
    paired: frozenset[str] = frozenset()

    def text(self, mistakes: Sequence[Mistake] = ()) -> tuple[ShownLine, ...]:
        """Return all lines in order, with the wrong code. If several mistakes cannot be combined in
        one line, the first one counts.
        """
        instead: dict[str, str] = {}
        for mistake in sorted(mistakes, key=lambda mistake: bool(mistake.swaps)):
            for key, code in mistake.lines:
                instead[key] = mistake.swapped(instead[key]) if key in instead else code
        return tuple(ShownLine(line.key, line.code, instead.get(line.key)) for line in self.lines)

    def shown(self) -> Program:
        """Return the program to show, with letters instead of the names that run() needs."""
        return _shown(self)

    def source(self, mistakes: Sequence[Mistake] = ()) -> str:
        """Return the code that is run."""
        written = (
            line.code if line.instead is None else line.instead for line in self.text(mistakes)
        )
        return "\n".join(written)

    def run(self, known: Mapping[str, Any], mistakes: Sequence[Mistake] = ()) -> tuple[Any, ...]:
        """Run the lines and return the results.

        known: the values of the names that the lines use: numbers (..., 1), vectors (..., 3).
        Undefined results are NaN or infinite.
        """
        names: dict[str, Any] = FUNCTIONS | dict(known)
        with np.errstate(all="ignore"):
            for statement in re.split(r"\n(?! )", self.source(mistakes)):  # compile each once
                exec(_compiled(statement), names)
        return tuple(names[name] for name in self.results)

    def pairs(self) -> Iterator[tuple[Mistake, Mistake]]:
        """Yield all pairs of mistakes that can be combined."""
        for first, second in combinations(self.mistakes, 2):
            if self.paired and not self.paired & (first.keys | second.keys):
                continue
            if self.can_combine(first, second):
                yield first, second

    def can_combine(self, first: Mistake, second: Mistake) -> bool:
        """Return True if the mistakes are in different lines, or both are visible in the line that
        they share.
        """
        shared = first.keys & second.keys
        if not shared:
            return True
        codes = {line.key: line.instead for line in self.text((first, second))}
        alone = (dict(first.lines), dict(second.lines))
        return all(codes[key] != one[key] for key in shared for one in alone)


@functools.lru_cache(4096)
def _compiled(source: str) -> CodeType:
    return compile(source, "<program>", "exec")


@functools.lru_cache(64)
def _shown(its: Program) -> Program:
    mistakes = tuple(
        replace(
            mistake,
            lines=tuple((key, program(code)) for key, code in mistake.lines),
            hint=words(mistake.hint),
            swaps=tuple((program(old), program(new)) for old, new in mistake.swaps),
        )
        for mistake in its.mistakes
    )
    lines = tuple(CodeLine(line.key, program(line.code)) for line in its.lines)
    return replace(its, lines=lines, mistakes=mistakes)
