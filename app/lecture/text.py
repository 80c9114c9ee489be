r"""Markdown with formulas, into blocks to draw.

A lecture may use headings (#), paragraphs, lists (- or 1.), code (```), questions to the class (>),
**bold**, *italic*, `code`, $formulas$ and $$displayed formulas$$. \$ is a dollar sign.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from lucida.renderer.system.errors import LucidaError


class Words(NamedTuple):
    """A run of text in one style."""

    text: str
    bold: bool = False
    italic: bool = False
    code: bool = False


class Math(NamedTuple):
    """A formula in the line, as LaTeX."""

    latex: str


Span = Words | Math
Line = tuple[Span, ...]


@dataclass(frozen=True)
class Heading:
    level: int
    line: Line


@dataclass(frozen=True)
class Paragraph:
    line: Line


@dataclass(frozen=True)
class Question:
    """A question to the class."""

    line: Line


@dataclass(frozen=True)
class ItemList:
    """A list; numbered from 1, or with bullets."""

    items: tuple[Line, ...]
    numbered: bool = False


@dataclass(frozen=True)
class Code:
    """Lines of code, unchanged."""

    text: str


@dataclass(frozen=True)
class DisplayedFormula:
    """A displayed formula, as LaTeX."""

    latex: str


Block = Heading | Paragraph | Question | ItemList | Code | DisplayedFormula


class TextError(LucidaError):
    """A mistake in a text. line: where, 0 for the text's first line."""

    def __init__(self, line: int, problem: str, remedy: str) -> None:
        super().__init__("", problem, remedy)
        self.line = line

    def within(self, prefix: str, sign: str = ".") -> TextError:
        self.field = super().within(prefix, sign).field
        return self


_ITEM = re.compile(r"(?:[-*]|(\d+)\.)\s+(.*)")
_BEGINS = re.compile(r"\s*(?:```|\$\$|#|>|(?:[-*]|\d+\.)\s+\S|$)")  # lines that end a paragraph
_SIGN = re.compile(r"[\\$*`[]")  # without one, a line is only words
_MARKS = (
    r"\\(?P<sign>[\\$*`>#[-])"  # a sign that means itself
    r"|`(?P<code>[^`]+)`"
    r"|\[(?P<linked>[^][]+)\]\(#(?P<link>[\w-]+)\)"
    r"|(?P<displayed>\$\$)"  # a displayed formula's sign, which has no place in a line
    r"|\$(?P<latex>(?:[^$\\]++|\\.)++)\$"
)
_STRONG = r"|\*\*(?P<strong>.+?)\*\*(?!\*)"
_SLANTED = r"|\*(?![\s*])(?P<slanted>.+?)(?<!\s)\*|(?P<open>\*(?![\s*]))"
# By (may bold begin, may italic begin): neither may inside itself.
_SPANS = {
    (strong, slanted): re.compile(_MARKS + _STRONG * strong + _SLANTED * slanted)
    for strong in (False, True)
    for slanted in (False, True)
}
LETTERS = 50_000  # of a text; a slide has some hundred


@lru_cache(256)
def parse(text: str) -> tuple[Block, ...]:
    """Return the blocks of a text.

    Raises TextError if a fence or a formula does not end, or the text is too long to be shown.
    """
    if len(text) > LETTERS:
        remedy = f"stay within {LETTERS}, in several steps"
        raise TextError(0, f"is a text of {len(text)} characters", remedy)
    return tuple(_blocks(text.splitlines()))


def extended(text: str, more: str) -> str:
    """Return a text with more below it. A list at its end continues in a list that begins it."""
    text, more = text.rstrip(), more.lstrip()
    last = text.rpartition("\n\n")[2].lstrip()
    items = _ITEM.match(last), _ITEM.match(more)
    goes_on = items[0] and items[1] and bool(items[0][1]) == bool(items[1][1])
    return f"{text}\n{more}" if goes_on else f"{text}\n\n{more}"


def escaped(text: str) -> str:
    """Escape a text so that it is shown as typed, whatever signs are in it."""
    return re.sub(r"([\\$*`[])", r"\\\1", text)


def formulas(blocks: tuple[Block, ...]) -> tuple[str, ...]:
    """Return all formulas of a text, as LaTeX."""
    parts = (part for block in blocks for part in _parts(block))
    return tuple(part.latex for part in parts if isinstance(part, Math | DisplayedFormula))


def pieces(blocks: tuple[Block, ...]) -> int:
    """Count the pieces of a text: formulas, programs, runs of words in one style."""
    return sum(1 for block in blocks for _ in _parts(block))


def _parts(block: Block) -> Iterable[Span | Code | DisplayedFormula]:
    if isinstance(block, Code | DisplayedFormula):
        return (block,)
    return itertools.chain(*block.items) if isinstance(block, ItemList) else block.line


