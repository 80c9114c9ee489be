"""A program of lines of which some may be wrong: what is run is what is shown.

The lines are this project's own; a student's code is never run here.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from types import CodeType
from typing import Any

import numpy as np

from app.checking.mistakes.vectors import FUNCTIONS

Swaps = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class CodeLine:
    """key: what it makes, by which mistakes name it."""

    key: str
    code: str


@dataclass(frozen=True)
class Mistake:
    """A wrong line, or several that are wrong in the same way.

    name: what was done, unlike all others of its program. lines: (key of the line, what is written
    instead). hint: what to tell, in the lecture's words. part: the title of the lecture's step to
    read again. is_common: whether many make it; those are told first. swaps: (old, new) texts that
    make it where another mistake has rewritten its line already.
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
        """A line that another mistake has rewritten, with this one made in it as well."""
        for old, new in self.swaps:
            code = code.replace(old, new)
        return code


Mistakes = tuple[Mistake, ...]


@dataclass(frozen=True)
class ShownLine:
    """code: the right line. instead: what is written where it is struck out, else None; it may be
    several lines."""

    key: str
    code: str
    instead: str | None = None


@dataclass(frozen=True, eq=False)
class Program:
    """lines, and the mistakes that are made in them. results: the names of what it makes. paired:
    lines of which one must be wrong where two mistakes at once are looked for; empty: any."""

    lines: tuple[CodeLine, ...]
    mistakes: Mistakes
    results: tuple[str, ...]
    paired: frozenset[str] = frozenset()

    def text(self, mistakes: Sequence[Mistake] = ()) -> tuple[ShownLine, ...]:
        """All lines, in their order, with what is written instead. Of mistakes that cannot be
        made together in one line, the first counts."""
        instead: dict[str, str] = {}
        for mistake in sorted(mistakes, key=lambda mistake: bool(mistake.swaps)):
            for key, code in mistake.lines:
                instead[key] = mistake.swapped(instead[key]) if key in instead else code
        return tuple(ShownLine(line.key, line.code, instead.get(line.key)) for line in self.lines)

    def source(self, mistakes: Sequence[Mistake] = ()) -> str:
        """What is run."""
        written = (
            line.code if line.instead is None else line.instead for line in self.text(mistakes)
        )
        return "\n".join(written)

    def run(self, known: Mapping[str, Any], mistakes: Sequence[Mistake] = ()) -> tuple[Any, ...]:
        """The results, as the lines give them. known: the values of the names that the lines
        use: numbers (..., 1), vectors (..., 3). What has no value is NaN, or infinite."""
        names: dict[str, Any] = FUNCTIONS | dict(known)
        with np.errstate(all="ignore"):
            exec(_compiled(self.source(mistakes)), names)
        return tuple(names[name] for name in self.results)

    def pairs(self) -> Iterator[tuple[Mistake, Mistake]]:
        """Any two mistakes that can be made together."""
        for first, second in combinations(self.mistakes, 2):
            if self.paired and not self.paired & (first.keys | second.keys):
                continue
            if self.can_combine(first, second):
                yield first, second

    def can_combine(self, first: Mistake, second: Mistake) -> bool:
        """Whether they are in different lines, or both show in the line that they share."""
        shared = first.keys & second.keys
        if not shared:
            return True
        codes = {line.key: line.instead for line in self.text((first, second))}
        alone = (dict(first.lines), dict(second.lines))
        return all(codes[key] != one[key] for key in shared for one in alone)


@functools.lru_cache(4096)
def _compiled(source: str) -> CodeType:
    return compile(source, "<program>", "exec")
