r"""Parse Markdown with formulas into blocks to draw.

A lecture may use headings (#), paragraphs, lists (- or 1.), code (```), questions to the class (>),
**bold**, *italic*, `code`, $formulas$ and $$displayed formulas$$. \$ is a dollar sign. Other
Markdown is shown as typed.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from markdown_it import MarkdownIt
from markdown_it.tree import SyntaxTreeNode
from mdit_py_plugins.dollarmath import dollarmath_plugin

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
    """A mistake in a text. line: its line, 0 for the first one."""

    def __init__(self, line: int, problem: str, remedy: str) -> None:
        super().__init__("", problem, remedy)
        self.line = line

    def within(self, prefix: str, sign: str = ".") -> TextError:
        self.field = super().within(prefix, sign).field
        return self


RULES = (
    *("heading", "list", "fence", "blockquote", "emphasis", "link"),
    *("backticks", "escape", "newline"),
)
# Keep escaped signs separate, because a $ in the text is a formula that does not end.
_MARKDOWN = (
    MarkdownIt("zero")
    .enable(RULES)
    .disable("text_join")
    .use(dollarmath_plugin, allow_labels=False, double_inline=True)
)
LETTERS = 50_000  # of a text; a slide has several hundred


@lru_cache(256)
def parse(text: str) -> tuple[Block, ...]:
    """Return the blocks of a text.

    Raises TextError if a fence or a formula does not end, or the text is too long to be shown.
    """
    if len(text) > LETTERS:
        remedy = f"stay within {LETTERS}, in several steps"
        raise TextError(0, f"is a text of {len(text)} characters", remedy)
    lines = text.splitlines()
    tree = SyntaxTreeNode(_MARKDOWN.parse("\n".join(lines)))
    return tuple(_block(node, lines) for node in tree.children)


def extended(text: str, more: str) -> str:
    """Return a text with more below it. A list at the text's end continues in one at the beginning
    of `more`.
    """
    return f"{text.rstrip()}\n\n{more.lstrip()}"


def escaped(text: str) -> str:
    """Escape a text so that all of its signs are shown as typed."""
    return re.sub(r"([\\$*_`[])", r"\\\1", text)


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


def _block(node: SyntaxTreeNode, lines: list[str]) -> Block:
    start, end = node.map or (0, 0)
    match node.type:
        case "heading":
            return Heading(len(node.markup), _line(node))
        case "bullet_list" | "ordered_list":
            return ItemList(tuple(map(_line, node.children)), node.type == "ordered_list")
        case "blockquote":
            return Question(_line(node))
        case "fence":
            if end == start + 1 or lines[end - 1].strip() != node.markup:
                raise TextError(start, "the code does not end", f"close it by {node.markup}")
            return Code(node.content.removesuffix("\n"))
        case "math_block":
            return DisplayedFormula(_balanced(node.content.strip(), start))
    return Paragraph(_line(node))


def _line(node: SyntaxTreeNode) -> Line:
    """Return a block's text as one line, merging neighbours of one style."""
    spans: list[Span] = []
    for inner in node.walk():
        start = inner.map[0] if inner.map else 0
        if inner.type in ("fence", "math_block"):
            raise TextError(start, "a list or a question contains a program", "move it below")
        if inner.type == "inline":
            spans += [Words(" "), *_spans(inner, start)] if spans else _spans(inner, start)
    return tuple(_merged(spans))


def _spans(
    parent: SyntaxTreeNode, number: int, bold: bool = False, italic: bool = False
) -> Iterator[Span]:
    """Yield the spans of a text that begins in line `number`."""
    for node in parent.children:
        match node.type:
            case "softbreak" | "hardbreak":
                number += 1
                yield Words(" ", bold, italic)
            case "strong":
                yield from _spans(node, number, True, italic)
            case "em" | "link":  # a link of an older format, to another step
                yield from _spans(node, number, bold, italic or node.type == "em")
            case "math_inline":
                yield Math(_balanced(node.content.strip(), number))
            case "math_inline_double":
                remedy = "give it lines of its own, or write $ ... $"
                raise TextError(number, "$$ is inside a line", remedy)
            case "text" if "$" in node.content:
                remedy = r"close it by $, or write \$ for a dollar"
                raise TextError(number, "a formula does not end", remedy)
            case kind:
                yield Words(node.content, bold, italic, code=kind == "code_inline")


def _merged(spans: Iterable[Span]) -> Iterator[Span]:
    """Yield the spans, merging neighbours of one style."""
    for style, group in itertools.groupby(spans, lambda span: isinstance(span, Words) and span[1:]):
        if not style:
            yield from group
        elif text := "".join(span[0] for span in group):
            yield Words(text, *style)


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