def _blocks(lines: list[str]) -> Iterator[Block]:
    number = 0
    while number < len(lines):
        line = lines[number].strip()
        start = number
        number += 1
        if not line:
            continue
        if line.startswith("```"):
            while number < len(lines) and lines[number].strip() != "```":
                number += 1
            if number == len(lines):
                raise TextError(start, "the code does not end", "close it by a line of ```")
            yield Code("\n".join(lines[start + 1 : number]))
            number += 1
        elif line.startswith("$$"):
            while not (
                lines[number - 1].rstrip().endswith("$$") and _text_of(lines, start, number)
            ):
                _check_ends_there(lines[number - 1], 2 * (number - 1 == start), number - 1)
                if number == len(lines):
                    raise TextError(start, "the formula does not end", "close it by $$")
                number += 1
            yield DisplayedFormula(_balanced(_text_of(lines, start, number), start))
        elif line.startswith("#"):
            level = len(line) - len(line.lstrip("#"))
            yield Heading(level, _line(line[level:].strip(), start))
        elif line[0] in "-*0123456789" and _ITEM.fullmatch(line):
            items, number = _items(lines, start)
            numbered = line[0].isdigit()
            yield ItemList(tuple(_line(item, start + k) for k, item in items), numbered)
        else:
            asked = line.startswith(">")
            while number < len(lines) and _goes_on(lines[number], asked):
                number += 1
            content = " ".join(map(_unasked if asked else str.strip, lines[start:number]))
            spans = _line(content, start)
            yield Question(spans) if asked else Paragraph(spans)


def _check_ends_there(line: str, begin: int, number: int) -> None:
    """Raise TextError if text follows the end of a displayed formula in a line. begin: the first
    character to look at.
    """
    if "$$" in line.strip()[begin:]:
        raise TextError(
            number, "text follows a displayed formula's $$", "begin a new line after it"
        )


def _items(lines: list[str], start: int) -> tuple[list[tuple[int, str]], int]:
    """Return a list's items, each with its line after `start`, and the number of the line after
    the list.
    """
    items: list[tuple[int, list[str]]] = []
    number = start
    while number < len(lines) and lines[number].strip():
        item = _ITEM.fullmatch(lines[number].strip())
        if item:
            items.append((number - start, [item[2]]))
        else:  # continues the item above
            items[-1][1].append(lines[number].strip())
        number += 1
    return [(where, " ".join(parts)) for where, parts in items], number


def _goes_on(line: str, asked: bool) -> bool:
    """Return True if a paragraph, or a question, continues on this line."""
    return line.lstrip().startswith(">") if asked else not _BEGINS.match(line)


def _unasked(line: str) -> str:
    """Return a question's line without its first sign."""
    return line.strip().lstrip(">").strip()


def _text_of(lines: list[str], start: int, end: int) -> str:
    """Return the text between a displayed formula's two $$."""
    return "\n".join(lines[start:end]).strip()[2:-2].strip()


def _line(text: str, number: int) -> Line:
    if not _SIGN.search(text):
        return (Words(text),) if text else ()
    return tuple(_merged(_spans(text, number)))


def _spans(text: str, number: int, bold: bool = False, italic: bool = False) -> Iterator[Span]:
    pattern = _SPANS[not bold, not italic]
    at = start = 0  # the beginnings of text not yet yielded, and not yet searched
    while match := pattern.search(text, start):
        kind, start = match.lastgroup, match.end()
        if kind == "open":  # nothing closes it, nor any later one: they are not looked for again
            pattern = _SPANS[not bold, False]
            continue
        if kind == "displayed":
            raise TextError(
                number, "$$ stands within a line", "give it lines of its own, or write $ ... $"
            )
        if at < match.start():
            yield _plain(text[at : match.start()], number, bold, italic)
        at, inner = start, match[kind or 0]
        if kind == "latex":
            yield Math(_balanced(inner.strip(), number))
        elif kind == "strong":
            yield from _spans(inner, number, True, italic)
        elif kind == "slanted":
            yield from _spans(inner, number, bold, True)
        elif kind == "link":
            yield Words(match["linked"], bold, italic)  # a link of an older format
        else:
            yield Words(inner, bold, italic, code=kind == "code")
    if at < len(text):
        yield _plain(text[at:], number, bold, italic)


def _plain(text: str, number: int, bold: bool, italic: bool) -> Words:
    if "$" in text:
        raise TextError(
            number, "a formula does not end", r"close it by $, or write \$ for a dollar"
        )
    return Words(text, bold, italic)


def _merged(spans: Iterable[Span]) -> Iterator[Span]:
    """Yield the spans, neighbours of one style as one."""
    for style, group in itertools.groupby(spans, lambda span: isinstance(span, Words) and span[1:]):
        if style:
            yield Words("".join(span[0] for span in group), *style)
        else:
            yield from group


def _balanced(latex: str, number: int) -> str:
    """Return the formula. Raise TextError if its braces do not match."""
    depth = 0
    for sign in re.sub(r"\\[{}\\]", "", latex):
        depth += (sign == "{") - (sign == "}")
        if depth < 0:
            break
    if depth:
        raise TextError(number, f"the braces of {latex[:40]!r} do not match", "correct the formula")
    return latex
